"""A check: which function the student defines, what to call it with, and how its numbers are judged.

One check serves the student's cell, `nbgrader validate` and the grader; they differ only in where the
function runs (`ask`) and in how many cases are drawn.
"""

import math
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np

from autograder.judging import changes, findings, verdict
from autograder.judging.asked_again import AskedAgain
from autograder.judging.call_text import given_by
from autograder.judging.carried.follows import Follows
from autograder.judging.criterion import Criterion, errors_of, met_by
from autograder.judging.diagnosis import Catalogue, Mistake, sentences
from autograder.judging.faults import describe_fault, describe_second_fault
from autograder.judging.given import Describe, Given, NoNumbersError, Reading
from autograder.judging.loops import asked, seconds_of
from autograder.judging.models import Model, evaluated
from autograder.judging.on_top import on_top
from autograder.judging.places import NOWHERE, place
from autograder.judging.quantities import Numbers, Quantities, each, one_number
from autograder.judging.remarks import remarks
from autograder.judging.section import Section
from autograder.judging.stacked import layouts, rows
from autograder.judging.terms import Term
from autograder.judging.verdict import Row, State, Verdict, Witness
from autograder.judging.witness import witness, worst_entry, wrong_places
from autograder.judging.wrong_numbers import wrong_numbers
from autograder.protocol import Call, FaultKind, Reply

if TYPE_CHECKING:
    from autograder.judging.carried.judge import Carrying

VISIBLE_CASES = 6
# A visible check tries the same cases each time, so that a student sees how an error changes.
VISIBLE_SEED = 20260101
HIDDEN_CASES = 24
# An answer that took longer, s, is not called again to find out more about it.
SLOW = 2.0

Ask = Callable[[list[Call]], list[Reply]]


class CannotRunError(Exception):
    """An answer cannot be run on the machine that judges, which is not its fault."""


@dataclass(frozen=True)
class Check:
    """What is asked of one function. A problem makes one instance a graded cell.

    id: the grade_id of its cell. signature: how the function is called. reference: the right answer,
    with the same arguments. calls(rng, count): the calls to try. quantities(calls, values): what is
    judged in the values, for each call one array a criterion; by default the one number that came
    back. mistakes: tried in order on each criterion that is not met. catalogue: more of them, made when
    they are needed. terms: the parts of the right answer, of which an error may be made that no mistake
    explains; or a function that gives them. hints: from a nudge to nearly the way. section: of the
    lesson that prepares it. further: a sentence for whoever has the right answer, which leads on; true
    of every arm that is asked for. pose(call): the joints of the arm in a call, to be drawn beside the
    worst case. returns: what a student calls the returned array, "M", where not by the function's name.
    follows: from which earlier answers it may be carried on; the first that holds counts.

    ValueError where the shares of the criteria do not add up to 1, or where two criteria have one
    text, two mistakes or terms one name, or two hints are the same.
    """

    id: str
    signature: str
    reference: Model
    calls: Callable[[np.random.Generator, int], list[Call]]
    criteria: tuple[Criterion, ...]
    mistakes: tuple[Mistake, ...] = ()
    catalogue: Catalogue | None = None
    quantities: Quantities = one_number
    terms: tuple[Term, ...] | Callable[[], tuple[Term, ...]] = ()
    hints: tuple[str, ...] = ()
    section: Section | None = None
    further: str = ""
    pose: Callable[[Call], list] | None = None
    returns: str = ""
    follows: tuple[Follows, ...] = ()

    def __post_init__(self):
        if not self.criteria:
            raise ValueError(f"check {self.id}: it has no criteria")
        total = sum(criterion.share for criterion in self.criteria)
        if not math.isclose(total, 1, abs_tol=1e-9):
            raise ValueError(f"check {self.id}: the shares add up to {total:g}, must be 1")
        for kind, names in (
            ("criteria", [criterion.text for criterion in self.criteria]),
            ("mistakes", [mistake.name for mistake in self.mistakes]),
            ("terms", [term.name for term in self.terms] if isinstance(self.terms, tuple) else []),
            ("hints", self.hints),
        ):
            if doubled := [name for name, count in Counter(names).items() if count > 1]:
                raise ValueError(f"check {self.id}: two of its {kind} are {doubled[0]!r}")

    @property
    def known_mistakes(self) -> tuple[Mistake, ...]:
        """Those that are written, and those of the catalogue, which is made for it."""
        made = self.catalogue.mistakes() if self.catalogue else ()
        return (*self.mistakes, *made)

    @property
    def name(self) -> str:
        """The name of the function."""
        return self.signature.partition("(")[0]

    def run(
        self, ask: Ask, rng: np.random.Generator, count: int = VISIBLE_CASES,
        carrying: "Carrying | None" = None,
    ) -> Verdict:  # fmt: skip
        """Try the student's function and judge it. carrying: how errors count that are carried on.

        An error in the check, or CannotRunError from `ask`, is a verdict of its own: CHECK_FAILED. Any
        other error that `ask` raises goes on to the caller, and so does an interrupt.
        """
        try:
            calls = self.calls(rng, count)
        except Exception as error:
            return verdict.check_failed(self.id, error)
        found = self.on(calls, ask)
        return carrying.judged(self, found, calls, ask, rng) if carrying else found

    def on(self, calls: list[Call], ask: Ask) -> Verdict:
        """Try the student's function with these calls; as `run`."""
        try:
            expected = self._quantities_of(self.reference, calls)
            # The reference goes first: where it fails the check is to blame, not the student.
            if not all(met_by(self.criteria, expected, expected)):
                raise ArithmeticError("the reference does not pass its own check")
        except Exception as error:
            return verdict.check_failed(self.id, error)
        try:
            seconds = seconds_of(ask)
            started = seconds()
            calls, replies = asked(calls, ask)
            ask_again = ask if seconds() - started < SLOW else None
        except CannotRunError as error:
            return verdict.check_failed(self.id, error)
        try:
            # Near the largest float, their numbers less ours overflow: wrong, but not our failure.
            with np.errstate(over="ignore", invalid="ignore"):
                found = self._judge_replies(calls, expected, replies, ask_again)
        except Exception as error:
            return verdict.check_failed(self.id, error)
        if found.state in (State.CORRECT, State.NOT_ATTEMPTED):
            return found
        said = [found.remark, *remarks(replies[0], self.signature)]
        return replace(found, remark=" ".join(filter(None, said)))

    def _judge_replies(
        self, calls: list[Call], expected: Numbers, replies: list[Reply], ask: Ask | None
    ) -> Verdict:
        fault = next((reply.fault for reply in replies if reply.fault), None)
        if fault and fault.kind is FaultKind.NOT_IMPLEMENTED:
            return verdict.not_attempted(self.id, self.signature, fault.line)
        changed = changes.changed(self.signature, calls, replies)
        try:
            given = self._given(calls, replies)
        except NoNumbersError as error:
            return verdict.error(self.id, str(error), error.failed)
        if not any(reply.again for reply in replies):
            return self.judge(calls, expected, given, changed=changed, ask=ask)
        second = [reply.again or reply for reply in replies]
        try:
            again = self._given(calls, second, describe_second_fault)
        except NoNumbersError as error:
            said = f"{changes.remark(self.name, changed, True)} On the second call, {error}"
            return verdict.error(self.id, said, error.failed)
        return self.judge(calls, expected, given, again, changed, ask)

    def _given(
        self, calls: list[Call], replies: list[Reply], describe: Describe = describe_fault
    ) -> Given:
        """What is judged in the replies; NoNumbersError where nothing can be."""
        reading = Reading(self.id, self.signature, self.quantities, self.reference, describe)
        return reading.given(calls, replies)

    def judge(
        self, calls: list[Call], expected: Numbers, given: Given, again: Given | None = None,
        changed: tuple[str, ...] = (), ask: Ask | None = None,
    ) -> Verdict:  # fmt: skip
        """The verdict on quantities given, case by case, against those expected.

        again: the quantities of second calls, where a first one changed its arguments; a criterion is
        met where both are right. changed: the names of these arguments. ask: by which more may be found
        out of an answer that no mistake explains.
        """
        right = met = met_by(self.criteria, expected, given.numbers)
        if again is not None:
            later = met_by(self.criteria, expected, again.numbers)
            met = [one and two for one, two in zip(right, later, strict=True)]
        remark = changes.remark(self.name, changed, met != right)
        credit = sum(c.share for c, ok in zip(self.criteria, met, strict=True) if ok)
        said: list[tuple[str, ...]] = [()] * len(met)
        seen = [""] * len(met)
        if all(met):
            rows = self._rows(met, said, seen)
            return Verdict(self.id, State.CORRECT, 1.0, rows, remark=remark, further=self.further)
        # Only what it does to its arguments is wrong, where a first call is right.
        judged, when = (again, changes.SECOND) if again and all(right) else (given, "")
        # Of what hangs on a NaN nothing more can be said.
        told = [ok or bad for ok, bad in zip(met if when else right, judged.spoilt, strict=True)]
        numbers = judged.but_spoilt(expected)
        worst: Witness | None = None
        if not all(told):
            worst = self._witness(calls, expected, numbers, told, judged.values, when)
            if not when:
                said = self._diagnosis(calls, expected, numbers, told, ask)
                seen = findings.of_cases(self.criteria, expected, numbers, told)
        problem, failed = given.problem, given.failed
        if not problem and again and again.problem:
            problem, failed = f"On the second call, {again.problem}", again.failed
        return Verdict(
            self.id,
            State.PARTLY_CORRECT if credit > 0 else State.INCORRECT,
            credit,
            self._rows(met, said, seen),
            worst,
            problem,
            tuple(dict.fromkeys(chain.from_iterable(said))),
            remark,
            failed=failed,
            next_step=verdict.CHANGE_IT,
        )

    def _rows(
        self, met: list[bool], said: Sequence[tuple[str, ...]], seen: Sequence[str]
    ) -> tuple[Row, ...]:
        """One a criterion. said: what is known of each. seen: of its cases, where nothing else is."""
        found = zip(self.criteria, met, said, seen, strict=True)
        return tuple(
            Row(c.text, c.share, ok, known, "" if known else cases) for c, ok, known, cases in found
        )

    def _quantities_of(self, model: Model, calls: list[Call]) -> Numbers:
        return self.quantities(calls, list(evaluated(model, calls)))

    def _diagnosis(
        self, calls: list[Call], expected: Numbers, given: Numbers, met: list[bool], ask: Ask | None
    ) -> list[tuple[str, ...]]:
        """What to say of each criterion: nothing of one that is met."""
        layout = layouts(given, expected)
        wrong = wrong_numbers(self.mistakes, self.catalogue, self.quantities, layout, calls)
        right, theirs = rows(layout, expected), rows(layout, given)
        if mistake := wrong.explaining(self.criteria, layout, theirs, met):
            return [() if ok else (mistake.sentence,) for ok in met]

        apart = isinstance(self.quantities, each)
        again = AskedAgain(
            ask, self.signature, self.criteria, calls, expected, given, self._given,
            partial(self._quantities_of, self.reference) if apart else None,
        )  # fmt: skip

        @cache
        def parts() -> list[tuple[Term, Numbers]]:
            terms = self.terms if isinstance(self.terms, tuple) else self.terms()
            return [(term, self._quantities_of(term.model, calls)) for term in terms]

        return sentences(
            self.criteria, expected, given, met, wrong, parts, again.unsteady, again.elsewhere,
            lambda: on_top(wrong, self.criteria, layout, right, theirs, met),
        )  # fmt: skip

    def _witness(
        self, calls: list[Call], expected: Numbers, given: Numbers, met: list[bool],
        values: list, when: str = "",
    ) -> Witness:  # fmt: skip
        k = met.index(False)
        criterion = self.criteria[k]
        worst = int(np.argmax(errors_of(self.criteria, expected, given)[k]))
        right, theirs = expected[worst][k], given[worst][k]
        name = self.returns or self.name
        at = worst_entry(right, theirs)
        lacking = criterion.of_lacking
        where = (
            place(name, self.quantities, calls, values, worst, k, at) if not lacking else NOWHERE
        )
        largest = max(float(np.max(np.abs(case[k]), initial=0.0)) for case in expected)
        # A quantity formed from several values is not what the function returned.
        what = "" if len(self.criteria) == 1 else criterion.text
        named = criterion.entries or criterion.is_truth or lacking
        if what and not named and wrong_places(criterion, expected, given, k) == {at}:
            what += ", of which no other entry is wrong"
        what = ", ".join(filter(None, [what, when]))
        call = calls[worst]
        found = witness(
            call, self.signature, right, theirs, criterion, largest, where, what, self.pose
        )
        return replace(found, given_by=given_by(call, self.signature, self.id))
