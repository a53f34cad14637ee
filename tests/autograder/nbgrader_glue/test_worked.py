"""Opening worked answers: nothing that a student may get holds them before it is time."""

import json
import re
from datetime import datetime, timedelta
from pathlib import Path

import nbformat
import pytest

from autograder import worked_answers
from autograder.cli import main
from autograder.nbgrader_glue.worked import SETTINGS, answers_of
from autograder.notebook.answers import model_answers
from autograder.problems import READ
from autograder.proofs import DERIVATIONS
from tests.autograder import courses
from tests.autograder.course_problems import NAMES, problem
from tests.autograder.courses import P3
from tests.autograder.proofs.models import marked, models
from tests.autograder.verdicts import assert_right, judged_in, namespace_of
from tests.submissions import p3_pendulum
from tests.submissions.answers import answered

SOON = (datetime.now() + timedelta(days=3)).isoformat(timespec="minutes")


@pytest.fixture
def root(tmp_path, monkeypatch):
    root = courses.new_course(tmp_path / "course")
    monkeypatch.chdir(root)
    return root


def student_files(root: Path) -> list[Path]:
    """All files that students get, or could read in the exchange."""
    folders = ("course/release", "course/exchange", "course/feedback", "problems")
    return [path for folder in folders for path in (root / folder).rglob("*") if path.is_file()]


def squeezed(text: str) -> str:
    return re.sub(r"\s+", "", text)


def holding_answers(root: Path) -> set[str]:
    """The names of the files with a line of the solution that is not in every student's notebook."""
    given = squeezed(json.dumps(courses.release(root)))
    answers = "\n".join(answers_of(root, P3).values()).splitlines()
    lines = {squeezed(json.dumps(line)[1:-1]) for line in answers if len(line.strip()) > 20}
    lines = {line for line in lines if line not in given}
    assert len(lines) > 10
    return {
        path.name
        for path in student_files(root)
        if any(line in squeezed(path.read_text(errors="replace")) for line in lines)
    }


@pytest.mark.parametrize("name", NAMES)
def test_each_graded_cell_has_a_model_answer_that_is_right(name):
    answers = model_answers(problem(name).source)
    graded = {cell.metadata.nbgrader.grade_id for cell in problem(name).source.cells
              if cell.metadata.get("nbgrader", {}).get("grade")}  # fmt: skip
    derived = {cell.metadata.nbgrader.grade_id for cell in problem(name).source.cells
               if "nbgrader" in cell.metadata} & set(DERIVATIONS)  # fmt: skip
    assert answers.keys() == graded | derived
    assert not any("SOLUTION" in text for text in answers.values())
    for id in set(answers) - set(READ):
        assert answers[id].startswith(("def ", "import ", "from ")), id
    for id in derived:
        assert_complete(id, answers[id])
    if name == P3:
        for id in graded - set(READ):
            namespace = namespace_of(id, "return None")
            exec(answers[id], namespace)
            assert_right(judged_in(namespace, id))


def assert_complete(id: str, worked: str) -> None:
    """What is shown, run as a student's cell and handed in, earns all rows of the derivation."""
    namespace = {}
    exec(worked, namespace)
    (lines,) = (value for name, value in namespace.items() if name.endswith("_lines"))
    found = marked(id, lines, seed=3)
    assert (found.done, found.earned) == (True, DERIVATIONS[id].rows), found


def test_a_date_to_come_lets_out_the_date_alone(root, capsys):
    assert holding_answers(root) == set()
    assert main(["open-solution", P3, "--on", SOON]) == 0
    assert f"{P3}: closed until {SOON}" in capsys.readouterr().out
    release = root / "course" / "release" / P3
    held = worked_answers.read(release / worked_answers.OPENS)
    assert held[worked_answers.WHEN].startswith(SOON)
    assert holding_answers(root) == set()
    # Without a name, all whose time has come: it has not.
    assert main(["open-solution"]) == 0
    assert holding_answers(root) == set()


def test_from_then_on_it_is_where_students_get_the_assignment(root, capsys):
    courses.run(root, "nbgrader", "release_assignment", P3)
    own = root / "problems" / P3
    own.mkdir(parents=True, exist_ok=True)
    past = (datetime.now() - timedelta(hours=1)).isoformat(timespec="minutes")
    # The date was given before, and its time has come since.
    assert main(["open-solution", P3, "--on", SOON]) == 0
    worked_answers.write(root / SETTINGS, {P3: past})
    assert main(["open-solution"]) == 0
    assert f"{P3}: open, in " in capsys.readouterr().out
    assert holding_answers(root) == {worked_answers.OPEN}
    outbound = root / "course" / "exchange" / "armdyn" / "outbound" / P3
    for folder in (root / "course" / "release" / P3, outbound, own):
        assert worked_answers.read(folder / worked_answers.OPEN) == answers_of(root, P3)
    # And it is withdrawn where the date is put off.
    assert main(["open-solution", P3, "--on", SOON]) == 0
    assert holding_answers(root) == set()


def test_with_full_marks_the_feedback_page_shows_it_and_nothing_else_does(root, capsys):
    wrong = p3_pendulum.RIGHT.right_but(courses.release(root), M="def M(q, pend):\n    return 7")
    handed_in = {"ada": models()["p3-L"], "bob": models()["p3-L"][:-1]}
    for student, lines in handed_in.items():
        derived = f"def pendulum_lines():\n    return {lines!r}"
        of_student = answered(wrong, **{"p3-L": derived})
        courses.submit(root, student, of_student, "2026-11-20 10:00:00 UTC")
    assert main(["grade", P3, "--jobs", "1"]) == 0
    assert main(["open-solution", P3, "--full-marks"]) == 0
    assert "on the feedback pages" in capsys.readouterr().out
    assert holding_answers(root) == set()
    courses.run(root, "nbgrader", "generate_feedback", P3)
    page = (root / "course" / "feedback" / "ada" / P3 / f"{P3}.html").read_text(encoding="utf-8")
    assert "A worked answer for p3-g_vec" in page
    assert "A worked answer for p3-M" not in page
    assert "A worked answer for p3-derivation" not in page
    assert "A worked answer for p3-L" in page
    bobs = (root / "course" / "feedback" / "bob" / P3 / f"{P3}.html").read_text(encoding="utf-8")
    assert "p3-L: 4 of 4 lines hold" in bobs
    assert "A worked answer for p3-L" not in bobs
    graded = root / "course" / "autograded" / "ada" / P3 / f"{P3}.ipynb"
    assert "A worked answer" not in json.dumps(nbformat.read(graded, as_version=4))


def test_without_it_the_feedback_page_has_none(root):
    courses.submit(root, "ada", p3_pendulum.right(courses.release(root)), "2026-11-20 10:00:00 UTC")
    assert main(["grade", P3, "--jobs", "1"]) == 0
    courses.run(root, "nbgrader", "generate_feedback", P3)
    page = (root / "course" / "feedback" / "ada" / P3 / f"{P3}.html").read_text(encoding="utf-8")
    assert "p3-M: correct" in page
    assert "A worked answer" not in page


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([P3, "--on", SOON, "--full-marks"], "not both"),
        (["--on", SOON], "name the assignment"),
        (["p9-flying"], "there is no solutions/p9-flying"),
    ],
)
def test_what_cannot_be_asked_for_is_refused(root, arguments, said, capsys):
    assert main(["open-solution", *arguments]) == 2
    assert said in capsys.readouterr().err
    assert not (root / SETTINGS).exists()


def test_an_assignment_that_is_not_released_is_refused(root, capsys):
    (root / "course" / "release").rename(root / "elsewhere")
    assert main(["open-solution", P3]) == 2
    assert f"{P3} is not released" in capsys.readouterr().err
