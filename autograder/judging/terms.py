"""Tells of which known terms an error is made, where it is made of nothing else."""

import itertools
from dataclasses import dataclass

import numpy as np

from autograder.judging.criterion import TOLERANCE, relative_errors
from autograder.judging.models import Model
from autograder.judging.percent import percent

# An error that takes more terms than these says less than the worst case does.
MOST = 3
# So many numbers more than terms, and a fit is no coincidence.
SURPLUS = 3
# Of an error that is itself nearly rounding, this share may be left.
NEARLY_ALL = 0.05


@dataclass(frozen=True)
class Term:
    """A part of the right answer, in words: "the coupling of the two links".

    model: takes the arguments of the student's function and gives this part of what it returns.
    """

    name: str
    model: Model


def terms_off(
    expected: list, given: list, terms: list[tuple[Term, list]], tolerance: float = TOLERANCE
) -> list[tuple[Term, float]]:
    """The fewest terms that make the whole error, each with how often the answer holds it.

    The right answer holds each once; 0 times: the term is missing, −1: its sign is wrong. expected,
    given and the terms' numbers: one array a case. Empty where no MOST terms give the error to within
    the tolerance.
    """
    error = _flat(given) - _flat(expected)
    present = [(term, _flat(numbers)) for term, numbers in terms]
    present = [(term, column) for term, column in present if np.any(column)]
    if not np.any(error):
        return []
    for count in range(1, min(MOST, len(present)) + 1):
        if len(error) < count + SURPLUS:
            break
        every = list(itertools.combinations(range(len(present)), count))
        # All at once: (combinations, numbers, count).
        columns = np.stack([of for _, of in present])[np.array(every)].swapaxes(-1, -2)
        factors = np.linalg.pinv(columns) @ error
        fits = np.squeeze(columns @ factors[..., np.newaxis], -1)
        left = np.linalg.norm(error - fits, axis=-1)
        for k in np.flatnonzero(left <= NEARLY_ALL * np.linalg.norm(error)):
            if _is(fits[k], expected, given, tolerance):
                chosen = [present[place][0] for place in every[k]]
                return [(term, 1 + float(f)) for term, f in zip(chosen, factors[k], strict=True)]
    return []


def in_words(term: Term, times: float) -> str:
    """What the answer does with a term that it should hold once: "the weight of link 1 is missing"."""
    close = {0: "is missing", -1: "has the wrong sign", 2: "is counted twice",
             0.5: "is half of what it should be"}  # fmt: skip
    for value, words in close.items():
        if abs(times - value) < 1e-4:
            return f"{term.name} {words}"
    if times < 0:
        return f"{term.name} has the wrong sign and is {-times:.3g} times as large as it should be"
    if times > 2 or times < 0.5:
        return f"{term.name} is {times:.3g} times as large as it should be"
    return f"{term.name} comes out {percent_off(times)}"


def percent_off(times: float) -> str:
    """A factor near 1 as "10 % too large"."""
    return f"{percent(times - 1)} too {'large' if times > 1 else 'small'}"


def _is(fit, expected, given, tolerance) -> bool:
    """Whether the right numbers and this error are those given, case by case."""
    ends = np.cumsum([np.size(value) for value in expected])[:-1]
    parts = np.split(fit, ends)
    fitted = [e + np.reshape(p, np.shape(e)) for e, p in zip(expected, parts, strict=True)]
    return bool(np.all(relative_errors(given, fitted) <= tolerance))


def _flat(values: list) -> np.ndarray:
    return np.concatenate([np.ravel(value) for value in values])
