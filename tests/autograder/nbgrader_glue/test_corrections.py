"""An instructor changes an assignment in mid-term: what is said, and what the way out leaves."""

import copy
import csv
import re
import shutil

import nbformat
import pytest
from nbformat.v4 import new_markdown_cell
from nbgrader.api import Gradebook

from autograder.cli import main
from tests.autograder import courses
from tests.autograder.courses import NOTEBOOK, P3, files, rows
from tests.submissions import p3_pendulum
from tests.submissions.answers import cell_of

STUDENTS = ("right", "partly_right", "blank")
PROOF = "p3-derivation"
FORCE = f"run `nbgrader generate_assignment {P3} --force`"


def change(root, *changes):
    """Change solutions/ as these functions do."""
    path = root / "solutions" / P3 / NOTEBOOK
    source = nbformat.read(path, as_version=4)
    for one in changes:
        one(source)
    nbformat.write(source, path)


def points(name, value):
    return lambda source: cell_of(source, name).metadata["nbgrader"].update(points=value)


def without(name):
    return lambda source: source.cells.remove(cell_of(source, name))


def proof_added(source):
    cell = new_markdown_cell("Because it cancels.")
    cell.metadata["nbgrader"] = {
        **{"schema_version": 3, "grade_id": "p3-why", "points": 2},
        **{"grade": True, "locked": False, "solution": True, "task": False},
    }
    source.cells.append(cell)


def moved(source):
    cell = cell_of(source, "p3-C")
    source.cells.remove(cell)
    source.cells.insert(3, cell)


def at_the_end(source):
    cell = cell_of(source, "p3-lagrangian")
    source.cells.remove(cell)
    source.cells.append(cell)


def typo(source):
    next(cell for cell in source.cells if cell.cell_type == "markdown").source += "\n\nCorrected."


def twice(source):
    source.cells.append(copy.deepcopy(cell_of(source, "p3-C")))
    source.cells[-1].id = "another"


def mark(root, student, points, cell=PROOF):
    with Gradebook(courses.database(root)) as gradebook:
        grade = gradebook.find_grade(cell, P3, P3, student)
        grade.manual_score, grade.needs_manual_grade = points, False
        gradebook.db.commit()


def standing(root, student):
    """Points, the most there are, and the cells that a person has to read."""
    with Gradebook(courses.database(root)) as gradebook:
        submission = gradebook.find_submission(P3, student)
        to_read = {one.name for one in submission.notebooks[0].grades if one.needs_manual_grade}
        return submission.score, submission.max_score, to_read


def state(root):
    return rows(courses.database(root)), files(root / "course" / "release")


def grade(root, monkeypatch) -> int:
    monkeypatch.chdir(root)
    return main(["grade", P3, "--jobs", "1"])


@pytest.fixture(scope="module")
def graded(tmp_path_factory):
    root = courses.new_course(tmp_path_factory.mktemp("corrections") / "graded")
    for student in STUDENTS:
        courses.submit(root, student, p3_pendulum.CLASS[student](courses.release(root)))
    with pytest.MonkeyPatch.context() as patched:
        assert grade(root, patched) == 0
    mark(root, "right", 4.0)
    assert standing(root, "right") == (14.0, 15.0, set())
    return root


@pytest.fixture
def course(graded, tmp_path):
    return shutil.copytree(graded, tmp_path / "course")


CHANGES = {
    "points up": ([points("p3-M", 3)], "p3-M has 3 points, but 1 point in the gradebook"),
    "points down": ([points(PROOF, 3)], f"{PROOF} has 3 points, but 5 points in the gradebook"),
    "removed": (
        [without("p3-C")],
        "p3-C (1 point) is in the gradebook, but no longer in solutions/",
    ),
    "added": ([proof_added], "p3-why (2 points) is not in the gradebook"),
}


@pytest.mark.parametrize("kind", CHANGES)
def test_autograder_grade_says_it_before_anything_is_graded(course, kind, monkeypatch, capsys):
    before = state(course)
    changes, said = CHANGES[kind]
    change(course, *changes)
    assert grade(course, monkeypatch) == 2
    complaint = capsys.readouterr().err
    assert said in complaint
    assert FORCE in complaint
    assert state(course) == before


def test_so_does_nbgrader_and_generate_does_nothing_without_force(course):
    before = state(course)
    change(course, *(one for changes, _ in CHANGES.values() for one in changes))
    for command in ("autograde", "generate_assignment"):
        printed = courses.run(course, "nbgrader", command, P3, status=1)
        for _, said in CHANGES.values():
            assert said in printed
        assert FORCE in printed
        assert "Traceback" not in printed
    assert state(course) == before


def test_the_way_out_leaves_the_new_points_and_what_a_person_gave(course, monkeypatch, tmp_path):
    """Whichever command grades; and no student is blamed."""
    change(
        course, points("p3-M", 3), points("p3-g_vec", 1), without("p3-C"), proof_added, at_the_end
    )
    printed = courses.run(course, "nbgrader", "generate_assignment", P3, "--force")
    assert "3 submissions were graded by that" in printed
    theirs = shutil.copytree(course, tmp_path / "theirs")

    assert grade(course, monkeypatch) == 0
    most = 15 + 2 - 1 - 1 + 2
    assert standing(course, "right") == (9 + 2 - 1 - 1 + 5, most, set())
    assert standing(course, "partly_right")[1:] == (most, set())
    assert standing(course, "blank") == (0, most, set())

    log = courses.run(theirs, "nbgrader", "autograde", P3)
    assert rows(courses.database(theirs)) == rows(courses.database(course))
    for said in (log, courses.run(course, "autograder", "grade", P3, "--force", "--jobs", "1")):
        assert "p3-why is newer than the student's notebook" in said
        for blame in ("had been changed", "was missing", "claims to be"):
            assert blame not in said


def test_until_then_no_mark_is_out_of_the_old_points(course, capsys, monkeypatch):
    change(course, points("p3-M", 0.5))
    courses.run(course, "nbgrader", "generate_assignment", P3, "--force")
    assert "p3-M" in standing(course, "right")[2]
    monkeypatch.chdir(course)
    to = course / "marks.csv"
    assert main(["export", "--to", str(to)]) == 0
    with to.open(encoding="utf-8-sig", newline="") as file:
        row = next(row for row in csv.DictReader(file) if "right" in row.values())
    assert "14" not in row.values()


def page(root) -> str:
    """What the student reads after the one command that makes pages."""
    courses.run(root, "nbgrader", "generate_feedback", P3, "--student", "right")
    text = (root / "course" / "feedback" / "right" / P3 / f"{P3}.html").read_text()
    return " ".join(re.sub(r"<[^>]+>", " ", text).split())


def test_a_mark_above_the_new_points_comes_back_to_be_read(course, monkeypatch):
    assert "14 of 15 points" in page(course)
    change(course, points(PROOF, 3))
    printed = courses.run(course, "nbgrader", "generate_assignment", P3, "--force")
    assert f"{PROOF}: a person gave more than the new 3 points to right" in printed
    assert grade(course, monkeypatch) == 0
    assert standing(course, "right")[2] == {PROOF}
    mark(course, "right", 3.0)
    assert standing(course, "right") == (13.0, 13.0, set())
    assert "13 of 13 points" in page(course)


def test_points_that_are_changed_back_are_graded_again(course, monkeypatch):
    for value in (3, 1):
        change(course, points("p3-M", value))
        courses.run(course, "nbgrader", "generate_assignment", P3, "--force")
    assert grade(course, monkeypatch) == 0
    assert standing(course, "right") == (14.0, 15.0, set())


def test_what_a_person_gave_to_a_removed_proof_is_written_down(course, monkeypatch):
    change(course, without(PROOF))
    printed = courses.run(course, "nbgrader", "generate_assignment", P3, "--force")
    assert f"{PROOF}: what a person gave to right is in course/replaced/" in printed
    (kept,) = (course / "course" / "replaced" / "right" / P3).iterdir()
    assert f"{P3},{PROOF},4" in kept.read_text()
    assert grade(course, monkeypatch) == 0
    assert standing(course, "right") == (10.0, 10.0, set())


def test_a_moved_cell_or_a_corrected_text_changes_no_grade(course, monkeypatch, capsys):
    change(course, typo, moved)
    before = {student: standing(course, student) for student in STUDENTS}
    assert "a text or a file is another" in courses.run(
        course, "nbgrader", "generate_assignment", P3, status=1
    )
    courses.run(course, "nbgrader", "generate_assignment", P3, "--force")
    assert grade(course, monkeypatch) == 0
    assert "had been" not in capsys.readouterr().out
    assert {student: standing(course, student) for student in STUDENTS} == before


def other_notebook(root):
    (root / "solutions" / P3 / NOTEBOOK).rename(root / "solutions" / P3 / "other.ipynb")


FAILURES = {
    "a doubled cell": lambda root: change(root, twice),
    "another notebook": other_notebook,
}


@pytest.mark.parametrize("kind", FAILURES)
def test_a_release_is_never_lost(course, kind):
    before = state(course)
    FAILURES[kind](course)
    printed = courses.run(course, "nbgrader", "generate_assignment", P3, "--force", status=1)
    assert "as it was before" in printed or "as they were before" in printed
    assert state(course) == before
