"""Models, right or wrong, and their numbers: functions with the arguments of the student's.

One that knows a shorter way to the numbers of several calls has `for_calls`.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np

from autograder.judging.loops import Loop
from autograder.protocol import Call, Symbol, read, real


@runtime_checkable
class OfCalls(Protocol):
    """A model that also gives what it returns for all calls in one step, in their order."""

    def for_calls(self, calls: list[Call], /) -> Sequence | np.ndarray: ...


@dataclass(frozen=True)
class AtPoints:
    """Stands for a model whose arguments are SymPy's: `of(call, point)` gives its numbers at a point.

    Nothing is read or differentiated by SymPy, which would take longer than all the rest.
    """

    of: Callable[[Call, Mapping[str, float]], np.ndarray]

    def for_calls(self, calls: list[Call]) -> list[np.ndarray]:
        """(points, …) for each call."""
        return [np.array([self.of(call, at) for at in call.at], dtype=float) for call in calls]


@dataclass(frozen=True)
class Beside:
    """A right model, with the student's arguments, that quantities need beside the answer.

    It marks what must not stay a formula where a check is stored in numbers.
    """

    model: "Model"

    def of(self, call: Call):
        """Its numbers for one call, as `evaluated` gives them."""
        return evaluated(self.model, [call])[0]


# Typed loosely: but for the few that stand for symbolic ones, each is a function.
Model = Callable


def evaluated(model: Model, calls: list[Call]) -> Sequence | np.ndarray:
    """A model's numbers for each call, as those of a student's function are read.

    A model of plain Symbols is one of numbers here, and tried point by point. None is run in a loop:
    there it has the figures of the right answer.
    """
    if isinstance(model, OfCalls):
        return model.for_calls(calls)
    return [_of_call(model, call) for call in calls]


def _of_call(model: Callable, call: Call):
    if isinstance(call, Loop):
        return call.right
    if call.at and all(isinstance(value, Symbol) for value in call.args):
        points = [[point[symbol.name] for symbol in call.args] for point in call.at]
        return np.array([model(*point) for point in points], dtype=float)
    return read(call, model(*map(real, call.args)))
