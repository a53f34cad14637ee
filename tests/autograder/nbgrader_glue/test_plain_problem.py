"""An instructor's own assignment, without a check of ours, through a whole course; and sources that are
refused before anything is changed.
"""

import shutil
from pathlib import Path

import nbformat
import pytest
from nbgrader.api import Gradebook

from tests.autograder import courses
from tests.submissions import plain
from tests.submissions.answers import blank, cell_of

NOTEBOOK = f"{plain.NAME}/{plain.NAME}.ipynb"
CLASS = {"right": plain.right, "wrong": plain.wrong, "blank": blank}


def write_source(root: Path, source) -> None:
    path = root / "solutions" / NOTEBOOK
    path.parent.mkdir(parents=True, exist_ok=True)
    nbformat.write(source, path)


def grades(root: Path, student: str) -> dict[str, tuple]:
    """By grade_id: the points that the grader gave, and whether a person has to read the cell."""
    with Gradebook(courses.database(root)) as gradebook:
        notebook = gradebook.find_submission_notebook(plain.NAME, plain.NAME, student)
        return {
            grade.name: (grade.auto_score, grade.needs_manual_grade) for grade in notebook.grades
        }


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    root = tmp_path_factory.mktemp("course")
    shutil.copy(courses.ROOT / "nbgrader_config.py", root)
    write_source(root, plain.source())
    said = courses.run(root, "nbgrader", "generate_assignment", plain.NAME)
    for name in plain.POINTS:
        assert f"{name} has no check: as in nbgrader, it is graded by whether its code" in said
    release = nbformat.read(root / "course" / "release" / NOTEBOOK, as_version=4)
    for student, make in CLASS.items():
        path = root / "course" / "submitted" / student / NOTEBOOK
        path.parent.mkdir(parents=True)
        nbformat.write(make(release), path)
    return root


# The points of both tests; a person reads the rest, but for what nobody has touched.
EXPECTED = {
    "right": (2.0, 3.0, {"answer-draw", "answer-why", "task"}),
    "wrong": (0.0, 1.0, {"answer-draw", "answer-why", "task"}),
    "blank": (0.0, 0.0, {"task"}),
}


def test_both_commands_grade_it_as_nbgrader_would(course):
    for command in (("nbgrader", "autograde"), ("autograder", "grade")):
        said = courses.run(course, *command, plain.NAME)
        for student, (double, mean, read) in EXPECTED.items():
            found = grades(course, student)
            assert found["test-double"] == (double, False)
            assert found["test-mean"] == (mean, False)
            assert {name for name, (_, by_hand) in found.items() if by_hand} == read
    assert "right    5 of 12  2 correct, 3 to be read" in said
    assert "blank    0 of 12  2 not attempted, 1 to be read" in said


def test_the_page_says_where_the_points_went(course):
    courses.run(course, "autograder", "grade", plain.NAME)
    courses.run(course, "nbgrader", "generate_feedback", plain.NAME)
    pages = course / "course" / "feedback"
    page = (pages / "wrong" / NOTEBOOK).with_suffix(".html").read_text()
    assert "failed: line 5, AssertionError: the sign." in " ".join(page.split()).replace(
        "&#39;", "'"
    )
    assert "gave 1 of 3 points" in page
    assert "all of them" in (pages / "right" / NOTEBOOK).with_suffix(".html").read_text()
    for command in (("autograder", "report", plain.NAME), ("autograder", "export")):
        courses.run(course, *command)


@pytest.mark.parametrize(
    ("command", "status"),
    [
        (("nbgrader", "generate_assignment", "--force"), 1),
        (("nbgrader", "autograde", "--force"), 1),
        (("autograder", "grade"), 2),
    ],
)
def test_a_source_that_cannot_be_graded_is_refused_before_anything_changes(
    course, tmp_path, command, status
):
    root = tmp_path / "course"
    shutil.copytree(course, root)
    graded = root / "course" / "autograded" / "right" / plain.NAME
    graded.mkdir(parents=True, exist_ok=True)
    (graded / "kept.txt").write_text("kept")
    before = courses.files(root / "course" / "release"), courses.files(graded)
    source = plain.source()
    cell_of(source, "answer-double").source = "def double(x):\n    return 3 * x"
    write_source(root, source)
    said = courses.run(root, *command, plain.NAME, status=status)
    assert f"solutions/{plain.NAME} cannot be graded as it is:" in said
    assert (
        "the test of test-double fails with the model answer of the source: line 2, AssertionError: "
        "double(2) is 4"
    ) in said
    assert "Traceback" not in said
    assert (courses.files(root / "course" / "release"), courses.files(graded)) == before


def test_a_source_that_cannot_be_read_leaves_the_release_as_it_is(course, tmp_path):
    root = tmp_path / "course"
    shutil.copytree(course, root)
    before = courses.files(root / "course" / "release")
    (root / "solutions" / NOTEBOOK).write_text("no notebook")
    arguments = ("generate_assignment", "--force", plain.NAME)
    said = courses.run(root, "nbgrader", *arguments, status=1)
    assert f"{plain.NAME}.ipynb cannot be read" in said
    assert "Traceback" not in said
    assert courses.files(root / "course" / "release") == before
