"""The calendar of a term, course/calendar.toml: due dates, late penalties, extensions, and what counts.

time-zone = "Europe/Berlin"
penalty = { percent-per-day = 10, most-percent = 50 }

[p3-pendulum]
due = 2026-11-29T18:00
penalty = "zero"

[p3-pendulum.extensions]
ada = "2026-12-02 18:00"

[c6-regressor]
counts = true
"""

import difflib
import math
import re
import tomllib
from contextlib import suppress
from dataclasses import dataclass, field
from datetime import UTC, date, datetime, time, tzinfo
from pathlib import Path
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

from autograder import roster

FILE = Path("course") / "calendar.toml"
DAY = 24 * 60 * 60  # seconds
CHALLENGE = re.compile(r"c\d+-")  # c6-regressor: no part of the mark unless the calendar says so
OF_AN_ASSIGNMENT = ("due", "penalty", "counts", "extensions")
OF_A_PENALTY = ("points-per-day", "percent-per-day", "most-points", "most-percent", "grace-minutes")


class CalendarError(ValueError):
    """The calendar cannot be used; the message names the file and the line."""


@dataclass(frozen=True)
class Penalty:
    """What a late hand-in loses for each day that has begun, and at most; percent are of its points."""

    points_per_day: float = 0.0
    percent_per_day: float = 0.0
    most_points: float = math.inf
    most_percent: float = 100.0
    grace_minutes: float = 0.0

    def of(self, points: float, seconds: float) -> float:
        """The points that a hand-in with `points` loses if it is this late; at most `points`."""
        late = seconds - 60 * self.grace_minutes
        if late <= 0:
            return 0.0
        days = math.ceil(late / DAY)
        lost = days * (self.points_per_day + self.percent_per_day / 100 * points)
        most = min(self.most_points, self.most_percent / 100 * points)
        return max(0.0, min(lost, most, points))


NONE = Penalty()
ZERO = Penalty(percent_per_day=100.0)


@dataclass(frozen=True)
class Assignment:
    """What the calendar says of one assignment. due, extensions (by student): with their zones.

    penalty: None if the calendar names none. counts: None if it does not say.
    """

    due: datetime | None = None
    penalty: Penalty | None = None
    counts: bool | None = None
    extensions: dict[str, datetime] = field(default_factory=dict)

    def due_for(self, student: str) -> datetime | None:
        return self.extensions.get(student, self.due)


@dataclass(frozen=True)
class Calendar:
    """All that the file says. zone: that of every time without one; None: this machine's."""

    assignments: dict[str, Assignment] = field(default_factory=dict)
    zone: tzinfo | None = None
    penalty: Penalty | None = None

    def of(self, assignment: str) -> Assignment:
        return self.assignments.get(assignment, Assignment(penalty=self.penalty))

    def counts(self, assignment: str) -> bool:
        """Whether it is part of the mark; a challenge is so only if the calendar says it."""
        said = self.of(assignment).counts
        return not CHALLENGE.match(assignment) if said is None else said


def read_if_there(root: Path) -> Calendar:
    """The calendar of the course in the folder `root`; an empty one if it has none.

    CalendarError if it is wrong, or names what is not in the course; RosterError if the class list is.
    """
    path = root / FILE
    if not path.is_file():
        return Calendar()
    try:
        text = path.read_bytes().decode("utf-8-sig")
        reader = _Reader(path, text, tomllib.loads(text))
    except UnicodeDecodeError:
        raise CalendarError(f"{path}: it is not UTF-8; save the file as UTF-8") from None
    except tomllib.TOMLDecodeError as error:
        line = re.search(r"\(at line (\d+)|\(at end of document", str(error))
        where = f", line {line[1]}" if line and line[1] else ", at its end"
        why = f"{str(error).partition(' (at ')[0]} (a time stands between quotation marks)"
        raise CalendarError(f"{path}{where}: {why}") from None
    calendar = reader.calendar()
    reader.check(
        calendar, {folder.name for folder in root.glob("solutions/*/")}, roster.read_if_there(root)
    )
    return calendar


def in_utc(when: datetime) -> datetime:
    """The same time as nbgrader's gradebook holds it: in UTC, without a zone."""
    return when.astimezone(UTC).replace(tzinfo=None)


class _Reader:
    """Checks what the file holds, and says where it is wrong."""

    def __init__(self, path: Path, text: str, held: dict):
        self._path, self._lines, self._held = path, text.splitlines(), held
        self._zone: tzinfo | None = None

    def calendar(self) -> Calendar:
        held = dict(self._held)
        zone = held.pop("time-zone", None)
        if zone is not None:
            try:
                self._zone = ZoneInfo(zone)
            except (ZoneInfoNotFoundError, ValueError, TypeError, OSError):
                raise self._error(
                    "time-zone", f"{zone!r} is no zone, such as Europe/Berlin"
                ) from None
        default = self._penalty(held.pop("penalty"), "penalty") if "penalty" in held else None
        assignments = {}
        for name, said in held.items():
            if not isinstance(said, dict):
                near = difflib.get_close_matches(name, ("time-zone", "penalty"))
                meant = (
                    f"did you mean {near[0]}?" if near else f"an assignment is written as [{name}]"
                )
                raise self._error(name, f"{name} is no setting; {meant}")
            assignments[name] = self._assignment(name, said, default)
        return Calendar(assignments, self._zone, default)

    def check(self, calendar: Calendar, known: set[str], people: roster.Roster | None) -> None:
        """CalendarError if an assignment or a student is not there, as after a slip of the pen."""
        for name, said in calendar.assignments.items():
            if name not in known:
                raise self._error(name, f"there is no assignment {name} in solutions/")
            for student in said.extensions:
                if people is not None and student not in people.people:
                    wrong = f"the class list, {roster.FILE}, has no student {student}"
                    raise self._error(student, wrong, f"{name}.extensions")

    def _assignment(self, name: str, said: dict, default: Penalty | None) -> Assignment:
        for key in said:
            if key not in OF_AN_ASSIGNMENT:
                raise self._error(
                    key, f"{key} is no setting; there are {_list(OF_AN_ASSIGNMENT)}", name
                )
        counts, extensions = said.get("counts"), said.get("extensions", {})
        if not isinstance(counts, bool | None):
            raise self._error("counts", f"{counts!r} is neither true nor false", name)
        if not isinstance(extensions, dict):
            raise self._error(
                "extensions", f"extensions are written below [{name}.extensions]", name
            )
        due = self._time(said["due"], "due", name) if "due" in said else None
        given = {str(student): self._time(when, student, f"{name}.extensions")
                 for student, when in extensions.items()}  # fmt: skip
        if given and due is None:
            raise self._error(
                "extensions", f"there are extensions, but {name} has no due date", name
            )
        penalty = self._penalty(said["penalty"], "penalty", name) if "penalty" in said else default
        return Assignment(due, penalty, counts, given)

    def _time(self, said, key: str, table: str) -> datetime:
        if isinstance(said, str):
            for kind in (date, datetime):  # a day alone ends with its last second
                with suppress(ValueError):
                    said = kind.fromisoformat(said)
                    break
        if isinstance(said, date) and not isinstance(said, datetime):
            said = datetime.combine(said, time(23, 59, 59))
        if not isinstance(said, datetime):
            wrong = f'{said!r} is no time, such as "2026-11-29 18:00" or "2026-11-29" (its end)'
            raise self._error(key, wrong, table)
        if said.tzinfo:
            return said
        try:
            when = said.replace(tzinfo=self._zone) if self._zone else said.astimezone()
            shown = when.astimezone(UTC).astimezone(when.tzinfo).replace(tzinfo=None)
        except (OverflowError, ValueError, OSError):
            raise self._error(key, f"{said} is no time of our days", table) from None
        if shown != said:
            gone = f"there is no {said} in {self._zone}, where clocks go forward then"
            raise self._error(key, f"{gone}: give another time", table)
        return when

    def _penalty(self, said, key: str, table: str = "") -> Penalty:
        if said == "none":
            return NONE
        if said == "zero":
            return ZERO
        if not isinstance(said, dict):
            wrong = f'{said!r} is neither "none" nor "zero" nor {{ percent-per-day = 10 }}'
            raise self._error(key, wrong, table)
        for name, number in said.items():
            if name not in OF_A_PENALTY:
                raise self._error(key, f"a penalty has no {name}, but {_list(OF_A_PENALTY)}", table)
            if type(number) not in (int, float) or not 0 <= number < math.inf:
                raise self._error(key, f"{name} = {number!r} is no number from 0 on", table)
        return Penalty(**{name.replace("-", "_"): float(said[name]) for name in said})

    def _error(self, key: str, why: str, table: str = "") -> CalendarError:
        line = _line(self._lines, key, table)
        return CalendarError(f"{self._path}{f', line {line}' if line else ''}: {why}")


def _line(lines: list[str], key: str, table: str) -> int | None:
    """Where a table of the file sets a key, counted from 1, or else where the table begins."""
    here, begins = "", None
    for number, line in enumerate(lines, 1):
        if head := re.match(r"\s*\[\s*([^\]]+?)\s*\]", line):
            here = head[1].replace('"', "").replace("'", "")
            if here in (table, key, f"{table}.{key}"):
                begins = begins or number
        elif here == table and re.match(rf"\s*[\"']?{re.escape(key)}[\"']?\s*[=.]", line):
            return number
    return begins


def without_extensions(text: str, student: str) -> tuple[str, int]:
    """The file's text without the lines that give a student an extension, and how many there were."""
    kept, taken, here = [], 0, ""
    for line in text.splitlines(keepends=True):
        if head := re.match(r"\s*\[\s*([^\]]+?)\s*\]", line):
            here = head[1]
        mine = re.match(rf"\s*(?:{re.escape(student)}|\"{re.escape(student)}\"|'{re.escape(student)}')"
                        r"\s*=", line)  # fmt: skip
        if mine and here.endswith("extensions"):
            taken += 1
        else:
            kept.append(line)
    return "".join(kept), taken


def _list(names: tuple[str, ...]) -> str:
    return ", ".join(names)
