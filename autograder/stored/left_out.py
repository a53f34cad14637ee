"""A check that needs the equations themselves: a student's package leaves it to the grader."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from autograder.judging import verdict
from autograder.judging.check import Ask, CannotRunError, Check
from autograder.judging.faults import describe_fault, describe_unfit
from autograder.judging.given import NoNumbersError, Reading
from autograder.judging.quantities import UnfitError
from autograder.judging.verdict import State, Verdict
from autograder.protocol import Call, FaultKind, Reply


@dataclass(frozen=True)
class LeftOut(Check):
    """Whether the numbers are right is left to the grader; whether there are any is seen here.

    why: what it would need, as a sentence for the student. fits: reads a value; UnfitError where it
    does not have the form that is asked for.
    """

    why: str = ""
    fits: Callable = np.asarray

    def run(self, ask: Ask, rng, count: int = 0, carrying=None) -> Verdict:
        """That it is judged when it is handed in; or why the grader would have nothing to judge."""
        calls = self.calls(rng, count)
        try:
            replies = ask(calls)
        except CannotRunError as error:
            return verdict.check_failed(self.id, error)
        fault = next((reply.fault for reply in replies if reply.fault), None)
        if fault and fault.kind is FaultKind.NOT_IMPLEMENTED:
            return verdict.not_attempted(self.id, self.signature, fault.line)
        try:
            self._read(calls, replies)
        except NoNumbersError as error:
            return verdict.error(self.id, str(error), error.failed)
        return Verdict(self.id, State.NOT_HERE, problem=self.why)

    def _read(self, calls: list[Call], replies: list[Reply]) -> None:
        reading = Reading(self.id, self.signature, _no_quantities, self.reference, describe_fault)
        values = reading.given(calls, replies).values
        for place, (call, value) in enumerate(zip(calls, values, strict=True)):
            try:
                self.fits(value)
            except UnfitError as error:
                # None is right here that its shape could be compared with.
                said = describe_unfit(self.signature, str(error), call.truth, value, [])
                raise NoNumbersError(said, reading.failed(calls, [place])) from None


def _no_quantities(calls: list[Call], values: list) -> list[tuple[np.ndarray, ...]]:
    return [(np.zeros(1),) for _ in calls]
