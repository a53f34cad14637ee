"""The class list, course/class.csv: who is in the class, and what a learning platform calls them.

Its first line names the columns: id, last_name, first_name, email, lms_id. Only `id`, the name of the
student's folder in course/submitted/, must be there.
"""

import csv
import io
import re
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass, field, fields
from pathlib import Path

FILE = Path("course") / "class.csv"
MOST_BYTES = 16 << 20
# A folder of this name could not be graded, or would lie elsewhere.
UNFIT_ID = re.compile(r"^\.|[/\\*?\[\x00-\x1f\x7f]|^.{129}")


class RosterError(ValueError):
    """The class list cannot be used; the message names the file and the line."""


@dataclass(frozen=True)
class Person:
    """One student. lms_id: what the platform calls the student, such as a number; "" if not known."""

    id: str
    last_name: str = ""
    first_name: str = ""
    email: str = ""
    lms_id: str = ""

    @property
    def name(self) -> str:
        """As people say it, or the id where no name is known."""
        return f"{self.first_name} {self.last_name}".strip() or self.id

    @property
    def keys(self) -> set[str]:
        """The full name in both orders, as `folded` writes it."""
        first, last = folded(self.first_name), folded(self.last_name)
        return {first + last, last + first} - {""}


COLUMNS = tuple(one.name for one in fields(Person))


@dataclass(frozen=True)
class Roster:
    """The students of a class, by id, in the order of the file."""

    people: dict[str, Person] = field(default_factory=dict)

    def find(self, texts: Iterable[str]) -> list[Person]:
        """Whose id, lms_id or address is one of these texts."""
        wanted = {text.strip().casefold() for text in texts} - {""}
        return [
            one
            for one in self.people.values()
            if wanted & {one.id.casefold(), one.lms_id.casefold(), one.email.casefold()}
        ]

    def named(self, name: str) -> list[Person]:
        """Who has this full name, in either order, whatever its capitals and signs."""
        wanted = folded(name)
        return [one for one in self.people.values() if wanted in one.keys] if wanted else []


def folded(name: str) -> str:
    """A name's letters and digits alone, in one case: platforms drop commas, spaces and apostrophes."""
    plain = unicodedata.normalize("NFKC", name).casefold()
    return "".join(character for character in plain if character.isalnum())


def read(path: Path) -> Roster:
    """The class list in a file. FileNotFoundError if there is none, RosterError if it is wrong."""
    if path.stat().st_size > MOST_BYTES:
        raise RosterError(f"{path}: it has more than {MOST_BYTES >> 20} MB; is it the class list?")
    if path.read_bytes()[:4] == b"PK\x03\x04":
        raise RosterError(f"{path}: it is a spreadsheet's own file: save it as CSV, in UTF-8")
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        line = path.read_bytes()[: error.start].count(b"\n") + 1
        raise RosterError(f"{path}, line {line}: it is not UTF-8; save the file as UTF-8") from None
    rows = csv.reader(io.StringIO(text, newline=""), delimiter=_delimiter(text))
    people: dict[str, Person] = {}
    try:
        columns = _columns(path, next(rows, []))
        for row in rows:
            if any(map(str.strip, row)):
                _add(people, row, columns, f"{path}, line {rows.line_num}")
    except csv.Error as error:
        raise RosterError(f"{path}, line {rows.line_num}: {error}") from None
    return Roster(people)


def read_if_there(root: Path) -> Roster | None:
    """The class list of the course in the folder `root`; None if it has none."""
    path = root / FILE
    return read(path) if path.is_file() else None


def without(path: Path, student: str) -> str:
    """The file's text without a student's rows; every other line stays as it is."""
    text = path.read_text(encoding="utf-8-sig")
    lines = text.splitlines(keepends=True)
    rows = csv.reader(lines, delimiter=_delimiter(text))
    columns, kept, before = _columns(path, next(rows, [])), lines[: rows.line_num], rows.line_num
    for row in rows:
        if _cell(row, columns["id"]) != student:
            kept += lines[before : rows.line_num]
        before = rows.line_num
    return "".join(kept)


def _delimiter(text: str) -> str:
    """The sign between the columns; a spreadsheet writes the one of its country."""
    head = text.splitlines()[0] if text.strip() else ""
    return max(",;\t", key=head.count)


def _columns(path: Path, head: list[str]) -> dict[str, int]:
    named = [re.sub(r"[\s-]+", "_", name.strip().casefold()) for name in head]
    if "id" not in named:
        raise RosterError(
            f"{path}, line 1: no column is called id; the first line is {','.join(COLUMNS)}"
        )
    others = [name.strip() for name in head if name.strip() and name.strip().casefold() != "id"]
    if others and not set(named) & set(COLUMNS[1:]):  # such as names in another language
        raise RosterError(
            f"{path}, line 1: of the columns {', '.join(others)}, none is known: call them "
            f"{', '.join(COLUMNS[1:])}, or leave them out"
        )
    if twice := [name for name in COLUMNS if named.count(name) > 1]:
        raise RosterError(f"{path}, line 1: two columns are called {twice[0]}")
    return {name: named.index(name) for name in COLUMNS if name in named}


def _add(people: dict[str, Person], row: list[str], columns: dict[str, int], where: str) -> None:
    one = Person(**{name: _cell(row, at) for name, at in columns.items()})
    if not one.id:
        raise RosterError(f"{where}: this student has no id")
    if UNFIT_ID.search(one.id):
        raise RosterError(f"{where}: {one.id[:60]!r} cannot be the name of a folder")
    for other in people.values():
        for name in ("id", "email", "lms_id"):
            mine, theirs = getattr(one, name), getattr(other, name)
            if mine and mine.casefold() == theirs.casefold():
                raise RosterError(f"{where}: {name} {mine!r} is that of a student above, too")
    people[one.id] = one


def _cell(row: list[str], at: int) -> str:
    return row[at].strip() if at < len(row) else ""
