"""The verdict on one answer, and how it reads as plain text."""

import textwrap
from dataclasses import dataclass, replace
from enum import StrEnum


class State(StrEnum):
    """Where an answer stands. In the last state the check failed; the student is not to blame."""

    CORRECT = "correct"
    PARTLY_CORRECT = "partly correct"
    INCORRECT = "incorrect"
    ERROR = "error in your code"
    NOT_ATTEMPTED = "not attempted"
    CHECK_FAILED = "the check itself failed"


@dataclass(frozen=True)
class Row:
    """One criterion: what was asked for, its share of the credit, and whether it was met."""

    text: str
    share: float
    met: bool


@dataclass(frozen=True)
class Witness:
    """The worst case: the call, what came back, and how far off that was, with the unit. A truth
    value is right or wrong, so its `off` is empty.

    pose: the arm's joints in that call, one (x, y) in m each, where drawing it helps. where: the entry
    of what came back, "M[0, 1]", where it is one.
    """

    call: str
    returned: str
    off: str
    pose: tuple[tuple[float, float], ...] = ()
    where: str = ""


@dataclass(frozen=True)
class Verdict:
    """What the check found out about one answer.

    credit: its share of the cell's points, in [0, 1]. problem: why the code gave no numbers, or that it
    is not the code on the screen. diagnosis: for each criterion that is not met, what is known of the
    reason. remark: what in the answer, even a right one, harms other code. next_step: what the student
    can do now.
    """

    check: str
    state: State
    credit: float = 0.0
    rows: tuple[Row, ...] = ()
    witness: Witness | None = None
    problem: str = ""
    diagnosis: tuple[str, ...] = ()
    remark: str = ""
    next_step: str = ""

    def without_inputs(self) -> "Verdict":
        """The same verdict for a feedback page: the worst case without the inputs that showed it."""
        if self.witness is None:
            return self
        return replace(self, witness=replace(self.witness, call="", pose=()))

    @property
    def headline(self) -> str:
        if self.state is State.PARTLY_CORRECT:
            return f"{self.check}: {self.state} ({self.credit:.0%})"
        return f"{self.check}: {self.state}"

    def lines(self) -> list[str]:
        """The verdict in sentences, the headline apart, most useful first."""
        return [
            *([self.problem] if self.problem else []),
            *self.diagnosis,
            *([self.remark] if self.remark else []),
            *([worst_case(self.witness)] if self.witness else []),
            *([self.next_step] if self.next_step else []),
        ]

    def __str__(self):
        # A single criterion has the whole credit, so its share says nothing.
        shares = [f" ({row.share:.0%})" if len(self.rows) > 1 else "" for row in self.rows]
        rows = [f"  [{'x' if row.met else ' '}] {row.text}{share}"
                for row, share in zip(self.rows, shares, strict=True)]  # fmt: skip
        body = [textwrap.fill(line, 78, initial_indent="  ", subsequent_indent="  ")
                for line in self.lines()]  # fmt: skip
        return "\n".join([self.headline, *rows, *body])


def worst_case(witness: Witness) -> str:
    """The witness as a sentence."""
    if not witness.off:  # a truth value is right or wrong, not more or less
        return f"Worst case: {witness.call or 'your function'} gave {witness.returned}."
    if witness.call:
        return f"Worst case: {witness.call} gave {witness.returned}, off by {witness.off}."
    return f"Worst case: {f'{witness.where} is ' if witness.where else ''}off by {witness.off}."
