"""The zoo: no attack earns a point, harms the next submission or leaves a process behind."""

import os
import re
import shutil
import signal
import socket

import nbformat
import pytest

from autograder.judging.verdict import State
from autograder.notebook import sitting
from autograder.notebook.grade import grade
from autograder.notebook.repair import grade_id, is_locked
from autograder.notebook.scores import outputs_for
from autograder.sandbox import room as sandbox
from autograder.sandbox.room import Room
from autograder.sandbox.ways import Way
from tests.autograder.course_problems import problem, without_plots
from tests.autograder.descendants import adopting, below
from tests.autograder.eventually import eventually
from tests.submissions import p3_pendulum
from tests.submissions.answers import cell_of
from tests.submissions.attack import GOT, LISTENING, OUTSIDE, ROOT
from tests.submissions.hostile import (
    ATTACKS,
    SAFE_WITHOUT_WALLS,
    STOPPED_WITHOUT_WALLS,
    unstopped,
)
from tests.submissions.p3_pendulum import POINTS

P3 = "p3-pendulum"
WORDS_OF_THE_GUIDE = {
    "reads_the_solution": "the solutions",
    "hunts_modules": "this project's own modules",
    "follows_symlinks": "follow links",
    "another_language": "whatever you can read",
    "writes_the_gradebook": "the gradebook",
    "writes_outside": "write any file",
    "shadowed_modules": "modules",
    "leaves_notes": "notes for the next",
    "reads_proc": "see your other processes",
    "kills_its_parent": "kill the grader",
    "fork_bomb": "more processes",
    "reaches_the_network": "the network",
}


SOURCE = without_plots(problem(P3).source)


@pytest.fixture(scope="module")
def release():
    return without_plots(problem(P3).release)


# Both have the same walls, none; how they start is tested with the rooms.
UNWALLED_WAYS = pytest.mark.parametrize(
    "way",
    [Way.UNWALLED, pytest.param(Way.UNWALLED_COLD, marks=pytest.mark.long)],
    ids=lambda way: way.name,
)
# The next submission is a right one, without what takes the longest to judge.
NEXT = [name for name in POINTS if name != "p3-lagrangian"]


def next_points(release) -> dict[str, float]:
    def shorter(notebook):
        notebook = nbformat.from_dict(notebook)
        left_out = ("p3-lagrangian", "answer-lagrangian")
        notebook.cells = [cell for cell in notebook.cells if grade_id(cell) not in left_out]
        return notebook

    return points(grade(shorter(p3_pendulum.right(release)), shorter(SOURCE), "seed"))


@pytest.fixture(scope="module")
def orphans_come_here():
    """Whatever is left behind becomes a child of this process, so that it can be seen."""
    with adopting():
        yield


@pytest.fixture
def short_limits(monkeypatch):
    """A second for what takes ten: the limits are what is tested, not how long they are."""
    monkeypatch.setattr(sandbox, "STARTED", 1.0)
    monkeypatch.setattr(Room.run, "__defaults__", (1.0,))
    monkeypatch.setattr(sandbox, "GRACE_SECONDS", 1.0)


def descendants() -> set[int]:
    """The living processes below this one."""
    return below(ended=False)


def points(graded) -> dict[str, float]:
    """What nbgrader reads from the outputs of each grade cell."""
    return {
        name: 0.0
        if verdict.state is State.CHECK_FAILED
        else float(outputs_for(verdict, POINTS[name])[-1].data["text/plain"])
        for name, verdict in graded.verdicts.items()
    }


def said(graded) -> str:
    """All that the instructor and the student are told."""
    cells = [cell for cell in graded.notebook.cells if cell.cell_type == "code"]
    outputs = [str(dict(output)) for cell in cells for output in cell.outputs]
    verdicts = graded.verdicts.values()
    sentences = [line for verdict in verdicts for line in (verdict.headline, *verdict.lines())]
    return "\n".join([*sentences, *graded.notes, *outputs])


def claims(notebook) -> dict[str, tuple]:
    """The graded cells: kind, points and flags, and the text of those that nobody may edit."""
    kept = ("grade", "solution", "locked", "task", "points")
    found = {}
    for cell in notebook.cells:
        if grade_id(cell):
            settings = cell.metadata["nbgrader"]
            text = cell.source if is_locked(cell) else ""
            assert grade_id(cell) not in found
            found[grade_id(cell)] = cell.cell_type, text, [settings.get(key) for key in kept]
    return found


@pytest.fixture(scope="module")
def before(orphans_come_here, release, needs):
    """The processes there are when nothing hostile has run yet."""
    needs("bubblewrap")
    assert points(grade(p3_pendulum.right(release), SOURCE, "seed")) == POINTS
    Room(Way.UNWALLED).close()
    return descendants()


@pytest.fixture
def outside():
    """A place with a course, which no room may touch."""
    (OUTSIDE / "course").mkdir(parents=True)
    for name in ("gradebook.db", "seed"):
        (OUTSIDE / "course" / name).touch()
    with socket.create_server(("127.0.0.1", 0)) as server:
        LISTENING.port = server.getsockname()[1]
        yield OUTSIDE
    shutil.rmtree(OUTSIDE)


@pytest.mark.parametrize("attack", ATTACKS.values(), ids=ATTACKS)
def test_no_attack_earns_a_point(attack, release, before, outside, short_limits):
    graded = grade(attack.edit(release), SOURCE, "seed")
    assert points(graded) == attack.points
    assert all(verdict.state is not State.CHECK_FAILED for verdict in graded.verdicts.values())

    told = said(graded)
    assert attack.says in told
    assert all(len(note) < 500 and note.isprintable() for note in graded.notes)
    assert GOT not in told
    assert "<script" not in told
    for name in attack.lost:
        verdict = graded.verdicts[name]
        assert verdict.problem or verdict.diagnosis or verdict.witness
    nbformat.validate(graded.notebook)
    assert claims(graded.notebook) == claims(SOURCE)
    assert len(nbformat.writes(graded.notebook)) < 60_000_000
    assert sorted(path.name for path in outside.rglob("*")) == ["course", "gradebook.db", "seed"]
    assert (outside / "course" / "gradebook.db").stat().st_size == 0

    assert eventually(lambda: descendants() <= before), "a process was left behind"
    assert next_points(release) == {name: POINTS[name] for name in NEXT}


@UNWALLED_WAYS
@pytest.mark.parametrize("name", SAFE_WITHOUT_WALLS)
def test_what_the_fallback_does_not_stop_is_so(way, name, release, before, outside, monkeypatch):
    monkeypatch.setattr(sandbox, "_best_way", lambda: way)
    attack = ATTACKS[name]
    graded = grade(attack.edit(release), SOURCE, "seed")
    assert points(graded) == attack.points
    left_behind = descendants() - before
    for process in left_behind:
        os.kill(process, signal.SIGKILL)
    assert GOT in said(graded) or (outside / "written").exists() or left_behind
    assert name in unstopped()


@UNWALLED_WAYS
@pytest.mark.parametrize("name", STOPPED_WITHOUT_WALLS)
def test_what_the_fallback_stops_too(
    way, name, release, before, outside, short_limits, monkeypatch
):
    monkeypatch.setattr(sandbox, "_best_way", lambda: way)
    attack = ATTACKS[name]
    graded = grade(attack.edit(release), SOURCE, "seed")
    assert points(graded) == attack.points
    assert attack.says in said(graded)
    assert GOT not in said(graded)
    assert not (outside / "written").exists()
    assert eventually(lambda: descendants() <= before), "a process was left behind"
    assert name not in unstopped()


def test_the_guide_names_what_the_fallback_does_not_stop():
    """docs/sandbox.md says in words what `unstopped` lists: a word for each kind."""
    guide = (ROOT / "docs" / "sandbox.md").read_text(encoding="utf-8")
    (part,) = re.findall(r"Without bubblewrap.*?(?=\nStudents. Markdown)", guide, re.DOTALL)
    for name, said_of_it in unstopped().items():
        assert WORDS_OF_THE_GUIDE[name] in part, said_of_it
    assert WORDS_OF_THE_GUIDE.keys() == unstopped().keys()


def test_many_loops_cost_one_limit_together_and_no_answer(release, short_limits, monkeypatch):
    monkeypatch.setattr(sitting, "OWN_SECONDS", 2.5)
    monkeypatch.setattr(Room.run, "__defaults__", (0.5,))
    notebook = p3_pendulum.right(release)
    loops = [nbformat.v4.new_code_cell("while True: sum(())") for _ in range(30)]
    after = notebook.cells.index(cell_of(notebook, "p3-M"))
    notebook.cells[after + 1 : after + 1] = loops
    graded = grade(notebook, SOURCE, "seed")
    assert points(graded) == POINTS
    told = said(graded)
    assert 1 <= told.count("TimeoutError: this cell ran longer than") < 30
    assert "not run: the student's own cells had used up the 2.5 s that they have together" in told


def test_the_zoo_is_large_and_each_says_what_it_tries():
    assert len(ATTACKS) >= 40
    assert all(attack.tries.endswith(".") for attack in ATTACKS.values())
