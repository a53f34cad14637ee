"""The verdict on one answer, and how it reads as plain text."""

import textwrap
from dataclasses import dataclass, field, replace
from enum import StrEnum

from autograder.judging.percent import percent
from autograder.protocol import Call

AS_ABOVE = "For the same reason as above."


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
    """One criterion: what was asked for, its share of the credit, and whether it was met.

    said: those sentences of the diagnosis that are about this criterion, which is then not met.
    """

    text: str
    share: float
    met: bool
    said: tuple[str, ...] = ()


@dataclass(frozen=True)
class Witness:
    """The worst case: the call, what came back, and how far off that was, with the unit. A truth
    value is right or wrong, so its `off` is empty.

    pose: the arm's joints in that call, one (x, y) in m each, where drawing it helps. where: the entry
    of what came back, "M[0, 1]", where it is one. given_by: the line of Python that gives the call's
    arguments. of: the call itself.
    """

    call: str
    returned: str
    off: str
    pose: tuple[tuple[float, float], ...] = ()
    where: str = ""
    given_by: str = ""
    of: Call | None = field(default=None, repr=False, compare=False)


@dataclass(frozen=True)
class Failed:
    """The first call that gave no numbers, or some that are not finite.

    count, tried: of so many calls, so many failed; tried is 0 where the check stopped at the first, as
    at a loop that never ends. works: a call that gave numbers, "" for none. given_by, of: as in a
    Witness.
    """

    call: str
    count: int = 1
    tried: int = 0
    works: str = ""
    given_by: str = ""
    of: Call | None = field(default=None, repr=False, compare=False)


@dataclass(frozen=True)
class Verdict:
    """What the check found out about one answer.

    credit: its share of the cell's points, in [0, 1]. problem: why the code gave no numbers, or that it
    is not the code on the screen. diagnosis: all that is known of the reasons why criteria are not met,
    each sentence once; its rows say which belongs to which. remark: what in the answer, even a right
    one, harms other code. further: what a right answer leads to. next_step: what the student can do now.
    failed: the call in which the code gave no numbers.
    """

    check: str
    state: State
    credit: float = 0.0
    rows: tuple[Row, ...] = ()
    witness: Witness | None = None
    problem: str = ""
    diagnosis: tuple[str, ...] = ()
    remark: str = ""
    further: str = ""
    next_step: str = ""
    failed: Failed | None = None

    def without_inputs(self) -> "Verdict":
        """The same verdict for a feedback page: the worst case without the inputs that showed it."""
        witness = self.witness and replace(self.witness, call="", pose=(), given_by="", of=None)
        return replace(self, witness=witness, failed=None)

    @property
    def worst(self) -> Call | None:
        """The call that failed, or else the worst one; None where neither is known."""
        shown = self.failed or self.witness
        return shown.of if shown else None

    @property
    def given_by(self) -> str:
        """The line of Python that gives the arguments of `worst`; "" where none does."""
        shown = self.failed or self.witness
        return shown.given_by if shown else ""

    @property
    def headline(self) -> str:
        if self.state is State.PARTLY_CORRECT:
            return f"{self.check}: {self.state} ({percent(self.credit)})"
        return f"{self.check}: {self.state}"

    @property
    def of_the_whole(self) -> tuple[str, ...]:
        """Those sentences of the diagnosis that are about no single criterion."""
        of_rows = {sentence for row in self.rows for sentence in row.said}
        return tuple(sentence for sentence in self.diagnosis if sentence not in of_rows)

    def said_of_rows(self) -> list[tuple[Row, list[str]]]:
        """Each row with what is said below it; a sentence that stands further up is not said again."""
        above: set[str] = set()
        found = []
        for row in self.rows:
            said = [AS_ABOVE if sentence in above else sentence for sentence in row.said]
            above.update(row.said)
            found.append((row, list(dict.fromkeys(said))))
        return found

    def lines(self) -> list[str]:
        """The verdict in sentences, the headline apart, most useful first."""
        return [*self._first(), *self.diagnosis, *self._last()]

    def _first(self) -> list[str]:
        """Why there are no numbers."""
        said = [self.problem] if self.problem else []
        return said + (failing(self.failed) if self.failed else [])

    def _last(self) -> list[str]:
        """Beside the reasons, what to look at and to do."""
        return [
            *([self.remark] if self.remark else []),
            *([worst_case(self.witness)] if self.witness else []),
            *([arguments_by(self)] if self.given_by else []),
            *([self.further] if self.further else []),
            *([self.next_step] if self.next_step else []),
        ]

    def __str__(self):
        rows = []
        for row, said in self.said_of_rows():
            # A single criterion has the whole credit, so its share says nothing.
            share = f" ({percent(row.share)})" if len(self.rows) > 1 else ""
            rows.append(f"  [{'x' if row.met else ' '}] {row.text}{share}")
            rows += [filled(sentence, 6) for sentence in said]
        last = [*self.of_the_whole, *self._last()]
        return "\n".join([self.headline, *map(filled, self._first()), *rows, *map(filled, last)])


def filled(text: str, indent: int = 2) -> str:
    """A sentence as lines of at most 78 characters."""
    margin = " " * indent
    return textwrap.fill(text, 78, initial_indent=margin, subsequent_indent=margin)


def worst_case(witness: Witness) -> str:
    """The witness as a sentence."""
    if not witness.off:  # a truth value is right or wrong, not more or less
        return f"Worst case: {witness.call or 'your function'} gave {witness.returned}."
    if witness.call:
        return f"Worst case: {witness.call} gave {witness.returned}, off by {witness.off}."
    return f"Worst case: {f'{witness.where} is ' if witness.where else ''}off by {witness.off}."


def failing(failed: Failed) -> list[str]:
    """Which calls fail and which work, in sentences."""
    if failed.tried == 0:
        said = "The check stopped at this call"
    elif failed.tried == 1:
        said = "The one call failed"
    elif failed.count == failed.tried == 2:
        said = "Both calls failed, the first of them"
    elif failed.count == failed.tried:
        said = f"All {failed.tried} calls failed, the first of them"
    elif failed.count == 1:
        said = f"1 of {failed.tried} calls failed"
    else:
        said = f"{failed.count} of {failed.tried} calls failed, the first of them"
    return [
        f"{said}: {failed.call}",
        *([f"This one works: {failed.works}"] if failed.works else []),
    ]


def arguments_by(verdict: Verdict) -> str:
    """Where a student finds the arguments of the call that failed, or of the worst case."""
    whose = "failed call" if verdict.failed else "worst case"
    return f"The arguments of the {whose}: {verdict.given_by}"
