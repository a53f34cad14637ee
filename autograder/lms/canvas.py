"""Canvas's gradebook as CSV: students by number, and a column "Title (1234)" for each assignment."""

import re
from dataclasses import dataclass
from pathlib import Path

from autograder.lms import sheet
from autograder.lms.sheet import Sheet, SheetError
from autograder.protocol import one_line
from autograder.roster import folded

POSSIBLE = "points possible"
READ_ONLY = re.compile(r"read\s+only", re.IGNORECASE)
# In place of a mark: the teacher has excused the student, or not assigned it.
EXCUSED, NOT_ASSIGNED = "EX", "N/A"
TITLE = re.compile(r"(.*) \((\d+)\)", re.DOTALL)
IDS = ("SIS User ID", "SIS Login ID", "Integration ID")


@dataclass
class Gradebook:
    """The sheet; rows: those about students. number_at, names_at, ids_at: where its columns are."""

    sheet: Sheet
    number_at: int
    names_at: list[int]
    ids_at: list[int]

    @property
    def rows(self) -> list[list[str]]:
        return [row for row in self.sheet.rows if row[self.number_at].strip()]

    def number(self, row: list[str]) -> str:
        return row[self.number_at].strip()

    def name(self, row: list[str]) -> str:
        return " ".join(row[at] for at in reversed(self.names_at))

    def is_test_student(self, row: list[str]) -> bool:
        """Canvas's own, with whom teachers try things."""
        return self.name(row).strip() in ("Student, Test", "Test Student")

    def cells(self, row: list[str]) -> list[str]:
        """What a row says of who it is about."""
        return [self.name(row), *(row[at] for at in self.ids_at)]

    def most(self, column: int) -> tuple[float | None, bool]:
        """The points that an assignment gives in Canvas, and whether they are written with a comma.

        SheetError if it is a column of Canvas's own, which it takes no marks into.
        """
        for row in self.sheet.rows:
            if POSSIBLE in row[0].casefold():
                if READ_ONLY.search(row[column]):
                    raise SheetError(
                        f"{self.sheet.path.name}: Canvas takes no marks into the column "
                        f"{one_line(self.sheet.head[column], 80)!r}: it is read only"
                    )
                return sheet.number(row[column]), "," in row[column]
        return None, False

    def column_of(self, assignment: str) -> int:
        """Where the marks of an assignment stand, by its title. SheetError if that is not clear."""
        named = [TITLE.fullmatch(name.strip()) for name in self.sheet.head]
        titles = {at: folded(one[1]) for at, one in enumerate(named) if one}
        wanted = folded(assignment)
        for found in (
            [at for at, title in titles.items() if title == wanted],
            [at for at, title in titles.items() if wanted in title],
        ):
            if len(found) == 1:
                return found[0]
        raise SheetError(
            f"{self.sheet.path.name}: it is not clear which column is {assignment}'s: name it with "
            f"--column '{assignment}=…', or name only the assignments that it has; "
            f"{one_line(self.sheet.headings, 500)}"
        )


def is_one(path: Path) -> bool:
    """Whether a sheet is Canvas's, by its first headings, which Canvas never translates."""
    return _begins(sheet.read(path).head)


def read(path: Path) -> Gradebook:
    """The gradebook in a file. SheetError if it is none, OSError if it cannot be read."""
    held = sheet.read(path)
    if not _begins(held.head):
        raise SheetError(
            f"{path.name}: it does not begin with the columns Student and ID: "
            "is it the gradebook that Canvas exports?"
        )
    named = [name.strip() for name in held.head]
    names = [named.index(name) for name in ("Student", "LastName", "FirstName") if name in named]
    ids = [named.index(name) for name in IDS if name in named]
    return Gradebook(held, named.index("ID"), names, ids)


def _begins(head: list[str]) -> bool:
    named = [name.strip() for name in head[:3]]
    return named[:2] == ["Student", "ID"] or named == ["LastName", "FirstName", "ID"]
