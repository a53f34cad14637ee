"""Platforms' sheets: the right columns in any language, the marks in them, and nothing else changed."""

import csv
import io
from datetime import datetime
from pathlib import Path
from zoneinfo import ZoneInfo

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.lms import canvas, moodle, sheet
from autograder.lms.fill import fill_gradebook, fill_worksheet
from autograder.lms.marks import GRADED, UNREAD, UNREADABLE, Column, Mark, Marks
from autograder.lms.sheet import SheetError
from autograder.roster import Person, Roster
from tests.autograder.lms.platforms import MOODLE_HEADINGS, canvas_sheet, moodle_sheet

P3 = "p3-pendulum"
PEOPLE = [
    Person("ada", "Lovelace", "Ada", "ada@x.org", "11"),
    Person("bob", "Doe, Jr.", "Bob", "bob@x.org", "12"),
    Person("eve", "O'Neil", "Ève", "eve@x.org", "13"),
    Person("gus", "Gauß", "Gus", "gus@x.org", "14"),
    Person("nil", "Nihil", "Nil", "nil@x.org", "15"),
]
ROSTER = Roster({one.id: one for one in PEOPLE})
COLUMN = Column(
    P3,
    15.0,
    None,
    {
        "ada": Mark(GRADED, 12.345),
        "bob": Mark(GRADED, 0.0),
        "eve": Mark(UNREAD, 9.5),
        "gus": Mark(UNREADABLE),
    },
)
TIME = "Sonntag, 29. November 2026, 23:03"
ROWS = [
    {"number": 100 + at, "name": one.name, "email": one.email, "submitted": TIME}
    for at, one in enumerate(PEOPLE[:4])
] + [{"number": 200, "name": "Nil Nihil", "email": "nil@x.org", "grade": "3,00"}]  # fmt: skip


def table(text: str, sign: str = ",") -> list[list[str]]:
    return list(csv.reader(io.StringIO(text.removeprefix("\ufeff"), newline=""), delimiter=sign))


@pytest.mark.parametrize("language", list(MOODLE_HEADINGS))
def test_moodles_sheet_takes_marks_and_keeps_the_rest(tmp_path, language):
    path = moodle_sheet(tmp_path / "s.csv", ROWS, language, "15,00")
    before = table(path.read_text())
    held = moodle.read(path)
    filled, found = fill_worksheet(held, COLUMN, ROSTER)
    after = table(held.sheet.text())
    assert [row[4] for row in after[1:]] == ["12,345", "0", "", "", "3,00"]  # a missing one is no 0
    assert [row[:4] + row[5:] for row in after] == [row[:4] + row[5:] for row in before]
    assert after[0] == before[0]
    assert filled.marks == 2
    assert dict(filled.left) == {UNREAD: 1, UNREADABLE: 1, "nothing handed in": 1}
    assert filled.faults == []
    assert {number: one.id for number, one in found.items()} == {
        "100": "ada", "101": "bob", "102": "eve", "103": "gus", "200": "nil"
    }  # fmt: skip
    berlin = ZoneInfo("Europe/Berlin")
    assert held.handed_in(held.sheet.rows[0], berlin) == datetime(
        2026, 11, 29, 23, 3, tzinfo=berlin
    )
    assert held.handed_in(held.sheet.rows[4], berlin) is None


def test_what_is_suggested_counts_if_one_asks(tmp_path):
    held = moodle.read(moodle_sheet(tmp_path / "s.csv", ROWS))
    fill_worksheet(held, COLUMN, ROSTER, unread=True)
    assert [row[held.grade] for row in held.sheet.rows] == ["12.345", "0", "9.5", "", "3,00"]


@pytest.mark.parametrize(
    ("scale", "most", "marks"), [(True, "100.00", ["82.3", "0"]), (False, "15", ["12.345", "0"])]
)
def test_other_points_on_the_platform(tmp_path, scale, most, marks):
    held = moodle.read(moodle_sheet(tmp_path / "s.csv", ROWS, most=most))
    fill_worksheet(held, COLUMN, ROSTER, scale=scale)
    assert [row[4] for row in held.sheet.rows[:2]] == marks


def test_other_points_are_refused_unless_one_asks(tmp_path):
    held = moodle.read(moodle_sheet(tmp_path / "s.csv", ROWS, most="100.00"))
    with pytest.raises(SheetError, match=r"there it gives 100 points, here 15: .* or add --scale"):
        fill_worksheet(held, COLUMN, ROSTER)


def test_columns_that_a_site_adds_do_not_matter(tmp_path):
    """An ID number of digits, a group, a marker, a workflow; and a column of one number all the way."""
    head = [
        "ID",
        "Name",
        "Matrikel",
        "Status",
        "Gruppe",
        "Note",
        "Max",
        "Workflow",
        "Änderbar",
        "Abgabe",
    ]
    rows = [["Teilnehmer/in7", "Ada Lovelace", "42", "x", "A", "", "15,00", "offen", "Ja", "-"]]
    (tmp_path / "s.csv").write_text("\n".join(map(";".join, [head, *rows])))
    held = moodle.read(tmp_path / "s.csv")
    assert (held.identifier, held.grade, held.most) == (0, 5, 15.0)
    assert held.sheet.text().startswith("ID,Name,Matrikel,")  # Moodle reads commas alone


def test_where_it_is_not_clear_one_is_asked_and_can_tell(tmp_path):
    head = "ID,Name,A,B,C,D\n"
    (tmp_path / "s.csv").write_text(f"{head}P 1,Ada Lovelace,,15,,20\n")
    with pytest.raises(
        SheetError, match=r"name it with --grade-column; the columns are ID, Name, A, B"
    ):
        moodle.read(tmp_path / "s.csv")
    held = moodle.read(tmp_path / "s.csv", "C")
    assert (held.grade, held.most) == (4, 20.0)
    with pytest.raises(SheetError, match="no column is called 'E'"):
        moodle.read(tmp_path / "s.csv", "E")


def test_who_is_not_known_or_twice_gets_nothing_and_is_named(tmp_path):
    rows = [
        {"number": 1, "name": "Ada Lovelace"},
        {"number": 2, "name": "Ada Lovelace", "email": "ada@y.org"},
        {"number": 3, "name": "Nobody"},
    ]
    held = moodle.read(moodle_sheet(tmp_path / "s.csv", rows))
    filled, found = fill_worksheet(held, COLUMN, ROSTER)
    assert [row[4] for row in held.sheet.rows] == ["", "", ""]
    assert found == {}
    said = " | ".join(filled.faults)
    assert "2 rows would be ada's, and stay as they were" in said
    assert "Nobody is not in course/class.csv" in said
    assert "bob has a mark, but no row in the sheet" in said


BOOK = [
    {"name": "Lovelace, Ada", "number": 11, "login": "ada@x.org"},
    {"name": "Doe, Jr., Bob", "number": 12, "marks": {"P3 Pendulum (501)": "7"}},
    {"name": "O'Neil, Ève", "number": 13, "marks": {"P3 Pendulum (501)": "EX"}},
    {"name": '="Gauß, Gus"', "number": 14},
]


@pytest.mark.parametrize(("sign", "bom"), [(",", False), (";", True)])
def test_canvas_takes_marks_and_keeps_the_rest(tmp_path, sign, bom):
    titles = {"P1 (500)": "15.00", "P3 Pendulum (501)": "15.00", "P3 Pendulum, extra (502)": "5"}
    path = canvas_sheet(tmp_path / "b.csv", BOOK, titles, sign, bom)
    before = table(path.read_text(encoding="utf-8"), sign)
    held = canvas.read(path)
    at = held.column_of(P3)
    filled = fill_gradebook(held, Marks(PEOPLE, [COLUMN]), {P3: at}, ROSTER)
    text = held.sheet.text()
    after = table(text, sign)
    assert text.startswith("\ufeff") == bom
    assert [row[at] for row in after] == [
        "P3 Pendulum (501)", "Manual Posting", "15.00", "12.345", "0", "EX", "", ""
    ]  # fmt: skip
    before[6][0] = f"'{before[6][0]}"  # Canvas's own way to keep a name from being a formula is one
    assert [row[:at] + row[at + 1 :] for row in after] == [
        row[:at] + row[at + 1 :] for row in before
    ]
    assert filled.marks == 2
    assert filled.faults == []


def test_what_canvas_will_not_take_is_left_and_said(tmp_path):
    """A mark would end an excuse; and one for whom it is not assigned is dropped without a word."""
    title = "P3 Pendulum (501)"
    marks = {11: "EX", 12: "N/A", 13: "", 14: "1"}
    rows = [{"name": f"{one.last_name}, {one.first_name}", "number": int(one.lms_id),
             "marks": {title: marks[int(one.lms_id)]}} for one in PEOPLE[:4]]  # fmt: skip
    held = canvas.read(canvas_sheet(tmp_path / "b.csv", rows, {title: "15"}))
    of = {one.id: Mark(GRADED, 9.0) for one in PEOPLE[:4]}
    column = Column(P3, 15.0, None, of)
    filled = fill_gradebook(held, Marks(PEOPLE, [column]), {P3: 5}, ROSTER)
    assert [row[5] for row in held.rows[:4]] == ["EX", "N/A", "9", "9"]
    assert filled.marks == 2
    assert dict(filled.left) == {
        "excused in Canvas": 1, "not assigned to the student in Canvas": 1,
    }  # fmt: skip


def test_a_column_that_canvas_only_shows_is_refused(tmp_path):
    path = canvas_sheet(tmp_path / "b.csv", BOOK, {"P3 Pendulum (501)": "(read  only)"})
    held = canvas.read(path)
    with pytest.raises(
        SheetError, match=r"takes no marks into the column 'P3 Pendulum .*read only"
    ):
        fill_gradebook(held, Marks(PEOPLE, [COLUMN]), {P3: 5}, ROSTER)


def test_canvas_sheet_with_names_in_two_columns(tmp_path):
    """As an account may set it; the student with whom teachers try things is nobody there, either."""
    path = canvas_sheet(tmp_path / "b.csv", [], {"P3 Pendulum (501)": "15"})
    head = "LastName,FirstName,ID,SIS Login ID,Section,P3 Pendulum (501)\n"
    rows = "    Points Possible,,,,,15\nLovelace,Ada,11,,G,\nStudent,Test,99,a8f3,G,\n"
    path.write_text(head + rows)
    held = canvas.read(path)
    filled = fill_gradebook(held, Marks(PEOPLE[:1], [COLUMN]), {P3: 5}, Roster({"ada": PEOPLE[0]}))
    assert filled.faults == []
    assert [row[5] for row in held.rows] == ["12.345", ""]


def test_a_column_that_no_title_tells_is_asked_for(tmp_path):
    held = canvas.read(canvas_sheet(tmp_path / "b.csv", BOOK, {"Homework 3 (7)": "15"}))
    with pytest.raises(
        SheetError, match=r"--column 'p3-pendulum=…', or name only .*; the columns are Student"
    ):
        held.column_of(P3)


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"PK\x03\x04", "it is a workbook and not CSV"),
        (b"", "it is empty"),
        (b"a,b\n", "it has no row of a student"),
        (b"a,b\n1,2,3\n", "has more cells than there are headings"),
        (b"a,b\nx,y\n", "no column tells the participants"),
        (b"Name\xfc,b\nx,y\n", "it is not UTF-8"),
        (b"ID,x,Grade,Max\nP 1,a,,15\nP 1,b,,15\n", "two rows are about number 1"),
        (b"ID,Status,Grade,Max\nP 1,,,15\nP 2,,,15\n", "it names nobody: reveal the students'"),
    ],
)
def test_what_is_no_sheet_is_refused_in_a_sentence(tmp_path, data, said):
    (tmp_path / "s.csv").write_bytes(data)
    with pytest.raises(SheetError, match=r"s\.csv") as refused:
        moodle.read(tmp_path / "s.csv")
    assert said in str(refused.value)


def test_a_sheet_saved_by_excel_as_unicode_text_is_read(tmp_path):
    path = moodle_sheet(tmp_path / "s.csv", ROWS)
    path.write_bytes(path.read_text().replace(",", "\t").encode("utf-16"))
    assert moodle.read(path).sheet.rows[0][1] == "Ada Lovelace"


CELLS = st.text(max_size=12) | st.text("=+-@\t\r\n'\" ,;1＝", max_size=6)


@given(st.lists(st.lists(CELLS, min_size=3, max_size=3), min_size=1, max_size=4))
def test_no_cell_that_is_written_starts_a_formula(rows):
    held = sheet.Sheet(Path("any.csv"), ["a", "b", "c"], rows)
    for row, given_out in zip(table(held.text())[1:], rows, strict=True):
        for cell, was in zip(row, given_out, strict=True):
            number = cell == "-" or sheet.NUMBER.fullmatch(cell)
            assert number or not cell.startswith(("=", "+", "-", "@", "\t", "\r", "\n", "＝"))
            assert cell in (was, f"'{was}")
