"""Finds out on which arguments alone the error of an answer depends: as a difference, or as a factor.

A wrong term of several is off by what its own arguments make of it; a wrong function of one argument
makes a product wrong by a factor that this argument alone changes.
"""

from collections.abc import Callable

import numpy as np

from autograder.judging.criterion import TOLERANCE
from autograder.judging.dependence import MOST_LISTED, ROUNDING, Tried, listed, moving
from autograder.judging.quantities import Numbers

# A right value of less than this share of the largest has no factor.
LEAST = 1e-3


def sentence(text: str, k: int, tried: list[Tried]) -> str:
    """What alone changes the error of quantity k, called `text`; "" where all that counts does.

    tried: the probes of some calls, in one of which the error is.
    """
    counts = {
        of
        for one in tried
        for numbers in (one.right, one.theirs)
        for of in moving(k, one.probes, numbers, ROUNDING)
    }
    off, factor = (_moving(k, tried, of, counts) for of in (_difference, _ratio))
    if off == []:
        return (
            f"What is off in your {text} is the same whatever the arguments are. Which of your terms "
            "is a mere number?"
        )
    if factor and (off is None or len(factor) < len(off)):
        return (
            f"The values of your {text} are off by a factor that changes with {listed(factor)} alone. "
            f"How should they change with {'it' if len(factor) == 1 else 'them'}?"
        )
    if off:
        return (
            f"What is off in your {text} changes with {listed(off)} alone. Which of its terms is made "
            "of nothing else?"
        )
    return ""


def _moving(k: int, tried: list[Tried], of: Callable, counts: set[str]) -> list[str] | None:
    """The arguments that change it; None where all do that count, or too many, or some a little."""
    clearly: dict[str, None] = {}
    slightly: set[str] = set()
    for one in tried:
        errors: Numbers = [
            (of(np.asarray(right[k]), np.asarray(theirs[k])),)
            for right, theirs in zip(one.right, one.theirs, strict=True)
        ]
        if any(np.any(np.isnan(error)) for (error,) in errors):
            return None
        clearly |= dict.fromkeys(moving(0, one.probes, errors, TOLERANCE))
        slightly |= {*moving(0, one.probes, errors, ROUNDING)}
    if slightly - clearly.keys() or len(clearly) > MOST_LISTED or not counts - clearly.keys():
        return None
    return list(clearly)


def _difference(right: np.ndarray, theirs: np.ndarray) -> np.ndarray:
    """0 where it is rounding."""
    size = max(np.max(np.abs(right), initial=0.0), np.max(np.abs(theirs), initial=0.0))
    return np.where(np.abs(theirs - right) > ROUNDING * size, theirs - right, 0.0)


def _ratio(right: np.ndarray, theirs: np.ndarray) -> np.ndarray:
    """NaN where a right value has none."""
    has = np.abs(right) > LEAST * np.max(np.abs(right), initial=0.0)
    return np.where(has, theirs / np.where(has, right, 1.0), np.nan)
