"""What an answer gave for the calls of a check: numbers to judge, or why there are none.

A fault is a call without numbers. Where all calls gave numbers but some are not finite, the criteria
are judged that do not hang on these.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from autograder.judging import zeros
from autograder.judging.call_text import by_name, given_by, shapes, shown_call
from autograder.judging.faults import NUMBERS, describe_unfit
from autograder.judging.models import Model, evaluated
from autograder.judging.partial import first_bad_point, partial, where_not_finite
from autograder.judging.quantities import Numbers, Quantities, UnfitError
from autograder.judging.verdict import Failed
from autograder.protocol import Call, Fault, FaultKind, Reply, Symbol, is_finite

# No call was made where these stand.
UNCALLED = (FaultKind.MISSING, FaultKind.CELL_FAILED, FaultKind.NOT_CALLABLE, FaultKind.NO_TOOLS)

Describe = Callable[[Fault, str, str, str], str]


class NoNumbersError(Exception):
    """An answer gave nothing that can be judged; the text is the sentence for the student.

    failed: the call because of which; None where no call was made.
    """

    def __init__(self, problem: str, failed: Failed | None = None):
        super().__init__(problem)
        self.failed = failed


@dataclass(frozen=True)
class Given:
    """The quantities of an answer, case by case.

    values: what came back, of which they were formed. spoilt: for each criterion, whether its numbers
    hang on one that is not finite. problem, failed: the sentence about that one, and the call that gave
    it.
    """

    numbers: Numbers
    values: list
    spoilt: tuple[bool, ...]
    problem: str = ""
    failed: Failed | None = None

    @classmethod
    def sound(cls, numbers: Numbers, values: list) -> "Given":
        """Of numbers that are all finite."""
        return cls(numbers, values, len(numbers[0]) * (False,))

    def but_spoilt(self, others: Numbers) -> Numbers:
        """The quantities, with others for those that hang on a number that is not finite."""
        return [
            tuple(b if bad else a for a, b, bad in zip(case, other, self.spoilt, strict=True))
            for case, other in zip(self.numbers, others, strict=True)
        ]


@dataclass(frozen=True)
class Reading:
    """How replies are read: for which check, by which quantities.

    right: the model of the right answer. describe: says what a fault is.
    """

    id: str
    signature: str
    quantities: Quantities
    right: Model
    describe: Describe

    def given(self, calls: list[Call], replies: list[Reply]) -> Given:
        """What is judged in the replies; NoNumbersError where there is nothing to judge."""
        replies = [_of_kind(call, reply) for call, reply in zip(calls, replies, strict=False)]
        faults = [k for k, reply in enumerate(replies) if reply.fault]
        if faults:
            raise self._of_faults(calls, replies, faults)
        values = [reply.value for reply in replies]
        bad = [k for k, value in enumerate(values) if not is_finite(value)]
        try:
            if not bad:
                numbers = self.quantities(calls, values)
                return Given.sound(numbers, values)
            found = partial(self.quantities, calls, values)
        except UnfitError as error:
            unfit = self._unfit(calls, values)
            first = calls[unfit[0]]
            said = describe_unfit(
                self.signature,
                str(error),
                first.truth,
                values[unfit[0]],
                evaluated(self.right, [first])[0],
            )
            raise NoNumbersError(said, self.failed(calls, unfit)) from None
        first, value = calls[bad[0]], values[bad[0]]
        at_points = bool(first.at)
        problem = (
            f"{self.signature} returned {where_not_finite(value, at_points)}, "
            "which is not a finite number."
        )
        if cause := replies[bad[0]].cause:
            problem += f" {cause.sentence}"
        if where := zeros.sentence(self.signature, calls, bad):
            problem += f" {where}"
        if at_points:  # the call that is shown has numbers for its symbols: those that give this
            point = first.at[first_bad_point(np.asarray(value))]
            calls = [*calls[: bad[0]], replace(first, at=(point,)), *calls[bad[0] + 1 :]]
        failed = replace(self.failed(calls, bad), works="")
        if found is None:
            raise NoNumbersError(problem, failed)
        return Given(found.numbers, values, found.spoilt, problem, failed)

    def _of_faults(
        self, calls: list[Call], replies: list[Reply], faults: list[int]
    ) -> NoNumbersError:
        fault = replies[faults[0]].fault
        assert fault is not None
        name = self.signature.partition("(")[0]
        said = self.describe(fault, name, self.signature, needed(calls[0]))
        if fault.kind in UNCALLED:
            return NoNumbersError(said)
        if fault.message.startswith("ZeroDivisionError"):
            where = zeros.sentence(self.signature, calls[: len(replies)], faults)
            said = f"{said} {where}".strip()
        return NoNumbersError(said, self.failed(calls[: len(replies)], faults, len(calls)))

    def failed(self, calls: list[Call], bad: list[int], asked: int | None = None) -> Failed:
        """What a card shows of the calls that failed.

        calls: those that were made. asked: how many should have been, where not all were.
        """
        first = calls[bad[0]]
        shown = shown_call(first, self.signature)
        works = next((k for k in range(len(calls)) if k not in bad), None)
        working = ""
        if works is not None:
            call = calls[works]
            working = shown_call(call, self.signature) + shapes(call, self.signature)
        whole = asked is None or asked == len(calls)
        return Failed(
            shown,
            len(bad),
            len(calls) if whole else 0,
            "" if working == shown else working,  # symbols, which say nothing
            given_by(first, self.signature, self.id),
            first,
            by_name(first, self.signature),
            None if works is None else calls[works],
        )

    def _unfit(self, calls: list[Call], values: list) -> list[int]:
        """The calls whose values alone, among right ones, do not have the shape that is asked for."""
        right = evaluated(self.right, calls)
        found = []
        for k, value in enumerate(values):
            try:
                self.quantities(calls, [*right[:k], value, *right[k + 1 :]])
            except UnfitError:
                found.append(k)
        return found or [0]


def _of_kind(call: Call, reply: Reply) -> Reply:
    """The reply; a fault where it holds what no reply to this call can, as one from the sandbox may."""
    if reply.fault or call.parts:
        return reply
    value: Any = reply.value
    if isinstance(value, dict | list) or (call.at and np.shape(value)[:1] != (len(call.at),)):
        return Reply(fault=Fault(FaultKind.GARBLED))
    return reply


def needed(call: Call) -> str:
    """What a call's function should return, in words."""
    if call.truth:
        return "True or False"
    if not call.at:
        return NUMBERS
    symbols = all(isinstance(value, Symbol) for value in call.args)
    return f"{'a SymPy expression' if symbols else 'SymPy expressions'} of its arguments"
