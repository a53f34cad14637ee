"""Holds a wrong answer against what follows from the student's own earlier functions.

Their numbers are all there is. The earlier functions are called where their checks and the way from one
to the other need it, in a random order, while the later one cannot be called. An earlier answer that is
right, or so plain that nothing is shown by following from it, gives no points.
"""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np

from autograder.judging.carried.follows import Follows
from autograder.judging.carried.own import NoneFollowsError, Own
from autograder.judging.check import Ask, CannotRunError, Check
from autograder.judging.percent import percent
from autograder.judging.quantities import UnfitError
from autograder.judging.verdict import RUN_AGAIN, State, Verdict
from autograder.protocol import Call, Reply

WRONG = (State.INCORRECT, State.PARTLY_CORRECT)
# All calls together may use so much of the processor's time, s; so many are asked at once.
LONGEST = 8.0
AT_ONCE = 64
UNDECIDED = (
    "For an error that is only carried on, the grader gives the share of the points that your course "
    "has chosen."
)
TOO_PLAIN = (
    "Yet it gives no points: what you start from is too plain for this step to show anything."
)
NOT_HERE = (
    "Your {} {} not right yet either. If this answer follows from it, the mistake is there alone: the "
    "grader looks at that when you hand in."
)


# Of numbers that have another shape, or do not go together.
NOT_CARRIED = (
    NoneFollowsError, CannotRunError, UnfitError, ArithmeticError, ValueError, TypeError, IndexError
)  # fmt: skip


@dataclass(frozen=True)
class Carrying:
    """How errors carried on count.

    known(id): the check of an earlier answer, None for none. share: of the points, in [0, 1]; None where
    it is not for this judge to say. states: those of the answers that come before it, by id; None where
    nobody knows. spent(): the processor time that student code has used, s.
    """

    known: Callable[[str], Check | None]
    share: float | None = None
    states: Mapping[str, State] | None = None
    spent: Callable[[], float] = time.process_time

    def judged(
        self,
        check: Check,
        found: Verdict,
        calls: list[Call],
        ask: Ask,
        rng: np.random.Generator,
    ) -> Verdict:
        """The verdict `found` on a wrong answer; with what is said and given where it follows from an
        earlier one. calls: on which it was found.
        """
        if found.state not in WRONG or found.problem:
            return found
        for follows in check.follows:
            earlier = [self.known(id) for id in follows.earlier]
            if not all(earlier) or not self._may_be_wrong(follows):
                continue
            try:
                own = Own(check, calls, self._within(ask), rng)
                after = self._after(follows, [e for e in earlier if e], own, found)
            except NOT_CARRIED:
                continue
            if after is not None:
                return after
        return found

    def _within(self, ask: Ask) -> Ask:
        """`ask`, a few calls at a time, for as long as they may take: what is slow is not carried on.

        By a wall clock, a busy machine would give other points.
        """
        ends = self.spent() + LONGEST

        def some(calls: list[Call]) -> list[Reply]:
            replies: list[Reply] = []
            for start in range(0, len(calls), AT_ONCE):
                if self.spent() > ends:
                    raise NoneFollowsError
                asked = calls[start : start + AT_ONCE]
                found = ask(asked)
                replies += found
                if len(found) < len(asked):
                    break
            return replies

        return some

    def _may_be_wrong(self, follows: Follows) -> bool:
        """Whether all are judged and gave numbers, and one of them wrong ones, as far as is known."""
        if self.states is None:
            return True
        states = [self.states.get(id, State.NOT_ATTEMPTED) for id in follows.earlier]
        return all(s in (State.CORRECT, *WRONG) for s in states) and any(s in WRONG for s in states)

    def _after(
        self, follows: Follows, earlier: list[Check], own: Own, found: Verdict
    ) -> Verdict | None:
        if follows.way is None:
            wrong = own.wrong_among(earlier)
            said = NOT_HERE.format(" and ".join(wrong), "are" if wrong[1:] else "is")
            remark = " ".join(filter(None, [found.remark, said]))
            return replace(found, remark=remark) if wrong else None
        borne_out, wrong = own.borne_out(follows.way, earlier)
        unmet = [k for k, row in enumerate(found.rows) if not row.met and k in borne_out]
        counted = [k for k in unmet if not borne_out[k]]
        if not counted:
            return None  # nothing is shown by it, and what is said of the numbers is true
        rows = list(found.rows)
        for k in unmet:
            said = f"{follows.sentence} {self._counts(plain=borne_out[k])}".strip()
            rows[k] = replace(rows[k], said=(said,))
        still_said = chain.from_iterable(row.said for row in rows)
        credit = found.credit + (self.share or 0.0) * sum(rows[k].share for k in counted)
        step = f"Mend {' and '.join(wrong)} first, then this function{RUN_AGAIN}"
        return replace(
            found,
            rows=tuple(rows),
            credit=credit,
            state=State.PARTLY_CORRECT if credit > 0 else found.state,
            diagnosis=tuple(dict.fromkeys([*still_said, *found.of_the_whole])),
            next_step=found.next_step if any(not r.met for r in _others(rows, unmet)) else step,
        )

    def _counts(self, plain: bool) -> str:
        if plain:
            return TOO_PLAIN
        if self.share is None:
            return UNDECIDED
        given = f"As an error carried on, this gives {percent(self.share)} of these points."
        return given if self.share else ""


def _others(rows: list, but: list[int]) -> list:
    return [row for k, row in enumerate(rows) if k not in but]
