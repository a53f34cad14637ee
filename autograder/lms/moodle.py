"""Moodle's offline grading worksheet: its headings are in the site's language, its columns in one order.

The identifier ("Participant 1234"), the full name and what else tells who it is, the status, the grade,
the greatest grade, whether it can be changed, the time of the hand-in, that of the grade, comments.
"""

import re
from dataclasses import dataclass, field
from datetime import datetime, tzinfo
from pathlib import Path

from autograder.lms import moodle_time, sheet
from autograder.lms.sheet import Sheet, SheetError
from autograder.protocol import one_line

IDENTIFIER = re.compile(r"(\D*)(\d+)")
GRADE, MOST = "grade", ("maximum grade", "max grade")
TIME_OF_THE_GRADE = "last modified (grade)"


@dataclass
class Worksheet:
    """The sheet, and where its columns are. most: the points that the assignment gives in Moodle."""

    sheet: Sheet
    identifier: int
    grade: int
    most: float | None
    comma: bool
    _times: int | None = field(default=None, init=False)

    def number(self, row: list[str]) -> str:
        """The participant's number in this assignment."""
        found = IDENTIFIER.fullmatch(row[self.identifier].strip())
        return found[2] if found else ""

    def cells(self, row: list[str]) -> list[str]:
        """What a row says of who it is about."""
        return [cell for at, cell in enumerate(row[: self.grade]) if at != self.identifier]

    def name(self, row: list[str]) -> str:
        return next((cell for cell in self.cells(row) if cell.strip()), "")

    def handed_in(self, row: list[str], zone: tzinfo | None) -> datetime | None:
        """When it was handed in; None if the sheet does not say. ValueError if that cannot be read."""
        if self._times is None:
            self._times = self._column_of_times()
        cell = row[self._times].strip() if self._times else ""
        return moodle_time.read(cell, zone) if cell not in ("", "-") else None

    def _column_of_times(self) -> int:
        """The first with times behind the grade, which are those of the hand-ins; 0 if there is none."""
        for at in range(self.grade + 1, len(self.sheet.head)):
            cells = {row[at].strip() for row in self.sheet.rows} - {"", "-"}
            timely = [cell for cell in cells if moodle_time.is_like_one(cell)]
            if timely and len(timely) == len(cells):
                return 0 if self.sheet.head[at].strip().casefold() == TIME_OF_THE_GRADE else at
        return 0


def read(path: Path, grade: str | None = None) -> Worksheet:
    """The worksheet in a file. grade: the heading of the grades, where they are not found by themselves.

    SheetError if it is no such sheet, OSError if it cannot be read.
    """
    held = sheet.read(path)
    if not held.rows:
        raise SheetError(f"{path.name}: it has no row of a student")
    identifier = _identifier(held)
    at = held.column(grade) if grade else _grade(held, identifier)
    greatest = {row[at + 1].strip() for row in held.rows} if at + 1 < len(held.head) else set()
    only = greatest.pop() if len(greatest) == 1 else ""
    made = Worksheet(held, identifier, at, sheet.number(only), "," in only)
    held.delimiter = (
        ","  # whatever a spreadsheet made of it: most versions of Moodle take no other back
    )
    if not any(map(made.name, held.rows)):
        raise SheetError(
            f"{path.name}: it names nobody: reveal the students' names in Moodle first"
        )
    return made


def _identifier(held: Sheet) -> int:
    for at in range(len(held.head)):
        found = [IDENTIFIER.fullmatch(row[at].strip()) for row in held.rows]
        if all(found) and len({one[1] for one in found if one}) == 1:
            numbers = [one[2] for one in found if one]
            if twice := {number for number in numbers if numbers.count(number) > 1}:
                raise SheetError(f"{held.path.name}: two rows are about number {min(twice)}")
            return at
    raise SheetError(
        f"{held.path.name}: no column tells the participants, as Participant 1234: "
        "is it the grading worksheet of this assignment?"
    )


def _grade(held: Sheet, identifier: int) -> int:
    """Where the grades stand: before the greatest grade, which is the same number in all rows."""
    named = [name.strip().casefold() for name in held.head]
    if named.count(GRADE) == 1:
        return named.index(GRADE)
    found = [
        at
        for at in range(identifier + 1, len(held.head) - 1)
        if len(greatest := {row[at + 1].strip() for row in held.rows}) == 1
        and (sheet.number(greatest.pop()) or 0) > 0
        and all(
            row[at].strip() in ("", "-") or sheet.number(row[at]) is not None for row in held.rows
        )
    ]
    if len(found) != 1:
        shown = one_line(held.headings, 500)
        raise SheetError(
            f"{held.path.name}: it is not clear which column takes the grades: "
            f"name it with --grade-column; {shown}"
        )
    return found[0]
