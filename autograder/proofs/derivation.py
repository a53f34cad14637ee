"""What is to be derived: from where, to where, on which reasons, and for which points."""

from dataclasses import dataclass

from autograder.proofs.expression import Node
from autograder.proofs.subject import Subject

ALGEBRA = "algebra"  # the reason of a step that needs no fact
MOST_REASONS = 2  # on one line, so that a proof is no single step


@dataclass(frozen=True)
class Form:
    """What a line has to show, which another line of the same value may not.

    ways: of each, all texts stand in the line as a whole, up to a constant factor or a transpose, and
    their names stand nowhere else in it. said: what is missing, for the student.
    """

    ways: tuple[tuple[str, ...], ...]
    said: str


@dataclass(frozen=True)
class Row:
    """A row of the problem's table of points.

    number: which row, from 1. points: its points. milestone: the line at which it is earned, if all
    lines up to it hold; "" where the whole derivation earns it. form: what the line of the milestone
    shows, or where there is none, any line. left: what the person still looks for.
    """

    number: int
    points: float
    milestone: str = ""
    left: str = ""
    form: Form | None = None


@dataclass(frozen=True)
class FalseStep:
    """A mistake as a false fact: a step that follows from it, and not from the reasons given, is it.

    defines, property: as in a Reason. gone: what a line then no longer holds, if the sentence says so.
    sentence: what is seen, and where to look; never the formula.
    """

    name: str
    sentence: str
    defines: tuple[tuple[str, str], ...] = ()
    property: str = ""
    gone: str = ""


@dataclass(frozen=True)
class Misuse:
    """A reason that is often thought to give what it does not.

    relations: the comparisons of which this is thought. gives: the one that it does give, "" for none.
    """

    reason: str
    sentence: str
    relations: tuple[str, ...] = ("=",)
    gives: str = ""


@dataclass(frozen=True)
class Derivation:
    """id: as students call it. cell: the grade_id of the proof beside it. start: what the first line
    equals. goal: what the last line must be, never shown; goal_said: in words, shown. relation: "=" or
    ">". least_lines: fewer that say something new do not show why. to_prove: reasons that assume what
    is to be proved. mistakes: tried in this order.
    """

    id: str
    cell: str
    subject: Subject
    start: str
    goal: str
    goal_said: str
    rows: tuple[Row, ...]
    hints: tuple[str, ...]
    relation: str = "="
    least_lines: int = 3
    to_prove: tuple[str, ...] = ()
    misused: tuple[Misuse, ...] = ()
    mistakes: tuple[FalseStep, ...] = ()

    def read(self, text: str) -> Node:
        return self.subject.parser.read(text)

    @property
    def reason_names(self) -> tuple[str, ...]:
        return (*(reason.name for reason in self.subject.reasons), ALGEBRA)
