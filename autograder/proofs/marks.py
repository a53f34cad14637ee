"""What a judged derivation says."""

from dataclasses import dataclass

from autograder.proofs.derivation import Derivation, Row


@dataclass(frozen=True)
class MarkedLine:
    """A line with its mark. said: why it does not hold, in a sentence."""

    text: str
    reasons: tuple[str, ...]
    holds: bool
    said: str


@dataclass(frozen=True)
class Marked:
    """The lines of one derivation. done: all lines hold and reach the goal. still: what is missing, for
    the whole. earned: rows of the problem's table of points. problem: why there are no lines.
    """

    derivation: Derivation
    lines: tuple[MarkedLine, ...] = ()
    done: bool = False
    still: str = ""
    earned: tuple[Row, ...] = ()
    problem: str = ""

    @property
    def headline(self) -> str:
        id = self.derivation.id
        if self.problem:
            return f"{id}: no lines"
        if not self.lines:
            return f"{id}: not attempted"
        holding = sum(line.holds for line in self.lines)
        if self.done:
            return f"{id}: complete"
        return f"{id}: {holding} of {len(self.lines)} lines hold"

    @property
    def points(self) -> float:
        return sum(row.points for row in self.earned)
