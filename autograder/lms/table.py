"""A class's marks as a table of our own: a row a student and assignment, or a row a student."""

from datetime import datetime

from autograder.lms.marks import NOTHING, Marks
from autograder.lms.sheet import as_csv, harmless, written
from autograder.roster import Person

ABOUT = ("student", "last_name", "first_name", "email")
LONG = (*ABOUT, "assignment", "due_utc", "handed_in_utc", "points", "most", "penalty", "status")


def long_table(marks: Marks, unread: bool = False) -> str:
    """A row a student and assignment. unread: with what is suggested for proofs that nobody has read."""
    rows = []
    for person in marks.people:
        for column in marks.columns:
            mark = column.of(person.id)
            points = mark.so_far if unread else mark.points
            when = (_time(column.due), _time(mark.handed_in))
            taken = "" if points is None else written(mark.penalty)
            scores = (_points(points), written(column.most), taken)
            rows.append([*_about(person), column.assignment, *when, *scores, mark.status])
    return _text([LONG, *rows])


def wide_table(marks: Marks, unread: bool = False) -> str:
    """A row a student: points and status of each assignment, and the sum of the marks that there are."""
    names = [one.assignment for one in marks.columns]
    heads = [part for name in names for part in (name, f"{name} status")]
    head = [*ABOUT, *heads, "total", "most", "still_to_be_marked"]
    rows = []
    for person in marks.people:
        found = [column.of(person.id) for column in marks.columns]
        points = [mark.so_far if unread else mark.points for mark in found]
        cells = [part for one, mark in zip(points, found, strict=True)
                 for part in (_points(one), mark.status)]  # fmt: skip
        total = sum(one for one in points if one is not None)
        # What somebody still has to mark; what was not handed in is no open question.
        still = sum(one is None and mark.state != NOTHING
                    for one, mark in zip(points, found, strict=True))  # fmt: skip
        most = sum(column.most for column in marks.columns)
        rows.append([*_about(person), *cells, written(total), written(most), str(still)])
    return _text([head, *rows])


def _about(person: Person) -> list[str]:
    return [person.id, person.last_name, person.first_name, person.email]


def _points(points: float | None) -> str:
    return "" if points is None else written(points)


def _time(when: datetime | None) -> str:
    return when.isoformat(sep=" ", timespec="seconds") if when else ""


def _text(rows) -> str:
    return as_csv([harmless(cell) for cell in row] for row in rows)
