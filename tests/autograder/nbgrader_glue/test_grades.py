"""`nbgrader export`: nbgrader's own table, in which no text is a formula, and no name breaks a row."""

import csv
import re
import warnings

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from nbgrader.api import Gradebook
from nbgrader.plugins import CsvExportPlugin

from autograder.lms.sheet import harmless
from autograder.nbgrader_glue.grades import GradesExporter
from tests.autograder import courses
from tests.autograder.courses import P3

STRANGE = {
    "=HYPERLINK(\"http://x\")": {"last_name": "Gauß, C. F.", "first_name": 'the "prince"'},
    "-1+1": {"last_name": "two\nlines", "first_name": "\t=1", "email": "a\rb"},
    "'=1": {"email": "@sum(a1)"},
}  # fmt: skip


@pytest.fixture(scope="module")
def gradebook(tmp_path_factory):
    root = courses.new_course(tmp_path_factory.mktemp("grades") / "course")
    with Gradebook(courses.database(root)) as gradebook, warnings.catch_warnings():
        warnings.simplefilter("ignore")  # SQLAlchemy's, about nbgrader's way with it
        gradebook.update_or_create_assignment(P3, duedate="2026-03-08 10:00:00 UTC")
        gradebook.add_student("ada", last_name="Lovelace", first_name="Ada", email="ada@x.org")
        gradebook.add_student("nobody")
        gradebook.add_submission(P3, "ada", timestamp="2026-03-01 10:00:00 UTC")
        grade = gradebook.find_grade("p3-M", P3, P3, "ada")
        grade.auto_score = 0.5
        gradebook.find_submission_notebook(P3, P3, "ada").late_submission_penalty = 0.25
        gradebook.db.commit()
        yield gradebook


@pytest.mark.parametrize("wanted", [{}, {"student": ["ada"]}, {"assignment": ["p1-inertia"]}])
def test_plain_rows_are_nbgraders(gradebook, tmp_path, wanted):
    theirs, ours = tmp_path / "theirs.csv", tmp_path / "ours.csv"
    CsvExportPlugin(to=str(theirs), **wanted).export(gradebook)
    GradesExporter(to=str(ours), **wanted).export(gradebook)
    assert ours.read_bytes() == theirs.read_bytes()
    assert ("ada,Lovelace,Ada,ada@x.org,0.5,0.25,0.25,15.0" in ours.read_text()) == (
        "assignment" not in wanted
    )


def test_strange_names_stay_in_their_cells(gradebook, tmp_path):
    for student, about in STRANGE.items():
        gradebook.add_student(student, **about)
    table = tmp_path / "grades.csv"
    GradesExporter(to=str(table)).export(gradebook)
    with table.open(newline="", encoding="utf-8") as file:
        rows = {row["student_id"]: row for row in csv.DictReader(file)}
    for student, about in STRANGE.items():
        row = rows[f"'{student}"]
        assert None not in row
        assert {key: row[key] for key in about} == {key: harmless(v) for key, v in about.items()}
        gradebook.remove_student(student)
    assert rows["'-1+1"]["first_name"] == "'\t=1"
    assert rows['\'=HYPERLINK("http://x")']["last_name"] == "Gauß, C. F."


def undone(cell: str) -> str:
    """What the guide says that an importer does."""
    return cell[1:] if re.match(r"'[\s']*[=+\-@＝＋－＠]|'+[\t\r\n]", cell) else cell


IDS = st.text(max_size=8) | st.text("'=+-@\t\r\n aＡ＝", max_size=6)


@given(IDS)
@example("'=1")
@example(" =1")
def test_no_cell_is_a_formula_and_no_id_is_lost(student):
    cell = harmless(student)
    assert not re.match(r"\s*[=+\-@＝＋－＠]|[\t\r\n]", cell)
    assert undone(cell) == student
