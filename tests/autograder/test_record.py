"""`autograder grade` leaves what `nbgrader autograde` leaves: row for row, file for file."""

import shutil
import warnings
from types import SimpleNamespace

import nbformat
import pytest
from nbgrader.api import Gradebook

from autograder.cli import main
from tests.autograder import courses
from tests.autograder.courses import NOTEBOOK, P3, files, rows, submit
from tests.submissions import p3_pendulum

WHOLE = ("right", "wrong", "partly_right", "blank", "crashing", "mangled")
ON_TIME, LATE = "2026-03-01 10:00:00 UTC", "2026-03-09 10:00:00 UTC"


@pytest.fixture(scope="module")
def pair(tmp_path_factory):
    """The same course graded by nbgrader, and by us."""
    theirs = courses.new_course(tmp_path_factory.mktemp("pair") / "theirs")
    with (theirs / "nbgrader_config.py").open("a") as config:
        config.write('c.LateSubmissionPlugin.penalty_method = "zero"\n')
    with Gradebook(courses.database(theirs)) as gradebook, warnings.catch_warnings():
        warnings.simplefilter("ignore")  # SQLAlchemy's, about nbgrader's way with it
        gradebook.update_or_create_assignment(P3, duedate="2026-03-08 10:00:00 UTC")
        gradebook.add_student("excused", first_name="Emmy")
        gradebook.add_submission(P3, "excused")
        gradebook.grant_extension(P3, "excused", days=3)
    release = courses.release(theirs)
    for name in WHOLE:
        submit(theirs, name, p3_pendulum.CLASS[name](release), ON_TIME)
    submit(theirs, "late", p3_pendulum.partly_right(release), LATE)
    submit(theirs, "excused", p3_pendulum.partly_right(release), LATE)
    folder = submit(theirs, "with_files", p3_pendulum.right(release)).parent
    (folder / "pendulum.svg").write_text("the student's own")
    (folder / "data").mkdir()
    (folder / "data" / "run.csv").write_text("t,q\n")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        old = nbformat.writes(p3_pendulum.right(release), version=3)
    submit(theirs, "format_3", old)
    submit(theirs, "invalid", '{"cells": [', ON_TIME)
    submit(theirs, "no_cells", '{"nbformat": 4, "nbformat_minor": 5, "metadata": {}}')
    submit(theirs, "misnamed", p3_pendulum.right(release)).rename(
        theirs / "course" / "submitted" / "misnamed" / P3 / "homework.ipynb"
    )
    submit(theirs, "empty", "").unlink()
    ours = theirs.parent / "ours"
    shutil.copytree(theirs, ours)
    courses.run(theirs, "nbgrader", "autograde", P3, status=1)
    printed = courses.run(ours, "autograder", "grade", P3, "--jobs", "2", status=1)
    return SimpleNamespace(both=(theirs, ours), ours=ours, printed=printed)


@pytest.mark.parametrize("table", courses.TABLES)
def test_rows_are_nbgraders(pair, table):
    theirs, ours = (rows(courses.database(root))[table] for root in pair.both)
    assert ours == theirs
    assert len(ours) >= len(WHOLE)


def test_files_are_nbgraders(pair):
    theirs, ours = (files(root / "course" / "autograded") for root in pair.both)
    assert ours.keys() == theirs.keys()
    for name, expected in theirs.items():
        assert ours[name] == expected, name


def test_what_was_tested_is_not_trivial(pair):
    found = rows(courses.database(pair.ours))
    penalties = {row["assignment_id"]: row["late_submission_penalty"]
                 for row in map(dict, found["submitted_notebook"])}  # fmt: skip
    assert penalties[f"late/{P3}"] == 6.5
    assert penalties[f"excused/{P3}"] is None
    scores = [row["auto_score"] for row in map(dict, found["grade"])
              if row["notebook_id"] == f"format_3/{P3}/{P3}"]  # fmt: skip
    assert sum(filter(None, scores)) == 10


@pytest.mark.parametrize(
    "line",
    [
        "right 10 of 15 6 correct, 1 to be read",
        f"invalid could not be graded {NOTEBOOK} is not valid JSON: ask for it again",
        "format_3 10 of 15 6 correct, 1 to be read the notebook was in format 3; it was converted",
        f"misnamed could not be graded there is no {NOTEBOOK}",
        f"empty could not be graded there is no {NOTEBOOK}",
        "p3-M was there more than once; the last one counts",
        "10 graded, 0 unchanged, 4 could not be graded",
    ],
)
def test_table_says(pair, line):
    assert line in " ".join(pair.printed.split())


def test_a_persons_marks_stay(pair, monkeypatch, capsys):
    root = pair.ours
    monkeypatch.chdir(root)
    with Gradebook(courses.database(root)) as gradebook:
        grade = gradebook.find_grade("p3-derivation", P3, P3, "right")
        grade.manual_score, grade.needs_manual_grade = 4.0, False
        gradebook.db.commit()
    before = rows(courses.database(root))
    assert main(["grade", P3, "--jobs", "1"]) == 1
    said = capsys.readouterr().out
    assert "right 14 of 15 6 correct" in " ".join(said.split())
    assert "0 graded, 10 unchanged" in said
    assert rows(courses.database(root)) == before


def test_what_is_gone_is_put_back(pair, monkeypatch, capsys):
    root = pair.ours
    monkeypatch.chdir(root)
    before = rows(courses.database(root)), files(root / "course" / "autograded")
    shutil.rmtree(root / "course" / "autograded" / "wrong")
    (root / "course" / "autograded" / "blank" / P3 / NOTEBOOK).chmod(0o644)
    (root / "course" / "autograded" / "blank" / P3 / NOTEBOOK).write_text("{}")
    with Gradebook(courses.database(root)) as gradebook:
        gradebook.find_grade("p3-M", P3, P3, "partly_right").auto_score = 0.5
        gradebook.db.commit()
    assert main(["grade", P3, "--jobs", "1"]) == 1
    assert "3 graded, 7 unchanged" in capsys.readouterr().out
    assert (rows(courses.database(root)), files(root / "course" / "autograded")) == before
