"""Where the reason is known, nbgrader's commands say it in a sentence; what they advise can be done."""

import logging
import shutil

import pytest
from sqlalchemy.exc import OperationalError

from autograder.nbgrader_glue import locked
from autograder.nbgrader_glue.in_words import InWords
from tests.autograder import courses
from tests.autograder.courses import P3, submit

FETCHED = (
    "Students fetch the older one until you run `nbgrader release_assignment p3-pendulum --force`"
)
OF_DATABASE = "There was an error accessing the nbgrader database. This may occur if you recently"


@pytest.fixture(scope="module")
def released(tmp_path_factory):
    """A course with p3 in the exchange, a hand-in, and an assignment of a short name beside it."""
    root = courses.new_course(tmp_path_factory.mktemp("released") / "course")
    shutil.copytree(root / "solutions" / P3, root / "solutions" / "crane")
    submit(root, "ada", courses.release(root))
    courses.run(root, "nbgrader", "release_assignment", P3)
    return root


@pytest.mark.parametrize("step", ["generate_assignment", "release_assignment", "autograde"])
def test_a_name_that_is_near_is_suggested_and_no_other(released, step):
    assert "Did you mean p3-pendulum?" in courses.run(released, "nbgrader", step, "p3", status=1)
    assert "Did you mean" not in courses.run(released, "nbgrader", step, "zzz", status=1)


def test_a_lost_gradebook_is_one_sentence_a_student(released):
    book = released / "course" / "gradebook.db"
    kept = book.rename(book.with_suffix(".kept"))
    try:
        said = courses.run(released, "nbgrader", "autograde", P3, status=1)
    finally:
        kept.replace(book)
    assert "No assignment with ID 'p3-pendulum' exists in the database" in said
    assert "Traceback" not in said


def test_a_wrong_calendar_is_a_sentence(released):
    file = released / "course" / "calendar.toml"
    file.write_text('[p3-pendulum]\ndue = "never"\n')
    try:
        said = courses.run(released, "nbgrader", "autograde", P3, status=1)
    finally:
        file.unlink()
    *before, last = said.splitlines()
    assert last.startswith(f"[AutogradeApp | ERROR] {file}, line 2: 'never' is no time")
    assert all("bubblewrap" in line for line in before)  # where it is not installed


def test_feedback_that_is_not_there_is_not_released(released):
    said = courses.run(released, "nbgrader", "release_feedback", P3)
    assert "There are no pages of p3-pendulum to release: `nbgrader generate_feedback" in said


def test_students_fetch_an_older_one_only_if_it_differs(released):
    again = ("nbgrader", "generate_assignment", P3, "--force")
    assert FETCHED not in courses.run(released, *again)
    (released / "solutions" / P3 / "new.txt").write_text("new")
    assert FETCHED in courses.run(released, *again)


def said(error: Exception, text: str) -> str:
    """What is logged where nbgrader logs the text, while it handles the error; "" if nothing is."""
    record = logging.LogRecord("nbgrader", logging.ERROR, "", 0, text, (), None)
    try:
        raise error
    except Exception:
        return record.getMessage() if InWords().filter(record) else ""


def test_an_error_that_nobody_foresaw_keeps_its_traceback():
    text = "Traceback (most recent call last):\n  ...\nKeyError: 'x'"
    assert said(KeyError("x"), text) == text
    refused = PermissionError(13, "Permission denied", "course/x.ipynb")
    assert said(refused, text) == "course/x.ipynb: Permission denied"


@pytest.mark.parametrize(
    ("why", "advises"), [("database is locked", False), ("no such column: x", True)]
)
def test_an_upgrade_is_advised_only_where_it_may_help(why, advises):
    error = OperationalError("SELECT", {}, Exception(why))
    assert (said(error, OF_DATABASE) == OF_DATABASE) is advises
    assert (said(error, "Traceback (most recent call last)") == locked.LOCKED) is not advises
