"""Finds the student of the class list whom a platform means."""

import re
from collections.abc import Iterable

from autograder.protocol import one_line
from autograder.roster import FILE, Person, Roster, folded


class UnknownError(ValueError):
    """It is not certain who is meant; the message says why, and what to do."""


class NobodyError(UnknownError):
    """Nobody of the class list is meant."""


def who(roster: Roster, name: str, cells: Iterable[str] = (), lms_id: str = "") -> Person:
    """The student, by the platform's number, by what its sheet says, or by the name.

    cells: the sheet's words for the student, such as name, address and ids. UnknownError if nobody is
    meant, or several may be.
    """
    cells = [cell for cell in cells if cell.strip()]
    shown = one_line(next((cell for cell in cells if re.search(r"[^\W\d]", cell)), name), 80)
    numbered = [one for one in roster.people.values() if lms_id and one.lms_id == lms_id]
    for found in (numbered, roster.find(cells), _named(roster, [*cells, name])):
        if len(found) == 1:
            return found[0]
        if found:
            ids = ", ".join(sorted(one.id for one in found))
            raise UnknownError(
                f"{shown} may be any of {ids}: put what the platform calls them into the column "
                f"lms_id or email of {FILE}, and give its sheet with --sheet"
            )
    raise NobodyError(f"{shown} is not in {FILE}: add the student, or mend the name there")


def _named(roster: Roster, names: list[str]) -> list[Person]:
    found = {one.id: one for name in names for one in roster.named(name)}
    return list(found.values())


def differs(person: Person, name: str) -> bool:
    """Whether the platform's name of somebody is quite another than that of the class list."""
    known = {key for part in (person.first_name, person.last_name) if (key := folded(part))}
    return bool(known) and not any(part in folded(name) for part in known)
