"""What is judged in the values that came back: from calls and values to one array a criterion.

A check's `quantities` takes all calls and all values, so that two calls may be compared: a potential
energy counts by its differences.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from autograder.protocol import Call

Numbers = list[tuple[np.ndarray, ...]]  # for each call, one array a criterion
Quantities = Callable[[list[Call], list], Numbers]


class UnfitError(Exception):
    """Numbers came back, but not as many, or not in the shape, that the question asks for."""


@dataclass(frozen=True)
class each:  # noqa: N801  (a decorator)
    """Quantities that are formed from each call's value by itself."""

    parts: Callable[[Call, np.ndarray], tuple[np.ndarray, ...]]

    def __call__(self, calls: list[Call], values: list) -> Numbers:
        return [self.parts(c, v) for c, v in zip(calls, values, strict=True)]


@each
def one_number(call: Call, value: np.ndarray) -> tuple[np.ndarray]:
    """A value that is one number, whether it came as a number, (1,) or (1, 1)."""
    if np.size(value) != 1:
        raise UnfitError(
            f"{np.size(value)} numbers of shape {np.shape(value)}; it must return one number"
        )
    return (np.reshape(value, ()),)


def vector(value, n: int) -> np.ndarray:
    """A value of n numbers, whether it came as (n,), (n, 1) or (1, n)."""
    if np.shape(value) not in ((n,), (n, 1), (1, n)):
        raise UnfitError(f"an array of shape {np.shape(value)}; it must return shape ({n},)")
    return np.reshape(value, n)


def array(value, *shape: int) -> np.ndarray:
    """A value of exactly this shape."""
    if np.shape(value) != shape:
        raise UnfitError(f"an array of shape {np.shape(value)}; it must return shape {shape}")
    return value
