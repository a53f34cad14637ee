"""What a mechanism's models return for calls, of all calls at once."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from types import SimpleNamespace

import numpy as np

from autograder.mechanisms.outline import Outline
from autograder.mutation.answers import ANSWERS
from autograder.mutation.answers.answer import states
from autograder.mutation.shared import shared
from autograder.protocol import Call


@dataclass(frozen=True)
class Model:
    """What an answer, or a part of it, is: a function with the arguments of the student's function.

    numbers: from the columns of calls to what is returned for them, (cases, …).
    """

    mechanism: Outline
    answer: str
    numbers: Callable[..., np.ndarray]

    def __call__(self, *args) -> np.ndarray:
        return np.array(self.numbers(*_columns(self.mechanism, self.answer)(args))[0])

    def for_calls(self, calls: list[Call]) -> np.ndarray:
        """For each call what is returned, as `of_calls`."""
        return of_calls(
            self.mechanism, self.answer, calls, lambda *c: self.numbers(*c)[np.newaxis]
        )[0]


@dataclass(frozen=True)
class Gathered:
    """A model that takes other arguments, of which `gathered` makes those of a `Model`."""

    model: Model
    gathered: Callable[[tuple], tuple]

    def __call__(self, *args) -> np.ndarray:
        return self.model(*self.gathered(args))

    def for_calls(self, calls: list[Call]) -> np.ndarray:
        if calls[0].at:
            return self.model.for_calls(calls)  # at points, whose numbers have names
        return self.model.for_calls([replace(c, args=self.gathered(c.args)) for c in calls])


def of_calls(
    mechanism: Outline, answer: str, calls: list[Call], numbers: Callable[..., np.ndarray]
) -> np.ndarray:
    """What models return for each call, (models, calls, …). numbers: of columns, (models, cases, …).

    A call of symbols gives a number for each of its points. Where calls differ in their numbers of
    rows, as motions do, the array is one of objects, (models, calls).
    """
    columns = _columns(mechanism, answer)
    if calls[0].at:
        points = [_state(mechanism, point) for call in calls for point in call.at]
        found = numbers(*columns(*points))
        return found.reshape(-1, len(calls), len(calls[0].at))
    args = [call.args for call in calls]
    places: dict[tuple, list[int]] = {}
    for k, (first, *_) in enumerate(args):
        places.setdefault(np.shape(first), []).append(k)
    if len(places) == 1:
        return numbers(*columns(*args))
    of_each = [(alike, numbers(*columns(*(args[k] for k in alike)))) for alike in places.values()]
    every = np.empty((len(of_each[0][1]), len(calls)), dtype=object)
    for alike, found in of_each:
        for m, case in np.ndindex(found.shape[:2]):
            every[m, alike[case]] = found[m, case]
    return every


@lru_cache(maxsize=128)
def _columns(mechanism: Outline, answer: str) -> Callable[..., tuple]:
    """From the arguments of calls, a tuple each, to what an answer's numbers take."""
    composed = ANSWERS[answer].composition
    columns = composed(mechanism).columns if composed else states
    return shared(lambda *calls: columns(list(calls)))


def _state(mechanism: Outline, point: Mapping[str, float]) -> tuple:
    """q, q̇ and the arm of a point at which an expression is tried, by the mechanism's names."""
    q = np.array([point[c.name] for c in mechanism.coordinates])
    qd = np.array([point[c.rate] for c in mechanism.coordinates])
    return q, qd, SimpleNamespace(**{p.name: point[p.name] for p in mechanism.parameters})
