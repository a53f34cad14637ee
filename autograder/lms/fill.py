"""Puts marks into the sheets that platforms give out, and writes nothing else into them."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field

from autograder.lms import canvas, people
from autograder.lms.canvas import Gradebook
from autograder.lms.marks import Column, Mark, Marks
from autograder.lms.moodle import Worksheet
from autograder.lms.people import UnknownError
from autograder.lms.sheet import SheetError, written
from autograder.protocol import one_line
from autograder.roster import FILE, Person, Roster


@dataclass
class Filled:
    """How many cells took a mark, why others stayed as they were, and what needs a look."""

    marks: int = 0
    left: Counter = field(default_factory=Counter)
    faults: list[str] = field(default_factory=list)

    def put(
        self, row: list[str], at: int, mark: Mark, unread: bool, factor: float, comma: bool
    ) -> None:
        """Write a mark into a row; a cell without one stays as the platform gave it out."""
        points = mark.so_far if unread else mark.points
        if points is None:
            self.left[mark.state] += 1
            return
        row[at] = written(points * factor, comma)
        self.marks += 1


def fill_worksheet(
    held: Worksheet, column: Column, roster: Roster, unread: bool = False, scale: bool = False
) -> tuple[Filled, dict[str, Person]]:
    """Put one assignment's marks into Moodle's worksheet; who is who, by participant's number.

    unread: with what is suggested for proofs that nobody has read. scale: to the points of the platform,
    where they are others. SheetError if they are, and it may not.
    """
    factor = _factor(held.sheet.path.name, column, held.most, scale)
    done, found = Filled(), {}
    known = [(row, _who(done, roster, held.name(row), held.cells(row))) for row in held.sheet.rows]
    for row, person in _once(done, known):
        found[held.number(row)] = person
        done.put(row, held.grade, column.of(person.id), unread, factor, held.comma)
    _look_for_others(done, [column], roster, {one.id for one in found.values()})
    return done, found


def fill_gradebook(
    held: Gradebook,
    marks: Marks,
    columns: dict[str, int],
    roster: Roster,
    unread: bool = False,
    scale: bool = False,
) -> Filled:
    """Put marks into Canvas's gradebook. columns: where each assignment's stand. As `fill_worksheet`."""
    done, wanted = Filled(), [one for one in marks.columns if one.assignment in columns]
    how = {}
    for column in wanted:
        most, comma = held.most(columns[column.assignment])
        shown = f"{held.sheet.path.name}, {column.assignment}"
        how[column.assignment] = _factor(shown, column, most, scale), comma
    known = [
        (row, _who(done, roster, held.name(row), held.cells(row), held.number(row)))
        for row in held.rows
        if not held.is_test_student(row)
    ]
    seen = set()
    for row, person in _once(done, known):
        seen.add(person.id)
        for column in wanted:
            factor, comma = how[column.assignment]
            at = columns[column.assignment]
            if row[at].strip() == canvas.EXCUSED:
                done.left["excused in Canvas"] += 1
            elif row[at].strip() == canvas.NOT_ASSIGNED:
                done.left["not assigned to the student in Canvas"] += 1
            else:
                done.put(row, at, column.of(person.id), unread, factor, comma)
    _look_for_others(done, wanted, roster, seen)
    return done


def _factor(shown: str, column: Column, most: float | None, scale: bool) -> float:
    if most is None or not column.most or abs(most - column.most) < 1e-9:
        return 1.0
    if scale:
        return most / column.most
    raise SheetError(
        f"{shown}: there it gives {written(most)} points, here {written(column.most)}: "
        "make them the same on the platform, or add --scale"
    )


def _who(
    done: Filled, roster: Roster, name: str, cells: list[str], lms_id: str = ""
) -> Person | None:
    try:
        return people.who(roster, name, cells, lms_id)
    except UnknownError as error:
        done.faults.append(f"left as it was: {error}")
        return None


def _once(
    done: Filled, known: list[tuple[list[str], Person | None]]
) -> Iterator[tuple[list[str], Person]]:
    """The rows with their students; a student who would have two rows gets a mark in neither."""
    times = Counter(person.id for _, person in known if person)
    done.faults += [
        f"{times[id]} rows would be {one_line(id, 80)}'s, and stay as they were: put what the platform "
        f"calls the student into {FILE}, as lms_id or email"
        for id in times
        if times[id] > 1
    ]
    yield from ((row, person) for row, person in known if person and times[person.id] == 1)


def _look_for_others(done: Filled, columns: list[Column], roster: Roster, seen: set[str]) -> None:
    """Say who has a mark and no row in the sheet."""
    for student in roster.people:
        if student not in seen and any(one.of(student).so_far is not None for one in columns):
            done.faults.append(f"{one_line(student, 80)} has a mark, but no row in the sheet")
