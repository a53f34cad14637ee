"""Finds the known mistake that wrong numbers show, or else what can be said of them.

A mistake is named only if the student's numbers equal its numbers to rounding in every random case,
or those of two mistakes at once. If none matches, `findings` says what is true of the numbers.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from autograder.judging import findings
from autograder.judging.criterion import TOLERANCE, Answered, Criterion
from autograder.judging.models import Model
from autograder.judging.quantities import Numbers
from autograder.judging.stacked import Layout, layouts, rows
from autograder.judging.terms import Term
from autograder.protocol import Call

# By so many sums the errors of two mistakes are compared before they are compared number by number.
PROJECTIONS = 4
# So many pairs are compared at once, for memory's sake.
AT_ONCE = 1024


@dataclass(frozen=True)
class Mistake:
    """A physics mistake that people make: a wrong model, and the sentence that names it.

    wrong: takes the arguments of the student's function and gives what the mistaken one returns.
    sentence: says where to look, never the formula. whole: it is said only of an answer that it explains
    altogether, as "twice the right one" is. combines: whether it may be one of two mistakes. of_all:
    whether it is said only where it explains all that is judged, alone or together with another one.
    seldom: whether any other that explains as much is likelier.
    """

    name: str
    wrong: Model
    sentence: str
    whole: bool = False
    combines: bool = True
    of_all: bool = False
    seldom: bool = False


class Catalogue(Protocol):
    """Mistakes that are made when they are needed: called, each with what it returns for each call, as
    one array (calls, …) or a list of them.
    """

    def mistakes(self) -> list[Mistake]: ...

    def __call__(self, calls: list[Call], /) -> Sequence[tuple[Mistake, Sequence | np.ndarray]]: ...


@dataclass(frozen=True)
class Known:
    """A mistake's numbers: one array a case, for one criterion."""

    of: Mistake
    values: list[np.ndarray]


@dataclass(frozen=True)
class Wrong:
    """All mistakes of a check with their numbers: for each criterion one row a mistake."""

    mistakes: list[Mistake]
    rows: list[np.ndarray]

    def explaining(
        self,
        criteria: tuple[Criterion, ...],
        layout: list[Layout],
        given: list[np.ndarray],
        met: list[bool],
    ) -> Mistake | None:
        """The first whose numbers are those given, in all criteria."""
        left = np.arange(len(self.mistakes))
        for k, criterion in enumerate(criteria):
            same = layout[k].same(self.rows[k][left], given[k], criterion.allows(met[k]))
            left = left[same]
        return self.mistakes[left[0]] if len(left) else None

    def add_up(
        self,
        shown: tuple[Mistake, ...],
        criteria: tuple[Criterion, ...],
        expected: Numbers,
        given: Numbers,
    ) -> bool:
        """Whether the errors of these mistakes add up to those given, in all criteria."""
        places = [next(i for i, m in enumerate(self.mistakes) if m is one) for one in shown]
        layout = layouts(given, expected)
        right, theirs = rows(layout, expected), rows(layout, given)
        for k, criterion in enumerate(criteria):
            total = right[k] + np.sum(self.rows[k][places] - right[k], axis=0)
            if not layout[k].same(total, theirs[k], criterion.allows(met=False)):
                return False
        return True


def sentences(
    criteria: tuple[Criterion, ...],
    expected: Numbers,
    given: Numbers,
    met: list[bool],
    wrong: Wrong,
    terms: Callable[[], list[tuple[Term, Numbers]]],
    unsteady: Callable[[int], str],
    elsewhere: Callable[[int], str],
) -> list[tuple[str, ...]]:
    """What to say of each criterion, where no mistake explains the whole answer: () of those met.

    terms, unsteady, elsewhere: asked only where no mistake matches. unsteady: what to say of criterion k
    where the same calls give other numbers. elsewhere: what more can be found out of it. Both give ""
    for nothing, and may cost calls.
    """
    said: list[str] = []
    of_each: list[tuple[str, ...]] = [()] * len(criteria)
    layout = layouts(given, expected)
    expected_rows, given_rows = rows(layout, expected), rows(layout, given)
    order, spoils = _likeliest_first(criteria, layout, expected_rows, given_rows, met, wrong)
    likely = [i for i in order if not wrong.mistakes[i].whole]
    borne_out = _borne_out(expected_rows, given_rows, wrong)
    # One of these by itself would have explained the whole answer.
    of_all = np.array([mistake.of_all for mistake in wrong.mistakes], dtype=bool)
    nothing = not any(np.any(part) for case in given for part in case)

    def together(k: int, first: int, second: int) -> bool:
        """Whether two mistakes that explain criterion k together show in no other as something else, and
        add up to the whole answer where one of them is said of that alone.
        """
        both = (wrong.mistakes[first], wrong.mistakes[second])
        if any(m.of_all for m in both) and not wrong.add_up(both, criteria, expected, given):
            return False
        for other, of in enumerate(layout):
            if other == k or criteria[other].is_property or criteria[other].is_truth:
                continue
            right = expected_rows[other]
            sums = wrong.rows[other][first] + wrong.rows[other][second] - right
            tolerance = criteria[other].tolerance
            if not (of.same(right, sums, tolerance) or of.same(given_rows[other], sums, tolerance)):
                return False
        return True

    for k, criterion in enumerate(criteria):
        if met[k]:
            continue
        before = len(said)
        right, theirs = _part(k, expected), _part(k, given)
        # One that is said already is likelier than the same in this criterion alone.
        kept = sorted(likely, key=lambda i: wrong.mistakes[i].sentence not in said)
        if criterion.is_property:
            kept = [i for i in likely if wrong.mistakes[i].sentence in said]
        if criterion.is_truth:
            kept = [i for i in kept if borne_out[i]]
        row = layout[k].row

        def shown_by(kept: list[int], k: int = k, row=row, right=right, theirs=theirs):
            # Two mistakes may cancel each other in what is right; one alone cannot.
            return _shown(
                layout[k], row(right), row(theirs), [wrong.mistakes[i] for i in kept],
                wrong.rows[k][kept], (criteria[k].is_truth | ~spoils[kept]) & ~of_all[kept],
                lambda i, j: together(k, kept[i], kept[j]), criteria[k].allows(False),
            )  # fmt: skip

        shown = shown_by(kept)
        # Numbers that never change say nothing of terms: two mistakes fit them by taking all away.
        # And nothing but zeros shows a mistake only where this explains the whole answer.
        same = _is_one_number(theirs) or not any(map(np.any, theirs))
        if (len(shown) > 1 and same and not _is_one_number(right)) or (
            nothing and not criterion.is_truth
        ):
            shown = ()
        said += [mistake.sentence for mistake in shown]
        if not shown:
            if found := unsteady(k):
                said.append(found)
                of_each[k] = (found,)
                continue
            parts = [(term, _part(k, numbers)) for term, numbers in terms()]
            found = findings.of_numbers(criterion, right, theirs, parts)
            found = found or criterion.unmet(Answered(expected, given, met))
            said.append(found or elsewhere(k))
        of_each[k] = tuple(dict.fromkeys(filter(None, said[before:])))
    return of_each


def _is_one_number(values: list[np.ndarray]) -> bool:
    """Whether each case has the same, which is not 0."""
    first = values[0]
    return bool(np.any(first)) and all(np.array_equal(first, other) for other in values[1:])


def _likeliest_first(
    criteria: tuple[Criterion, ...],
    layout: list[Layout],
    expected: list[np.ndarray],
    given: list[np.ndarray],
    met: list[bool],
    wrong: Wrong,
) -> tuple[np.ndarray, np.ndarray]:
    """The places of the mistakes, those last that are less likely where several explain a criterion; and
    which mistakes spoil what is right in the answer.

    Less likely is one that spoils what is right in the answer; that explains fewer criteria; that shows
    in others what the answer does not; that is seldom.
    """
    spoils, same, unseen = np.zeros((3, len(wrong.mistakes)), dtype=int)
    for k, criterion in enumerate(criteria):
        right = layout[k].same(expected[k], wrong.rows[k], criterion.tolerance)
        shows = ~right & layout[k].same(given[k], wrong.rows[k], criterion.allows(met=False))
        spoils |= met[k] & ~right
        same += shows
        unseen += ~(right | shows)
    seldom = np.array([mistake.seldom for mistake in wrong.mistakes], dtype=bool)
    return np.lexsort((seldom, unseen, -same, spoils)), spoils > 0


def _borne_out(expected: list[np.ndarray], given: list[np.ndarray], wrong: Wrong) -> np.ndarray:
    """Which mistakes' errors the answer has all of, where numbers are counts or truths.

    Of so few different numbers those of one criterion may be a mistake's by chance.
    """
    found = np.ones(len(wrong.mistakes), dtype=bool)
    for right, theirs, own in zip(expected, given, wrong.rows, strict=True):
        found &= np.all((own == right) | (own == theirs), axis=1)
    return found


def mistakes_shown(
    expected: list, given: list, mistakes: list[Known], tolerance: float = TOLERANCE
) -> tuple[Mistake, ...]:
    """The first mistake whose numbers these are; or the first two whose errors add up to theirs."""
    layout = Layout.of(given, expected)
    wrong = np.array([layout.row(known.values) for known in mistakes])
    known = [one.of for one in mistakes]
    every = np.ones(len(known), dtype=bool)
    return _shown(
        layout, layout.row(expected), layout.row(given), known, wrong, every,
        lambda first, second: True, tolerance,
    )  # fmt: skip


def _shown(
    layout: Layout,
    expected: np.ndarray,
    given: np.ndarray,
    mistakes: list[Mistake],
    wrong: np.ndarray,
    alone: np.ndarray,
    together: Callable[[int, int], bool],
    tolerance: float,
) -> tuple[Mistake, ...]:
    """alone: which of them may be the only one. together: which two of them may be both."""
    if not mistakes:
        return ()
    off = ~layout.same(expected, wrong, tolerance)
    if (one := np.flatnonzero(off & alone & layout.same(wrong, given, tolerance))).size:
        return (mistakes[one[0]],)
    combines = np.array([mistake.combines for mistake in mistakes])
    places = np.flatnonzero(off & combines & np.all(np.isfinite(wrong), axis=1))
    errors = wrong[places] - expected
    first, second = _nearly_adding_up(errors, given - expected, np.abs(given), tolerance)
    for start in range(0, len(first), AT_ONCE):
        i, j = first[start : start + AT_ONCE], second[start : start + AT_ONCE]
        sums = expected + errors[i] + errors[j]
        # One error twice is not two mistakes.
        found = (
            layout.same(sums, given, tolerance)
            & ~layout.same(sums, expected, tolerance)
            & ~layout.same(wrong[places[i]], wrong[places[j]], tolerance)
        )
        for at in np.flatnonzero(found):
            if together(places[i[at]], places[j[at]]):
                return mistakes[places[i[at]]], mistakes[places[j[at]]]
    return ()


def _nearly_adding_up(
    errors: np.ndarray, error: np.ndarray, size: np.ndarray, tolerance: float
) -> tuple[np.ndarray, np.ndarray]:
    """The pairs i < j whose errors may add up to this one, in the order of i. size: of the answer.

    There may be millions of pairs. So the errors are compared as a few numbers each, sums with fixed
    weights, in which a pair that adds up does so too.
    """
    weights = np.random.default_rng(0).uniform(-1.0, 1.0, (PROJECTIONS, len(error)))
    numbers, wanted = errors @ weights.T, weights @ error
    # A pair adds up to the tolerance of the answer's size, and to rounding of its own.
    largest = np.max(np.abs(errors), initial=0.0)
    least = 3 * tolerance * np.max(size, initial=0.0) + 1e-13 * largest
    slack = least * np.sum(np.abs(weights), axis=1)
    order = np.argsort(numbers[:, 0])
    of_order = numbers[order, 0]
    low = np.searchsorted(of_order, wanted[0] - numbers[:, 0] - slack[0])
    high = np.searchsorted(of_order, wanted[0] - numbers[:, 0] + slack[0])
    count = high - low
    first = np.repeat(np.arange(len(errors)), count)
    within = np.arange(len(first)) - np.repeat(np.cumsum(count) - count, count)
    second = order[np.repeat(low, count) + within]
    kept = first < second
    first, second = first[kept], second[kept]
    for k in range(1, PROJECTIONS):
        near = np.abs(numbers[first, k] + numbers[second, k] - wanted[k]) <= slack[k]
        first, second = first[near], second[near]
    sort = np.lexsort((second, first))
    return first[sort], second[sort]


def _part(k: int, numbers: Numbers) -> list[np.ndarray]:
    """The numbers of one criterion, case by case."""
    return [case[k] for case in numbers]
