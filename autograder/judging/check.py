"""A check: which function the student defines, what to call it with, and how its numbers are judged.

One check serves the student's cell, `nbgrader validate` and the grader; they differ only in where the
function runs (`ask`) and in how many cases are drawn.
"""

from collections.abc import Callable
from dataclasses import dataclass
from types import FunctionType

import numpy as np

from autograder.judging import changes
from autograder.judging.diagnosis import (
    TOLERANCE,
    Known,
    Mistake,
    Term,
    mistakes_shown,
    relative_errors,
    terms_off,
)
from autograder.judging.faults import said_of, said_of_second
from autograder.judging.quantities import Quantities, UnfitError, finite, one_number
from autograder.judging.verdict import Row, State, Verdict
from autograder.judging.witness import witness
from autograder.protocol import Call, Fault, FaultKind, Reply, Symbol, read, real, shortened

VISIBLE_CASES = 6
HIDDEN_CASES = 24

Ask = Callable[[list[Call]], list[Reply]]


class CannotRunError(Exception):
    """An answer cannot be run on the machine that judges, which is not its fault."""


@dataclass(frozen=True)
class Criterion:
    """One thing that is asked of an answer: in words, its unit, its share of the credit.

    otherwise: what to say where it is not met and no known mistake matches. tolerance: the relative
    error that rounding, or the method that is asked for, explains. matching: the error within which
    an answer shows a known mistake, where that must be less, as wrong answers lie close together;
    by default the same. is_property: true of the answer
    as a whole, as skew-symmetry is; what breaks it is looked for among the mistakes that are shown
    already, and not in its own numbers, which many answers share.
    """

    text: str
    unit: str
    share: float = 1.0
    otherwise: str = ""
    tolerance: float = TOLERANCE
    is_property: bool = False
    matching: float | None = None

    def allows(self, met: bool) -> float:
        """The relative error within which a mistake's numbers are an answer's, met or not."""
        return self.tolerance if met or self.matching is None else self.matching


class Check:
    """What is asked of one function. A problem makes one instance a graded cell.

    id: the grade_id of its cell. signature: how the function is called. reference: the right answer,
    with the same arguments. calls(rng, count): the calls to try. quantities(calls, values): what is
    judged in the values, for each call one array a criterion; by default the one number that came
    back. mistakes: tried in order on each criterion that is not met. terms: the parts of the right
    answer, on which an error that no mistake explains is projected. hints: from a nudge to nearly
    the way. pose(call): the joints of the arm in a call, to be drawn beside the worst case.
    """

    def __init__(
        self,
        id: str,
        signature: str,
        reference: Callable,
        calls: Callable[[np.random.Generator, int], list[Call]],
        criteria: tuple[Criterion, ...],
        mistakes: tuple[Mistake, ...] = (),
        quantities: Quantities = one_number,
        terms: tuple[Term, ...] = (),
        hints: tuple[str, ...] = (),
        pose: Callable[[Call], list] | None = None,
    ):
        self.id = id
        self.signature = signature
        self.name = signature.partition("(")[0]
        self.reference = reference
        self.calls = calls
        self.criteria = criteria
        self.mistakes = mistakes
        self.quantities = quantities
        self.terms = terms
        self.hints = hints
        self.pose = pose

    def run(self, ask: Ask, rng: np.random.Generator, count: int = VISIBLE_CASES) -> Verdict:
        """Try the student's function and judge it. Never raises: a fault of ours is its own state."""
        try:
            calls = self.calls(rng, count)
            expected = self._quantities_of(self.reference, calls)
            # The reference goes first: where it fails the check is to blame, not the student.
            if not all(self._met(self._errors(expected, expected))):
                raise ArithmeticError("the reference does not pass its own check")
        except Exception as error:
            return self._failed(error)
        try:
            replies = ask(calls)
        except CannotRunError as error:
            return self._failed(error)
        fault = next((reply.fault for reply in replies if reply.fault), None)
        if fault:
            return self._faulty(fault)
        changed = changes.changed(self.signature, calls, replies)
        try:
            # Near the largest float, their numbers less ours overflow: wrong, but not our failure.
            with np.errstate(over="ignore", invalid="ignore"):
                given = self.quantities(calls, [finite(reply.value) for reply in replies])
                if not any(reply.again for reply in replies):
                    return self.judge(calls, expected, given, changed=changed)
        except UnfitError as error:
            return self._error(f"{self.signature} returned {error}.")
        except Exception as error:
            return self._failed(error)
        return self._judge_again(calls, expected, given, replies, changed)

    def _judge_again(self, calls, expected, given, replies, changed) -> Verdict:
        """The verdict where second calls must be right as well."""
        second = [reply.again or reply for reply in replies]
        fault = next((reply.fault for reply in second if reply.fault), None)
        if fault:
            said = said_of_second(fault, self.name, self.signature)
            return self._error(
                f"{changes.remark(self.name, changed, True)} On the second call, {said}"
            )
        try:
            with np.errstate(over="ignore", invalid="ignore"):
                again = self.quantities(calls, [finite(reply.value) for reply in second])
                return self.judge(calls, expected, given, again, changed)
        except UnfitError as error:
            said = f"{self.signature} returned {error}."
            return self._error(
                f"{changes.remark(self.name, changed, True)} On the second call, {said}"
            )
        except Exception as error:
            return self._failed(error)

    def judge(
        self, calls: list[Call], expected: list, given: list, again: list | None = None,
        changed: tuple[str, ...] = (),
    ) -> Verdict:  # fmt: skip
        """The verdict on quantities given, case by case, against those expected.

        again: the quantities of second calls, where a first one changed its arguments; a criterion is
        met where both are right. changed: the names of these arguments.
        """
        errors = self._errors(expected, given)
        right = self._met(errors)
        met = right
        if again is not None:
            later = self._errors(expected, again)
            met = [one and two for one, two in zip(right, self._met(later), strict=True)]
        remark = changes.remark(self.name, changed, met != right)
        credit = sum(c.share for c, ok in zip(self.criteria, met, strict=True) if ok)
        rows = tuple(Row(c.text, c.share, ok) for c, ok in zip(self.criteria, met, strict=True))
        if all(met):
            return Verdict(self.id, State.CORRECT, 1.0, rows, remark=remark)
        if all(right):  # only what it does to its arguments is wrong
            worst, diagnosis = self._witness(calls, expected, again, later, met, changes.SECOND), ()
        else:
            worst = self._witness(calls, expected, given, errors, right)
            diagnosis = self._diagnosis(calls, expected, given, right)
        return Verdict(
            self.id,
            State.PARTLY_CORRECT if credit > 0 else State.INCORRECT,
            credit,
            rows,
            worst,
            diagnosis=diagnosis,
            remark=remark,
            next_step="Change your function, run its cell, then run this cell again.",
        )

    def _errors(self, expected, given) -> list[np.ndarray]:
        """For each criterion the relative error of each case."""
        return [self._error_of(k, expected, given) for k in range(len(self.criteria))]

    def _error_of(self, k, expected, given) -> np.ndarray:
        return relative_errors([e[k] for e in expected], [g[k] for g in given])

    def _same(self, wrong, given, met) -> bool:
        """Whether a mistake's numbers are those given, asked no further than where they differ."""
        return all(
            np.all(self._error_of(k, wrong, given) <= criterion.allows(met[k]))
            for k, criterion in enumerate(self.criteria)
        )

    def _met(self, errors) -> list[bool]:
        return [
            bool(np.all(error <= criterion.tolerance))
            for error, criterion in zip(errors, self.criteria, strict=True)
        ]

    def _quantities_of(self, model: Callable, calls: list[Call]) -> list[tuple[np.ndarray, ...]]:
        return self.quantities(calls, [_evaluated(model, call) for call in calls])

    def _diagnosis(self, calls, expected, given, met) -> tuple[str, ...]:
        """What to say of each criterion that is not met."""
        wrong = [(mistake, self._quantities_of(mistake.wrong, calls)) for mistake in self.mistakes]
        for mistake, values in wrong:
            if self._same(values, given, met):  # it explains the whole answer
                return (mistake.sentence,)
        parts = [(term, self._quantities_of(term.model, calls)) for term in self.terms]
        sentences = []
        for k, (criterion, ok) in enumerate(zip(self.criteria, met, strict=True)):
            if ok:
                continue
            right, theirs = [e[k] for e in expected], [g[k] for g in given]
            known = [Known(mistake, [value[k] for value in values]) for mistake, values in wrong
                     if mistake.sentence in sentences or not criterion.is_property]  # fmt: skip
            shown = mistakes_shown(right, theirs, known, criterion.allows(met=False))
            sentences += [mistake.sentence for mistake in shown]
            if not shown:
                known = [Known(term, [value[k] for value in values]) for term, values in parts
                         if not criterion.is_property]  # fmt: skip
                off = terms_off(right, theirs, known)
                sentences += [_where(criterion, off)] if off else [criterion.otherwise]
        return tuple(dict.fromkeys(filter(None, sentences)))

    def _witness(self, calls, expected, given, errors, met, when=""):
        k = met.index(False)
        worst = int(np.argmax(errors[k]))
        # A quantity formed from several values is not what the function returned.
        what = "" if len(self.criteria) == 1 else self.criteria[k].text
        what = ", ".join(filter(None, [what, when]))
        unit = self.criteria[k].unit
        return witness(calls[worst], expected[worst][k], given[worst][k], unit, what, self.pose)

    def _faulty(self, fault: Fault) -> Verdict:
        if fault.kind is FaultKind.NOT_IMPLEMENTED:
            return Verdict(
                self.id,
                State.NOT_ATTEMPTED,
                next_step=f"Write {self.signature} where it says NotImplementedError, "
                "run its cell, then run this cell again.",
            )
        return self._error(said_of(fault, self.name, self.signature))

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


def _where(criterion: Criterion, off: list[tuple[Term, float, float]]) -> str:
    """No known mistake, but the error is made of known terms: their names, and by how much."""
    said = " and ".join(f"{term.name} ({factor:+.2g} times it)" for term, _, factor in off)
    return f"The error in your {criterion.text} varies like {said}."


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
