"""Files that are hardly notebooks, through `autograder grade` in one batch with right ones."""

import copy
import json
from types import SimpleNamespace

import nbformat
import pytest

from autograder.cli import main
from autograder.notebook.repair import without_surrogates
from tests.autograder import courses
from tests.autograder.courses import NOTEBOOK, P3, rows, submit
from tests.submissions import p3_pendulum
from tests.submissions.hostile_files import FILES, HALF, READABLE
from tests.submissions.p3_pendulum import POINTS


def latin_1(release) -> bytes:
    """Not UTF-8, as nbformat wants it."""
    notebook = copy.deepcopy(p3_pendulum.right(release))
    notebook.cells[0].source += "é"
    return json.dumps(notebook, ensure_ascii=False).encode("latin-1", "replace")


MORE = {"latin_1": latin_1}
REFUSED = [name for name in FILES | MORE if name not in READABLE]


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    root = courses.new_course(tmp_path_factory.mktemp("files") / "course")
    release = courses.release(root)
    for name, make in (FILES | MORE).items():
        submit(root, name, "").write_bytes(make(release))
    submit(root, "z_last", p3_pendulum.right(release))
    printed = courses.run(root, "autograder", "grade", P3, "--jobs", "2", status=1)
    lines = {line.split()[0]: " ".join(line.split()[1:]) for line in printed.splitlines() if line}
    scores: dict[str, dict[str, float]] = {}
    for row in map(dict, rows(courses.database(root))["grade"]):
        student = row["notebook_id"].split("/")[0]
        scores.setdefault(student, {})[row["cell_id"]] = row["auto_score"]
    return SimpleNamespace(root=root, lines=lines, scores=scores, printed=printed)


@pytest.mark.parametrize("name", [*READABLE, "z_last"])
def test_what_can_be_read_earns_what_it_should(course, name):
    found = {cell: score for cell, score in course.scores[name].items() if cell in POINTS}
    assert found == READABLE.get(name, POINTS)
    nbformat.read(course.root / "course" / "autograded" / name / P3 / NOTEBOOK, as_version=4)


@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_be_read_is_refused_in_one_sentence(course, name):
    assert course.lines[name].startswith(f"could not be graded {NOTEBOOK} ")
    assert not (course.root / "course" / "autograded" / name).exists()
    assert not any(course.scores[name].values())


def test_the_instructor_is_told(course):
    assert course.lines["latin_1"].endswith("is not valid JSON: ask the student for it again")
    said = "broken Unicode was replaced by \ufffd"
    assert said in course.lines["half_characters"]
    assert "Traceback" not in course.printed


def test_a_second_run_finds_nothing_new(course, monkeypatch, capsys):
    monkeypatch.chdir(course.root)
    assert main(["grade", P3, "--jobs", "1"]) == 1
    printed = capsys.readouterr().out
    assert f"0 graded, {len(READABLE) + 1} unchanged, {len(REFUSED)} could not" in printed


def test_only_halves_are_replaced():
    whole = {"é": ["🦾", 1, None, 0.5], "a": {"b": "\x00"}}
    assert without_surrogates(whole) is whole
    assert without_surrogates({HALF: [HALF + "x", whole]}) == {"\ufffd": ["\ufffdx", whole]}
