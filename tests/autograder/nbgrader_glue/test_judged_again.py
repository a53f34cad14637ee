"""A proof that a person has marked stays marked, whatever has the class judged again."""

import json
import os
import shutil

import nbformat
import pytest

from autograder.pipeline import run, worker
from tests.autograder import courses
from tests.autograder.courses import NOTEBOOK, P3
from tests.autograder.nbgrader_glue.test_corrections import change, grade, mark, standing, typo
from tests.submissions import p3_pendulum
from tests.submissions.answers import cell_of

# In the second, the answer is in a cell of the student's own below the empty proof.
STUDENTS = ("marked", "below")
MARKED = {"marked": 14.0, "below": 13.0}


def handed_in(root, student):
    return root / "course" / "submitted" / student / P3 / NOTEBOOK


def submission(release, student, proof="It follows from E."):
    notebook = p3_pendulum.right(release)
    if student == "below":
        answer = cell_of(notebook, "p3-derivation")
        answer.source = cell_of(release, "p3-derivation").source
        place = notebook.cells.index(answer) + 1
        notebook.cells.insert(place, nbformat.v4.new_markdown_cell(proof))
    else:
        cell_of(notebook, "p3-derivation").source = proof
    return notebook


@pytest.fixture(scope="module")
def marked(tmp_path_factory):
    root = courses.new_course(tmp_path_factory.mktemp("judged") / "course")
    for student in STUDENTS:
        courses.submit(root, student, submission(courses.release(root), student))
    with pytest.MonkeyPatch.context() as patched:
        assert grade(root, patched) == 0
    assert all(standing(root, student)[2] == {"p3-derivation"} for student in STUDENTS)
    for student in STUDENTS:
        mark(root, student, MARKED[student] - 10)
    return root


@pytest.fixture
def course(marked, tmp_path):
    return shutil.copytree(marked, tmp_path / "another place")


def standings(root):
    return {student: standing(root, student)[::2] for student in STUDENTS}


STILL_MARKED = {student: (points, set()) for student, points in MARKED.items()}


def export_path(root, monkeypatch):
    with (root / "nbgrader_config.py").open("a") as file:
        file.write('c.ExportPlugin.to = "course/elsewhere.csv"\n')


def folder_moved(root, monkeypatch):
    """The fixture has moved it."""


def another_computer(root, monkeypatch):
    monkeypatch.setattr(
        os, "uname", lambda: os.uname_result(("Linux", "other", "1", "1", "x86_64"))
    )
    monkeypatch.setattr("socket.gethostname", lambda: "other")
    monkeypatch.setenv("HOSTNAME", "other")


@pytest.mark.parametrize("change_of", [export_path, folder_moved, another_computer])
def test_what_decides_no_verdict_has_nothing_judged_again(course, change_of, monkeypatch, capsys):
    change_of(course, monkeypatch)
    monkeypatch.setattr(run, "judge", never)
    assert grade(course, monkeypatch) == 0
    assert "could not be graded" not in capsys.readouterr().out
    assert standings(course) == STILL_MARKED


def never(*arguments):
    raise AssertionError("judged again")


def cell_output(root, monkeypatch):
    for student in STUDENTS:
        notebook = json.loads(handed_in(root, student).read_text())
        code = next(cell for cell in notebook["cells"] if cell["cell_type"] == "code")
        code["outputs"] = [{"output_type": "stream", "name": "stdout", "text": "hello"}]
        handed_in(root, student).write_text(json.dumps(notebook))


def typo_in_solutions(root, monkeypatch):
    change(root, typo)


def new_version(root, monkeypatch):
    monkeypatch.setattr(run, "code_version", lambda: "next")
    monkeypatch.setattr(run, "judge", judged_by_the_next)


def judged_by_the_next(*arguments):
    """A version that words its letter to the student in another way."""
    outcome = worker.judge(*arguments)
    for cell in outcome["notebook"]["cells"]:
        if cell["source"].startswith("**From the grader"):
            cell["source"] += "\n\nMore than before."
    return outcome | {"code": "next"}


@pytest.mark.parametrize("change_of", [cell_output, typo_in_solutions, new_version])
def test_what_has_it_judged_again_leaves_a_persons_marks(course, change_of, monkeypatch, capsys):
    change_of(course, monkeypatch)
    assert grade(course, monkeypatch) == 0
    assert "2 graded, 0 unchanged" in capsys.readouterr().out
    assert standings(course) == STILL_MARKED


def test_nbgrader_leaves_them_too_unless_the_answer_has_changed(course):
    cell_output(course, None)
    courses.run(course, "nbgrader", "autograde", P3, "--force")
    assert standings(course) == STILL_MARKED
    for student in STUDENTS:
        new = submission(courses.release(course), student, "It follows from something else.")
        handed_in(course, student).write_text(json.dumps(new))
    courses.run(course, "nbgrader", "autograde", P3, "--force")
    assert {to_read for _, (to_read,) in standings(course).values()} == {"p3-derivation"}


@pytest.mark.parametrize("student", STUDENTS)
def test_only_a_changed_text_of_the_answer_brings_it_back(course, student, monkeypatch):
    new = submission(courses.release(course), student, "It follows from something else.")
    handed_in(course, student).write_text(json.dumps(new))
    assert grade(course, monkeypatch) == 0
    expected = STILL_MARKED | {student: (MARKED[student], {"p3-derivation"})}
    assert standings(course) == expected
