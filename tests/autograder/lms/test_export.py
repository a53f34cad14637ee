"""`autograder export`: what counts, which options go together, and what a row a student adds up to."""

import csv
import io
import zipfile
from argparse import Namespace
from pathlib import Path

import pytest

from autograder.lms import export
from autograder.lms.feedback_archive import feedback_archive
from autograder.lms.marks import GRADED, UNREAD, Column, Mark, Marks
from autograder.lms.table import wide_table
from autograder.roster import Person
from autograder.term_calendar import Assignment, Calendar

NAMES = ("p1-inertia", "p3-pendulum", "c6-regressor")
PEOPLE = [Person("ada", "Lovelace", "Ada"), Person("bob")]
MARKS = Marks(
    PEOPLE,
    [
        Column("p1-inertia", 20.0, None, {"ada": Mark(GRADED, 12.5), "bob": Mark(UNREAD, 7.0)}),
        Column("p3-pendulum", 15.0, None, {"ada": Mark(GRADED, 0.0, 1.5, late=True)}),
        Column("c6-regressor", 10.0, None, {"ada": Mark(GRADED, 9.0), "bob": Mark(GRADED, 8.0)}),
    ],
)


def given(**options) -> Namespace:
    usual = {"platform": "csv", "sheet": None, "to": None, "wide": False, "count": None}
    usual |= {"leave_out": None, "assignment": [], "feedback": None, "with_unread": False}
    return Namespace(**(usual | options))


@pytest.mark.parametrize(
    ("options", "calendar", "counted", "said"),
    [
        ({}, {}, NAMES[:2], "not counted: c6-regressor (the challenges among them do not count by"),
        ({}, {"c6-regressor": Assignment(counts=True)}, NAMES, ""),
        ({}, {"p1-inertia": Assignment(counts=False)}, NAMES[1:2], "not counted: p1-inertia, c6"),
        (
            {"count": ["c6-regressor", "p1-inertia"]},
            {},
            (NAMES[0], NAMES[2]),
            "not counted: p3-pen",
        ),
        ({"leave_out": ["p1-inertia"]}, {}, NAMES[1:], "not counted: p1-inertia"),
        ({"assignment": ["p3-pendulum"]}, {}, NAMES[1:2], ""),
    ],
)
def test_what_counts(options, calendar, counted, said):
    marks, lines = export.chosen(MARKS, Calendar(calendar), given(**options))
    assert tuple(one.assignment for one in marks.columns) == counted
    assert " ".join(lines).startswith(said)
    assert bool(lines) == bool(said)


@pytest.mark.parametrize("option", ["assignment", "count", "leave_out"])
def test_what_is_not_there_is_named(option):
    with pytest.raises(
        ValueError, match="the gradebook does not know p9; it has p1-inertia, p3-pen"
    ):
        export.chosen(MARKS, Calendar(), given(**{option: ["p9"]}))


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"platform": "moodle"}, "give Moodle's grading worksheet with --sheet"),
        ({"platform": "canvas"}, "give the gradebook that Canvas exports with --sheet"),
        ({"sheet": Path("s.csv")}, "--sheet goes with --for moodle or --for canvas"),
        ({"platform": "moodle", "sheet": Path("s.csv")}, "about one assignment: name it"),
        ({"feedback": Path("f.zip")}, "--feedback goes with --for moodle"),
        (
            {"platform": "canvas", "sheet": Path("s.csv"), "wide": True},
            "--wide goes with --for csv",
        ),
        ({"count": ["a"], "leave_out": ["b"]}, "give --count or --leave-out, not both"),
        ({"assignment": ["a"], "count": ["b"]}, "name the assignments, or give --count"),
        (
            {"platform": "canvas", "sheet": Path("s.csv"), "to": Path("./s.csv")},
            "s.csv would overwrite the sheet that canvas gave out",
        ),
        ({"wide": True, "count": ["a"], "to": Path("x.csv")}, ""),
    ],
)
def test_options_that_do_not_go_together(options, said):
    refused = export.refusal(given(**options))
    assert said in refused
    assert bool(refused) == bool(said)


@pytest.mark.parametrize(("unread", "total", "still"), [(False, "0", "1"), (True, "7", "0")])
def test_a_row_a_student_adds_up_the_marks_that_there_are(unread, total, still):
    marks, _ = export.chosen(MARKS, Calendar(), given())
    ada, bob = csv.DictReader(io.StringIO(wide_table(marks, unread)))
    assert (ada["total"], ada["most"], ada["still_to_be_marked"]) == ("12.5", "35", "0")
    assert (ada["p3-pendulum"], ada["p3-pendulum status"]) == ("0", "graded, late, −1.5")
    assert (bob["total"], bob["still_to_be_marked"]) == (total, still)
    assert (bob["p3-pendulum"], bob["p3-pendulum status"]) == ("", "nothing handed in")


def test_a_name_is_no_path_and_no_second_number(tmp_path):
    page = tmp_path / "p3-pendulum.html"
    page.write_text("page")
    odd = Person("ada", "a_77_assignsubmission_file/../..", "..\\Ada:")
    data, without = feedback_archive({"12": odd, "13": PEOPLE[1]}, {"ada": [page]})
    assert without == ["bob"]
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        (name,) = archive.namelist()
    folder, file = name.split("/")
    assert file == page.name
    assert folder.split("_")[1:] == ["12", "assignfeedback", "file"]
    assert "\\" not in folder
    assert not folder.startswith(".")
