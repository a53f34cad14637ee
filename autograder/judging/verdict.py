"""The verdict on one answer, and how it reads as plain text."""

import os
import traceback
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum

from autograder.judging.passages import Passage, as_text, failing, filled, if_said, worst_case
from autograder.judging.percent import percent
from autograder.protocol import Call, shortened

AS_ABOVE = "For the same reason as above."
# The ends of what a student can do now, and what stands in their place on a page that comes back.
CHANGE_IT = "Change your function, run its cell, then run this cell again."
RUN_AGAIN = ", and run this cell again."
FIX_IT = "Fix this first: until then the check can't look at the physics."
OF_A_RETURNED = {
    CHANGE_IT: "To try it again, change your function in your own copy of this notebook, and run its "
    "check there.",
    RUN_AGAIN: ", in your own copy of this notebook, and run the checks there.",
    FIX_IT: "So the grader could not look at the physics. Your own copy of this notebook shows the "
    "error, too.",
}


class State(StrEnum):
    """Where an answer stands. In the last two states it is not judged, and the student is not to blame:
    the check failed, or needs what only the grader has.
    """

    CORRECT = "correct"
    PARTLY_CORRECT = "partly correct"
    INCORRECT = "incorrect"
    ERROR = "error in your code"
    NOT_ATTEMPTED = "not attempted"
    CHECK_FAILED = "the check itself failed"
    NOT_HERE = "judged when you hand it in"


@dataclass(frozen=True)
class Row:
    """One criterion: what was asked for, its share of the credit, and whether it was met.

    said: those sentences of the diagnosis that are about this criterion, which is then not met. seen:
    what is true of its numbers, to be said where nothing else is.
    """

    text: str
    share: float
    met: bool
    said: tuple[str, ...] = ()
    seen: str = ""


@dataclass(frozen=True)
class Witness:
    """The worst case: the call, what came back, and how far off that was, with the unit. A truth
    value is right or wrong, so its `off` is empty.

    pose: the arm's joints in that call, one (x, y) in m each, where drawing it helps. where: the entry
    of what came back, "M[0, 1]", where it is one. given_by: the lines of Python that give the call's
    arguments. by_name: the call with the names of these, "M(q, arm)". of: the call itself.
    """

    call: str
    returned: str
    off: str
    pose: tuple[tuple[float, float], ...] = ()
    where: str = ""
    given_by: str = ""
    by_name: str = ""
    of: Call | None = field(default=None, repr=False, compare=False)


@dataclass(frozen=True)
class Failed:
    """The first call that gave no numbers, or some that are not finite.

    count, tried: of so many calls, so many failed; tried is 0 where the check stopped at the first, as
    at a loop that never ends. works: a call that gave numbers, "" for none. given_by, by_name, of: as
    in a Witness. of_works: the call that works.
    """

    call: str
    count: int = 1
    tried: int = 0
    works: str = ""
    given_by: str = ""
    of: Call | None = field(default=None, repr=False, compare=False)
    by_name: str = ""
    of_works: Call | None = field(default=None, repr=False, compare=False)


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

    def returned(self) -> "Verdict":
        """The same verdict for a page that comes back: the worst case without the inputs that showed it,
        and nothing to be run on the page.
        """
        witness = self.witness and replace(
            self.witness, call="", pose=(), given_by="", by_name="", of=None
        )
        step = self.next_step
        if self.state is State.NOT_ATTEMPTED:
            step = "In what was handed in, nothing had been written here yet."
        for end, on_page in OF_A_RETURNED.items():
            step = step.replace(end, on_page)
        return replace(self, witness=witness, failed=None, next_step=step)

    @property
    def worst(self) -> Call | None:
        """The call that failed, or else the worst one; None where neither is known."""
        shown = self.failed or self.witness
        return shown.of if shown else None

    @property
    def given_by(self) -> str:
        """The lines of Python that give the arguments of `worst`; "" where none do."""
        shown = self.failed or self.witness
        return shown.given_by if shown else ""

    @property
    def again(self) -> str:
        """Lines of Python that make the call of `worst` again, in any cell; "" where none do."""
        shown = self.failed or self.witness
        return f"{shown.given_by}\n{shown.by_name}".strip() if shown and shown.given_by else ""

    @property
    def _why_again(self) -> str:
        which = "the failed call" if self.failed else "the worst case"
        return f"To work with {which}, run this in a cell of your own:"

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
        """Each row with what is said below it; what stands right above, and nothing else there, is not
        said again.
        """
        last: tuple[str, ...] = ()
        found = []
        for row in self.rows:
            is_same = bool(last) and set(last) <= set(row.said)
            said = [AS_ABOVE if is_same and own in last else own for own in row.said]
            last = row.said or last
            found.append((row, list(dict.fromkeys(said)) or [*filter(None, [row.seen])]))
        return found

    def lines(self) -> list[str]:
        """The verdict in sentences and code, the headline apart, in the order of their use."""
        said = [*self.passages_above(), *(Passage("diagnosis", text) for text in self.diagnosis)]
        said += [*self.passages_below(), self.step]
        return [text for own in said for text in (own.text, own.code) if text]

    def passages_above(self) -> list[Passage]:
        """What stands above the criteria: why there are no numbers."""
        return [*if_said("problem", self.problem), *(failing(self.failed) if self.failed else [])]

    def passages_below(self) -> list[Passage]:
        """What stands below the criteria: what is true of the whole, the worst case, where it leads."""
        return [
            *if_said("remark", self.remark),
            *(worst_case(self.witness) if self.witness else []),
            *([Passage("again", self._why_again, code=self.again)] if self.again else []),
            *if_said("further", self.further),
        ]

    @property
    def step(self) -> Passage:
        """What to do; its text is "" where nothing is to be done."""
        return Passage("next", self.next_step)

    @property
    def step_is_last(self) -> bool:
        """Whether there is something to look at before it: of wrong numbers, not of missing ones."""
        return self.state in (State.INCORRECT, State.PARTLY_CORRECT)

    def __str__(self):
        return plain(self)


def not_attempted(check: str, signature: str, line: str = "") -> Verdict:
    """Of a function that still says NotImplementedError. line: that line, where more stands below it."""
    if line:
        step = (
            f"{signature} stops at its {line}, raise NotImplementedError, and nothing below that line "
            "runs. Delete the line, run the cell, then run this cell again."
        )
        return Verdict(check, State.NOT_ATTEMPTED, next_step=step)
    step = (
        f"Write {signature} where it says NotImplementedError, "
        "run its cell, then run this cell again."
    )
    return Verdict(check, State.NOT_ATTEMPTED, next_step=step)


def error(check: str, problem: str, failed: Failed | None) -> Verdict:
    """Of code that gives nothing to judge. failed: the call because of which; None for none."""
    return Verdict(check, State.ERROR, problem=problem, next_step=FIX_IT, failed=failed)


def check_failed(check: str, error: Exception) -> Verdict:
    """Where the check itself stopped with an error."""
    return Verdict(
        check,
        State.CHECK_FAILED,
        problem=f"{type(error).__name__} in the check {check}{_at(error)}: {shortened(str(error))}.",
        next_step="This is not your fault. Please tell your instructor.",
    )


def _at(error: Exception) -> str:
    """Where in a course's own file, which alone runs under a name that is no whole path."""
    frames = traceback.extract_tb(error.__traceback__)
    own = [f for f in frames if f.filename.endswith(".py") and not os.path.isabs(f.filename)]
    return f" ({own[-1].filename}, line {own[-1].lineno})" if own else ""


def plain(verdict: Verdict, lines: Sequence[str] = (), last: Sequence[str] = ()) -> str:
    """The verdict as plain text. lines: more to look at, as text that is filled; last: what ends it."""
    rows = []
    for row, said in verdict.said_of_rows():
        # A single criterion has the whole credit, so its share says nothing.
        share = f" ({percent(row.share)})" if len(verdict.rows) > 1 else ""
        rows.append(f"  [{'x' if row.met else ' '}] {row.text}{share}")
        rows += [filled(sentence, 6) for sentence in said]
    step = [filled(verdict.step.text)] if verdict.step.text else []
    then = [*lines, *step] if verdict.step_is_last else [*step, *lines]
    said = [
        verdict.headline,
        *map(as_text, verdict.passages_above()),
        *rows,
        *map(filled, verdict.of_the_whole),
        *map(as_text, verdict.passages_below()),
        *then,
        *last,
    ]
    return "\n".join(filter(None, said))
