"""Finds the known mistake that wrong numbers show, or the term in which they are wrong.

A mistake is named only if the student's numbers equal its numbers to rounding in every random case,
or those of two mistakes at once. If none matches, the error is projected on the known terms.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

# An answer is right to rounding. Single precision through a few operations leaves 4e-6 of the scale
# below; a wrong formula shows at 1e-4 or more.
TOLERANCE = 1e-5
# A case counts at no less than this share of the largest one, so that a value near zero, where
# single precision has no digits left, is not judged by itself.
LEAST_SCALE = 0.05
# An error with more than this share along the known terms is said to be in them.
MOSTLY = 0.95
# A term with less than this share of the error is not named.
NOTABLE = 0.05


@dataclass(frozen=True)
class Mistake:
    """A physics mistake that people make: a wrong model, and the sentence that names it.

    wrong: takes the arguments of the student's function and gives what the mistaken one returns.
    sentence: says where to look, never the formula.
    """

    name: str
    wrong: Callable
    sentence: str


@dataclass(frozen=True)
class Term:
    """A part of the right answer, in words: "the coupling of the two links".

    model: takes the arguments of the student's function and gives this part of what it returns.
    """

    name: str
    model: Callable


@dataclass(frozen=True)
class Known:
    """A mistake's or a term's numbers: one array a case, for one criterion."""

    of: Mistake | Term
    values: list[np.ndarray]


def relative_errors(expected: list, given: list) -> np.ndarray:
    """The largest error of each case over the scale of its expected value."""
    size = _largest(expected)
    scale = np.maximum(size, LEAST_SCALE * np.max(size))
    error = _largest([g - e for e, g in zip(expected, given, strict=True)])
    return error / np.where(scale > 0, scale, 1.0)


def mistakes_shown(
    expected: list, given: list, mistakes: list[Known], tolerance: float = TOLERANCE
) -> tuple[Mistake, ...]:
    """The first mistake whose numbers these are; or the first two whose errors add up to theirs."""

    def same(wrong, right):
        return bool(np.all(relative_errors(wrong, right) <= tolerance))

    wrong = [known for known in mistakes if not same(expected, known.values)]
    for known in wrong:
        if same(known.values, given):
            return (known.of,)
    if not wrong:
        return ()
    flat = np.array([_flat(known.values) for known in wrong])
    right, answer = _flat(expected), _flat(given)
    # All pairs in one array first, as there may be hundreds.
    both = flat[:, None] + flat[None] - right
    near = np.max(np.abs(both - answer), axis=2) <= tolerance * np.max(np.abs(both), axis=2)
    for i, j in np.argwhere(np.triu(near, 1)):
        first, second = wrong[i], wrong[j]
        sums = [x + y - e for x, y, e in zip(first.values, second.values, expected, strict=True)]
        # One error twice is not two mistakes.
        apart = not same(sums, expected) and not same(first.values, second.values)
        if apart and same(sums, given):
            return (first.of, second.of)
    return ()


def terms_off(expected: list, given: list, terms: list[Known]) -> list[tuple[Term, float, float]]:
    """The terms in which an error sits: each with its share of the error, and the error's size as a
    multiple of the term (−1: the term is missing). Empty where the terms do not explain it.
    """
    error = _flat(given) - _flat(expected)
    present = [known for known in terms if np.any(_flat(known.values))]
    if not present or not np.any(error):
        return []
    columns = np.array([_flat(known.values) for known in present]).T
    sizes = np.linalg.norm(columns, axis=0)
    factors, *_ = np.linalg.lstsq(columns / sizes, error, rcond=1e-9)
    if np.linalg.norm(error - columns / sizes @ factors) > (1 - MOSTLY) * np.linalg.norm(error):
        return []
    shares = factors**2 / np.sum(factors**2)
    found = [
        (known.of, float(share), float(factor / size))
        for known, share, factor, size in zip(present, shares, factors, sizes, strict=True)
        if share > NOTABLE
    ]
    return sorted(found, key=lambda one: -one[1])


def _largest(values: list) -> np.ndarray:
    """The largest entry of each; one array of all where they have one shape, as that is faster."""
    if len({np.shape(value) for value in values}) == 1:
        return np.max(np.abs(np.reshape(values, (len(values), -1))), axis=1, initial=0.0)
    return np.array([np.max(np.abs(value), initial=0.0) for value in values])


def _flat(values: list) -> np.ndarray:
    return np.concatenate([np.ravel(value) for value in values])
