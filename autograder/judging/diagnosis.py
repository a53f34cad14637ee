"""Finds the known mistake that wrong numbers show, or the term in which they are wrong.

A mistake is named only if the student's numbers equal its numbers to rounding in every random case,
or those of two mistakes at once. If none matches, the error is projected on the known terms.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

from autograder.judging.criterion import TOLERANCE, Criterion, relative_errors
from autograder.judging.quantities import Numbers

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


Named = TypeVar("Named", Mistake, Term)


@dataclass(frozen=True)
class Known(Generic[Named]):
    """A mistake's or a term's numbers: one array a case, for one criterion."""

    of: Named
    values: list[np.ndarray]


def explains_all(
    criteria: tuple[Criterion, ...], wrong: Numbers, given: Numbers, met: list[bool]
) -> bool:
    """Whether a mistake's numbers are those given; it is asked no further than where they differ."""
    return all(
        np.all(_errors_in(k, wrong, given) <= criterion.allows(met[k]))
        for k, criterion in enumerate(criteria)
    )


def sentences(
    criteria: tuple[Criterion, ...],
    expected: Numbers,
    given: Numbers,
    met: list[bool],
    mistakes: list[tuple[Mistake, Numbers]],
    terms: list[tuple[Term, Numbers]],
) -> tuple[str, ...]:
    """What to say of each criterion that is not met, where no mistake explains the whole answer."""
    said: list[str] = []
    for k, criterion in enumerate(criteria):
        if met[k]:
            continue
        right, theirs = _part(k, expected), _part(k, given)
        wrong = [Known(mistake, _part(k, numbers)) for mistake, numbers in mistakes
                 if mistake.sentence in said or not criterion.is_property]  # fmt: skip
        shown = mistakes_shown(right, theirs, wrong, criterion.allows(met=False))
        said += [mistake.sentence for mistake in shown]
        if not shown:
            parts = [Known(term, _part(k, numbers)) for term, numbers in terms
                     if not criterion.is_property]  # fmt: skip
            off = terms_off(right, theirs, parts)
            said += [_where(criterion, off)] if off else [criterion.otherwise]
    return tuple(dict.fromkeys(filter(None, said)))


def mistakes_shown(
    expected: list, given: list, mistakes: list[Known[Mistake]], tolerance: float = TOLERANCE
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


def terms_off(
    expected: list, given: list, terms: list[Known[Term]]
) -> list[tuple[Term, float, float]]:
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


def _where(criterion: Criterion, off: list[tuple[Term, float, float]]) -> str:
    """No known mistake, but the error is made of known terms: their names, and by how much."""
    said = ", plus ".join(f"{factor:.2g} times {term.name}" for term, _, factor in off)
    return f"The error in your {criterion.text} is about {said}."


def _part(k: int, numbers: Numbers) -> list[np.ndarray]:
    """The numbers of one criterion, case by case."""
    return [case[k] for case in numbers]


def _errors_in(k: int, expected: Numbers, given: Numbers) -> np.ndarray:
    return relative_errors(_part(k, expected), _part(k, given))


def _flat(values: list) -> np.ndarray:
    return np.concatenate([np.ravel(value) for value in values])
