"""Two students with arms of their own, through `autograder grade` and nbgrader's own commands."""

import json
import shutil

import nbformat
import pytest
from nbgrader.api import Gradebook

from autograder.problems.material.conventions import FAMILY, drawn
from tests.autograder import courses
from tests.submissions import own_arms
from tests.submissions.answers import cell_of

P1 = "p1-inertia"
YEAR = 2026
MINE, THEIRS = FAMILY[8], FAMILY[2]


def a_student_of(own) -> str:
    return next(name for name in map("s{}".format, range(400)) if drawn(name, YEAR) == own)


@pytest.fixture(scope="module")
def graded(tmp_path_factory):
    """The course's folder, graded by each of the two commands."""
    root = tmp_path_factory.mktemp("course") / "armdyn"
    (root / "solutions").mkdir(parents=True)
    shutil.copy(courses.ROOT / "nbgrader_config.py", root)
    shutil.copytree(courses.ROOT / "solutions" / P1, root / "solutions" / P1)
    path = root / "solutions" / P1 / f"{P1}.ipynb"
    source = nbformat.read(path, as_version=4)
    set_up = cell_of(source, "p1-setup")
    set_up.source = set_up.source.replace(", same_for_all=True", "")
    nbformat.write(source, path)
    courses.run(root, "nbgrader", "generate_assignment", P1)
    release = nbformat.read(root / "course" / "release" / P1 / f"{P1}.ipynb", as_version=4)
    for own in (MINE, THEIRS):
        folder = root / "course" / "submitted" / a_student_of(own) / P1
        folder.mkdir(parents=True)
        # Both hand in what is right for one of them.
        notebook = own_arms.right(release, P1, THEIRS)
        (folder / f"{P1}.ipynb").write_text(json.dumps(notebook))
    other = root.with_name("stock")
    shutil.copytree(root, other)
    courses.run(root, "autograder", "grade", P1, "--jobs", "1")
    courses.run(other, "nbgrader", "autograde", P1)
    return root, other


def scores(root, student) -> dict[str, float | None]:
    with Gradebook(courses.database(root)) as gradebook:
        grades = gradebook.find_submission_notebook(P1, P1, student).grades
        return {grade.name: grade.auto_score for grade in grades}


def test_both_commands_judge_each_student_by_the_own_arm(graded):
    for root in graded:
        assert scores(root, a_student_of(THEIRS))["p1-M"] == 4
        assert scores(root, a_student_of(MINE))["p1-M"] < 4
        assert scores(root, a_student_of(MINE))["p1-is_spd"] == 3
    assert scores(graded[0], a_student_of(MINE)) == scores(graded[1], a_student_of(MINE))


def test_the_feedback_page_shows_the_arm_and_names_the_copy(graded):
    root, _ = graded
    courses.run(root, "nbgrader", "generate_feedback", P1)
    student = a_student_of(MINE)
    page = (root / "course" / "feedback" / student / P1 / f"{P1}.html").read_text()
    assert f"This is the arm of {student}." in page
    assert MINE.zero_at[1] in page
    assert "Your answer is right for an arm whose" in page
