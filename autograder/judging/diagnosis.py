"""Finds the known mistake that wrong numbers show, or else what can be said of them.

A mistake is named only if the student's numbers equal its numbers to rounding in every random case,
or those of two mistakes at once. If none matches, `findings` says what is true of the numbers.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from autograder.judging import findings
from autograder.judging.criterion import TOLERANCE, Criterion, relative_errors
from autograder.judging.quantities import Numbers
from autograder.judging.terms import Term


@dataclass(frozen=True)
class Mistake:
    """A physics mistake that people make: a wrong model, and the sentence that names it.

    wrong: takes the arguments of the student's function and gives what the mistaken one returns.
    sentence: says where to look, never the formula. whole: it is said only of an answer that it explains
    altogether, as "twice the right one" is. combines: whether it may be one of two mistakes.
    """

    name: str
    wrong: Callable
    sentence: str
    whole: bool = False
    combines: bool = True


@dataclass(frozen=True)
class Known:
    """A mistake's numbers: one array a case, for one criterion."""

    of: Mistake
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
    terms: Callable[[], list[tuple[Term, Numbers]]],
    elsewhere: Callable[[int], str],
) -> tuple[str, ...]:
    """What to say of each criterion that is not met, where no mistake explains the whole answer.

    terms, elsewhere: asked only where no mistake matches. elsewhere: what more can be found out of
    criterion k, "" for nothing; it may cost calls.
    """
    said: list[str] = []
    mistakes = sorted(mistakes, key=lambda one: not _leaves_right(criteria, expected, one[1], met))
    for k, criterion in enumerate(criteria):
        if met[k]:
            continue
        right, theirs = _part(k, expected), _part(k, given)
        wrong = [Known(mistake, _part(k, numbers)) for mistake, numbers in mistakes
                 if not mistake.whole
                 and (mistake.sentence in said or not criterion.is_property)]  # fmt: skip
        shown = mistakes_shown(right, theirs, wrong, criterion.allows(met=False))
        said += [mistake.sentence for mistake in shown]
        if not shown:
            parts = [(term, _part(k, numbers)) for term, numbers in terms()]
            found = findings.of_numbers(criterion, right, theirs, parts) or criterion.otherwise
            said.append(found or ("" if any(said) else elsewhere(k)))
    return tuple(dict.fromkeys(filter(None, said)))


def _leaves_right(
    criteria: tuple[Criterion, ...], expected: Numbers, wrong: Numbers, met: list[bool]
) -> bool:
    """Whether a mistake spoils nothing that is right in the answer: it then says more of it."""
    return all(
        np.all(_errors_in(k, expected, wrong) <= criterion.tolerance)
        for k, criterion in enumerate(criteria)
        if met[k]
    )


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
    wrong = [known for known in wrong if known.of.combines]
    if not wrong:
        return ()
    flat = np.array([_flat(known.values) for known in wrong])
    slack = tolerance * float(np.max(np.abs(_flat(given)), initial=0.0))
    for i, j in _nearly_adding_up(flat - _flat(expected), _flat(given) - _flat(expected), slack):
        first, second = wrong[i], wrong[j]
        sums = [x + y - e for x, y, e in zip(first.values, second.values, expected, strict=True)]
        # One error twice is not two mistakes.
        apart = not same(sums, expected) and not same(first.values, second.values)
        if apart and same(sums, given):
            return (first.of, second.of)
    return ()


def _nearly_adding_up(errors: np.ndarray, error: np.ndarray, slack: float) -> list[tuple[int, int]]:
    """The pairs i < j whose errors may add up to this one to within `slack`, in the order of i.

    There may be a hundred thousand pairs. So the errors are compared as one number each, a sum with
    fixed weights, in which a pair that adds up does so too.
    """
    weights = np.random.default_rng(0).uniform(0.5, 1.0, len(error))
    numbers, wanted = errors @ weights, float(error @ weights)
    order = np.argsort(numbers)
    slack = 10 * slack * np.sum(weights)
    low = np.searchsorted(numbers[order], wanted - numbers - slack)
    high = np.searchsorted(numbers[order], wanted - numbers + slack)
    return [
        (i, int(j)) for i in range(len(errors)) for j in sorted(order[low[i] : high[i]]) if j > i
    ]


def _part(k: int, numbers: Numbers) -> list[np.ndarray]:
    """The numbers of one criterion, case by case."""
    return [case[k] for case in numbers]


def _errors_in(k: int, expected: Numbers, given: Numbers) -> np.ndarray:
    return relative_errors(_part(k, expected), _part(k, given))


def _flat(values: list) -> np.ndarray:
    return np.concatenate([np.ravel(value) for value in values])
