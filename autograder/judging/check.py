"""A check: which function the student defines, what to call it with, and how its numbers are judged.

One check serves the student's cell, `nbgrader validate` and the grader; they differ only in where the
function runs (`ask`) and in how many cases are drawn.
"""

import math
import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import chain, groupby
from types import FunctionType

import numpy as np

from autograder.judging import changes, dependence
from autograder.judging.criterion import Criterion, relative_errors
from autograder.judging.diagnosis import Catalogue, Mistake, Wrong, sentences
from autograder.judging.faults import NUMBERS, describe_fault, describe_second_fault
from autograder.judging.quantities import (
    Numbers,
    Quantities,
    UnfitError,
    each,
    finite,
    one_number,
)
from autograder.judging.section import Section
from autograder.judging.stacked import Layout, layouts, rows, stacked
from autograder.judging.terms import Term
from autograder.judging.verdict import Row, State, Verdict, Witness
from autograder.judging.witness import witness
from autograder.protocol import Call, Fault, FaultKind, Reply, Symbol, read, real, shortened

VISIBLE_CASES = 6
HIDDEN_CASES = 24
# An answer that took longer, s, is not called again to find out more about it.
SLOW = 2.0

Ask = Callable[[list[Call]], list[Reply]]


class CannotRunError(Exception):
    """An answer cannot be run on the machine that judges, which is not its fault."""


class _NoNumbersError(Exception):
    """An answer gave nothing that can be judged; the text is the sentence for the student."""


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
    worst case.

    ValueError where the shares of the criteria do not add up to 1, or where two criteria have one
    text, two mistakes or terms one name, or two hints are the same.
    """

    id: str
    signature: str
    reference: Callable
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

    def run(self, ask: Ask, rng: np.random.Generator, count: int = VISIBLE_CASES) -> Verdict:
        """Try the student's function and judge it.

        An error in the check, or CannotRunError from `ask`, is a verdict of its own: CHECK_FAILED. Any
        other error that `ask` raises goes on to the caller, and so does an interrupt.
        """
        try:
            calls = self.calls(rng, count)
            expected = self._quantities_of(self.reference, calls)
            # The reference goes first: where it fails the check is to blame, not the student.
            if not all(self._met(self._errors(expected, expected))):
                raise ArithmeticError("the reference does not pass its own check")
        except Exception as error:
            return self._failed(error)
        try:
            started = time.monotonic()
            replies = ask(calls)
            ask_again = ask if time.monotonic() - started < SLOW else None
        except CannotRunError as error:
            return self._failed(error)
        try:
            # Near the largest float, their numbers less ours overflow: wrong, but not our failure.
            with np.errstate(over="ignore", invalid="ignore"):
                return self._judge_replies(calls, expected, replies, ask_again)
        except Exception as error:
            return self._failed(error)

    def _judge_replies(
        self, calls: list[Call], expected: Numbers, replies: list[Reply], ask: Ask | None
    ) -> Verdict:
        fault = next((reply.fault for reply in replies if reply.fault), None)
        if fault and fault.kind is FaultKind.NOT_IMPLEMENTED:
            return self._not_attempted()
        changed = changes.changed(self.signature, calls, replies)
        try:
            given = self._given(calls, replies, describe_fault)
        except _NoNumbersError as error:
            return self._error(str(error))
        if not any(reply.again for reply in replies):
            return self.judge(calls, expected, given, changed=changed, ask=ask)
        second = [reply.again or reply for reply in replies]
        try:
            again = self._given(calls, second, describe_second_fault)
        except _NoNumbersError as error:
            return self._error(
                f"{changes.remark(self.name, changed, True)} On the second call, {error}"
            )
        return self.judge(calls, expected, given, again, changed, ask)

    def _given(
        self,
        calls: list[Call],
        replies: list[Reply],
        describe: Callable[[Fault, str, str, str], str],
    ) -> Numbers:
        """What is judged in the replies; _NoNumbersError where it cannot be formed."""
        for reply in replies:
            if reply.fault:
                needed = _needed(calls[0])
                raise _NoNumbersError(describe(reply.fault, self.name, self.signature, needed))
        try:
            return self.quantities(calls, [finite(reply.value) for reply in replies])
        except UnfitError as error:
            raise _NoNumbersError(f"{self.signature} returned {error}.") from None

    def judge(
        self, calls: list[Call], expected: Numbers, given: Numbers, again: Numbers | None = None,
        changed: tuple[str, ...] = (), ask: Ask | None = None,
    ) -> Verdict:  # fmt: skip
        """The verdict on quantities given, case by case, against those expected.

        again: the quantities of second calls, where a first one changed its arguments; a criterion is
        met where both are right. changed: the names of these arguments. ask: by which more may be found
        out of an answer that no mistake explains.
        """
        right = met = self._met(self._errors(expected, given))
        if again is not None:
            later = self._met(self._errors(expected, again))
            met = [one and two for one, two in zip(right, later, strict=True)]
        remark = changes.remark(self.name, changed, met != right)
        credit = sum(c.share for c, ok in zip(self.criteria, met, strict=True) if ok)
        said: list[tuple[str, ...]] = [()] * len(met)
        if all(met):
            rows = self._rows(met, said)
            return Verdict(self.id, State.CORRECT, 1.0, rows, remark=remark, further=self.further)
        if again is not None and all(right):  # only what it does to its arguments is wrong
            worst = self._witness(calls, expected, again, met, changes.SECOND)
        else:
            worst = self._witness(calls, expected, given, right)
            said = self._diagnosis(calls, expected, given, right, ask)
        return Verdict(
            self.id,
            State.PARTLY_CORRECT if credit > 0 else State.INCORRECT,
            credit,
            self._rows(met, said),
            worst,
            diagnosis=tuple(dict.fromkeys(chain.from_iterable(said))),
            remark=remark,
            next_step="Change your function, run its cell, then run this cell again.",
        )

    def _rows(self, met: list[bool], said: Sequence[tuple[str, ...]]) -> tuple[Row, ...]:
        """One a criterion. said: what is known of each."""
        found = zip(self.criteria, met, said, strict=True)
        return tuple(Row(c.text, c.share, ok, sentences) for c, ok, sentences in found)

    def _errors(self, expected: Numbers, given: Numbers) -> list[np.ndarray]:
        """For each criterion the relative error of each case."""
        return [
            relative_errors([e[k] for e in expected], [g[k] for g in given])
            for k in range(len(self.criteria))
        ]

    def _met(self, errors: list[np.ndarray]) -> list[bool]:
        return [
            criterion.met(error) for error, criterion in zip(errors, self.criteria, strict=True)
        ]

    def _quantities_of(self, model: Callable, calls: list[Call]) -> Numbers:
        return self.quantities(calls, [_evaluated(model, call) for call in calls])

    def _diagnosis(
        self, calls: list[Call], expected: Numbers, given: Numbers, met: list[bool], ask: Ask | None
    ) -> list[tuple[str, ...]]:
        """What to say of each criterion: nothing of one that is met."""
        layout = layouts(given, expected)
        wrong = self._wrong(layout, calls)
        if mistake := wrong.explaining(self.criteria, layout, rows(layout, given), met):
            return [() if ok else (mistake.sentence,) for ok in met]

        @cache  # calls are made once, and only where something is left to explain
        def tried() -> tuple[list[dependence.Probe], Numbers, Numbers] | None:
            return self._tried(ask, calls[-1]) if ask else None

        def elsewhere(k: int) -> str:
            criterion = self.criteria[k]
            if not criterion.unit or criterion.is_property or (found := tried()) is None:
                return ""
            return dependence.sentence(criterion.text, k, *found)

        @cache
        def parts() -> list[tuple[Term, Numbers]]:
            terms = self.terms if isinstance(self.terms, tuple) else self.terms()
            return [(term, self._quantities_of(term.model, calls)) for term in terms]

        return sentences(self.criteria, expected, given, met, wrong, parts, elsewhere)

    def _wrong(self, layout: list[Layout], calls: list[Call]) -> Wrong:
        """The numbers of every mistake."""
        mistakes = list(self.mistakes)
        found = [rows(layout, self._quantities_of(m.wrong, calls)) for m in mistakes]
        parts = [
            np.array([own[k] for own in found]).reshape(len(found), of.length)
            for k, of in enumerate(layout)
        ]
        made = self.catalogue(calls) if self.catalogue else []
        mistakes += [mistake for mistake, _ in made]
        for shape, group in groupby((values for _, values in made), _shape):
            alike = list(group)
            if shape is None:
                one_by_one = [rows(layout, self.quantities(calls, list(own))) for own in alike]
                more = [np.array(own) for own in zip(*one_by_one, strict=True)]
            else:
                numbers = np.array([np.asarray(list(own), dtype=float) for own in alike])
                more = stacked(layout, self.quantities, calls, numbers)
            parts = [np.vstack(both) for both in zip(parts, more, strict=True)]
        return Wrong(mistakes, parts)

    def _tried(
        self, ask: Ask, base: Call
    ) -> tuple[list[dependence.Probe], Numbers, Numbers] | None:
        """The call with one number changed at a time: the right quantities and theirs, if all came."""
        probes = dependence.probes(self.signature, base)
        if not probes or not isinstance(self.quantities, each):
            return None
        calls = [base, *(probe.call for probe in probes)]
        replies = ask(calls)
        if len(replies) < len(calls) or any(reply.fault for reply in replies):
            return None
        try:
            theirs = self._given(calls, replies, describe_fault)
        except _NoNumbersError:
            return None
        return probes, self._quantities_of(self.reference, calls), theirs

    def _witness(
        self, calls: list[Call], expected: Numbers, given: Numbers, met: list[bool], when: str = ""
    ) -> Witness:
        k = met.index(False)
        criterion = self.criteria[k]
        worst = int(np.argmax(self._errors(expected, given)[k]))
        # A quantity formed from several values is not what the function returned.
        what = "" if len(self.criteria) == 1 else criterion.text
        what = ", ".join(filter(None, [what, when]))
        return witness(
            calls[worst], expected[worst][k], given[worst][k], criterion, what, self.pose
        )

    def _not_attempted(self) -> Verdict:
        return Verdict(
            self.id,
            State.NOT_ATTEMPTED,
            next_step=f"Write {self.signature} where it says NotImplementedError, "
            "run its cell, then run this cell again.",
        )

    def _error(self, problem: str) -> Verdict:
        step = "Fix this first: the check can't look at the physics until the function runs."
        return Verdict(self.id, State.ERROR, problem=problem, next_step=step)

    def _failed(self, error: Exception) -> Verdict:
        return Verdict(
            self.id,
            State.CHECK_FAILED,
            problem=f"{type(error).__name__} in the check {self.id}: {shortened(str(error))}.",
            next_step="This is not your fault. Please tell your instructor.",
        )


def _shape(values) -> tuple[int, ...] | None:
    """Of what came for all calls; None where calls differ in it, as motions do."""
    if isinstance(values, np.ndarray) and values.dtype != object:
        return values.shape
    shapes = {np.shape(value) for value in values}
    return (len(values), *shapes.pop()) if len(shapes) == 1 else None


def _needed(call: Call) -> str:
    """What a call's function should return, in words."""
    if call.truth:
        return "True or False"
    if not call.at:
        return NUMBERS
    symbols = all(isinstance(value, Symbol) for value in call.args)
    return f"{'a SymPy expression' if symbols else 'SymPy expressions'} of its arguments"


def _evaluated(model: Callable, call: Call):
    """A model's numbers for a call, as those of a student's function are read.

    A model of plain Symbols is one of numbers here, and tried point by point. One of expressions may
    give a function from a point to its numbers, which costs less than an expression.
    """
    if call.at and all(isinstance(value, Symbol) for value in call.args):
        points = [[point[symbol.name] for symbol in call.args] for point in call.at]
        return np.array([model(*point) for point in points], dtype=float)
    result = model(*map(real, call.args))
    if call.at and isinstance(result, FunctionType):
        return np.array([result(point) for point in call.at], dtype=float)
    return read(call, result)
