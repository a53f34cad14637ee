"""What lines suggest stands on a feedback page until a person decides, and not beside another mark."""

import pytest
from nbgrader.api import Gradebook

from autograder.cli import main
from tests.autograder import courses
from tests.autograder.courses import P3
from tests.autograder.proofs.models import models
from tests.submissions.answers import answered, cell_of

CELL = "p3-derivation", P3, P3
LINES = "p3-L: all 5 lines hold."
SUGGESTED = "The lines suggest 1 of 5 points: row 3 of the table."


def decide(root, student: str, points: float | None, comment: str | None = None) -> None:
    """As the formgrader does: a score that is left as it is stays empty."""
    with Gradebook(courses.database(root)) as gradebook:
        grade = gradebook.find_grade(*CELL, student)
        grade.manual_score, grade.needs_manual_grade = points, False
        gradebook.find_comment(*CELL, student).manual_comment = comment
        gradebook.db.commit()


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    root = courses.new_course(tmp_path_factory.mktemp("decided") / "course")
    lines = f"def pendulum_lines():\n    return {models()['p3-L']!r}"
    notebook = answered(courses.release(root), **{"p3-L": lines})
    cell_of(notebook, "p3-derivation").source = "I am sure."
    students = ("unread", "other", "same", "accepted", "told")
    for student in students:
        courses.submit(root, student, notebook)
    with pytest.MonkeyPatch.context() as patched:
        patched.chdir(root)
        assert main(["grade", P3, "--jobs", "1"]) == 0
    decide(root, "other", 0.0)
    decide(root, "same", 1.0)
    decide(root, "accepted", None)
    decide(root, "told", 0.0, "Where is the pivot?")
    courses.run(root, "nbgrader", "generate_feedback", P3)
    folder = root / "course" / "feedback"
    return {student: (folder / student / P3 / f"{P3}.html").read_text() for student in students}


def test_until_a_person_decides_the_page_says_what_is_suggested(pages):
    assert f"{LINES} {SUGGESTED}" in pages["unread"]


@pytest.mark.parametrize("student", ["other", "same", "accepted"])
def test_then_it_says_what_stays_true(pages, student):
    assert LINES in pages[student]
    assert "The lines suggest" not in pages[student]


def test_a_persons_own_comment_stands_alone(pages):
    assert "Where is the pivot?" in pages["told"]
    assert "The lines suggest" not in pages["told"]
    assert LINES not in pages["told"]


def test_the_card_promises_no_points(pages):
    for page in pages.values():
        assert "The person who reads your text decides on it." in page
