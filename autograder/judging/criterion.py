"""What is asked of an answer, and whether its numbers meet it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from autograder.judging.quantities import Numbers

# An answer is right to rounding. Single precision through a few operations leaves 4e-6 of the scale
# below; a wrong formula shows at 1e-4 or more.
TOLERANCE = 1e-5
# A case counts at no less than this share of the largest one, so that a value near zero, where
# single precision has no digits left, is not judged by itself.
LEAST_SCALE = 0.05


@dataclass(frozen=True)
class Answered:
    """A wrong answer: the right quantities and the given ones, and which criteria are met."""

    expected: Numbers
    given: Numbers
    met: list[bool]


@dataclass(frozen=True)
class Said:
    """A sentence on a criterion that is not met, and of which answers it is true."""

    text: str
    holds: Callable[[Answered], bool] = lambda answered: True


@dataclass(frozen=True)
class Criterion:
    """One thing that is asked of an answer: in words, its unit, its share of the credit.

    otherwise: what to say where it is not met and no known mistake matches; of several, the first
    that holds. tolerance: the relative error that rounding, or the method that is asked for,
    explains. matching: the error within which an answer shows a known mistake, where that must be
    less, as wrong answers lie close together; by default the same. is_property: true of the answer
    as a whole, as skew-symmetry is; what breaks it is looked for among the mistakes that are shown
    already, and not in its own numbers, which many answers share. is_truth: the numbers are 1 for
    True and 0 for False, and have no unit. entries: what each of its numbers is called, "M12", where
    that says more than a place in an array. units: that of each of its numbers, row by row, where they
    differ. is_bound: numbers beyond the expected one are right as well, so that an error is no share of
    it. of_lacking: the numbers say what the answer lacks, so that no entry of it is to blame. in_loop:
    they come of closed loops, in which no known mistake is run; so what is found wrong elsewhere in an
    answer accounts for them.

    ValueError where the share is not in (0, 1], or a truth value has a unit.
    """

    text: str
    unit: str = ""
    share: float = 1.0
    otherwise: str | tuple[Said, ...] = ""
    tolerance: float = TOLERANCE
    is_property: bool = False
    matching: float | None = None
    is_truth: bool = False
    entries: tuple[str, ...] = ()
    units: tuple[str, ...] = ()
    is_bound: bool = False
    of_lacking: bool = False
    in_loop: bool = False

    def __post_init__(self):
        if not 0 < self.share <= 1:
            raise ValueError(f"criterion {self.text!r}: share is {self.share}, must be in (0, 1]")
        if self.is_truth and self.unit:
            raise ValueError(f"criterion {self.text!r}: a truth value has no unit {self.unit!r}")

    def unit_of(self, place: int, count: int) -> str:
        """The unit of one of its numbers, by its place in a row of them all."""
        return self.units[place] if len(self.units) == count else self.unit

    @property
    def said(self) -> tuple[Said, ...]:
        """All that `otherwise` may be."""
        return (Said(self.otherwise),) if isinstance(self.otherwise, str) else self.otherwise

    def unmet(self, answered: Answered) -> str:
        """What to say of an answer that does not meet it; "" for nothing."""
        return next((own.text for own in self.said if own.holds(answered)), "")

    def met(self, errors: np.ndarray) -> bool:
        """Whether no case's relative error is more than may be."""
        return bool(np.all(errors <= self.tolerance))

    def allows(self, met: bool) -> float:
        """The relative error within which a mistake's numbers are an answer's, met or not."""
        return self.tolerance if met or self.matching is None else self.matching


def errors_of(criteria: Sequence[Criterion], expected: Numbers, given: Numbers) -> list[np.ndarray]:
    """For each criterion the relative error of each case."""
    return [
        relative_errors([e[k] for e in expected], [g[k] for g in given])
        for k in range(len(criteria))
    ]


def met_by(criteria: Sequence[Criterion], expected: Numbers, given: Numbers) -> list[bool]:
    """Which criteria an answer meets."""
    errors = errors_of(criteria, expected, given)
    return [own.met(error) for own, error in zip(criteria, errors, strict=True)]


def relative_errors(expected: list, given: list) -> np.ndarray:
    """The largest error of each case over the scale of its expected value."""
    error = _largest([g - e for e, g in zip(expected, given, strict=True)])
    return error / scales(expected)


def scales(expected: list) -> np.ndarray:
    """What each case's error is measured by; 1 where all that is expected is 0."""
    size = _largest(expected)
    scale = np.maximum(size, LEAST_SCALE * np.max(size))
    return np.where(scale > 0, scale, 1.0)


def _largest(values: list) -> np.ndarray:
    """The largest entry of each; one array of all where they have one shape, as that is faster."""
    if len({np.shape(value) for value in values}) == 1:
        return np.max(np.abs(np.reshape(values, (len(values), -1))), axis=1, initial=0.0)
    sizes = [1 + np.size(value) for value in values]  # with a 0 before each, as some have no entry
    flat = np.zeros(sum(sizes))
    starts = np.cumsum([0, *sizes[:-1]])
    mask = np.ones(len(flat), dtype=bool)
    mask[starts] = False
    flat[mask] = np.concatenate([np.ravel(value) for value in values])
    return np.maximum.reduceat(np.abs(flat), starts)
