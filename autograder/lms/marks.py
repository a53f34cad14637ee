"""The marks of a class as they leave the course: points, or why there are none."""

from dataclasses import dataclass
from datetime import datetime

from autograder.lms.sheet import written
from autograder.roster import Person

GRADED = "graded"
NOTHING = "nothing handed in"
UNREADABLE = "could not be read"
UNGRADED = "not graded yet"
UNREAD = "proof not yet marked"


@dataclass(frozen=True)
class Mark:
    """What one student has for one assignment.

    so_far: the points, with those suggested for a proof that nobody has read; None if nothing is graded.
    penalty: what was taken off. late: handed in after the due date. handed_in: in UTC.
    """

    state: str
    so_far: float | None = None
    penalty: float = 0.0
    late: bool = False
    handed_in: datetime | None = None

    @property
    def points(self) -> float | None:
        """None where there is no mark yet: that is not a 0 that was earned."""
        return self.so_far if self.state == GRADED else None

    @property
    def status(self) -> str:
        return ", ".join([self.state, *([lateness(self.penalty)] if self.late else [])])


@dataclass(frozen=True)
class Column:
    """One assignment's marks, by the student's id. due: in UTC, None if it has no due date."""

    assignment: str
    most: float
    due: datetime | None
    marks: dict[str, Mark]

    def of(self, student: str) -> Mark:
        return self.marks.get(student, Mark(NOTHING))


@dataclass(frozen=True)
class Marks:
    """A class: its people, and a column an assignment in the order of the term."""

    people: list[Person]
    columns: list[Column]


def lateness(penalty: float) -> str:
    """As "late, −1.5"."""
    return f"late, −{written(penalty)}" if penalty else "late"
