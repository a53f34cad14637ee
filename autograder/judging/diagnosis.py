"""Finds the known mistake that wrong numbers show, or else what can be said of them.

A mistake is named only if the student's numbers equal its numbers to rounding in every random case,
or those of two mistakes at once. What its sentence claims beyond one criterion, the others must bear
out; else it is said of that part alone. If none matches, `findings` says what is true of the numbers.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Protocol

import numpy as np

from autograder.judging import findings
from autograder.judging.claims import OF_A_PART, Claim, Compared
from autograder.judging.criterion import Answered, Criterion
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
    sentence: says where to look, never the formula. claim: of which numbers it speaks. combines: whether
    it may be one of two mistakes. seldom: whether any other that explains as much is likelier.
    """

    name: str
    wrong: Model
    sentence: str
    claim: Claim = Claim.CHANGED
    combines: bool = True
    seldom: bool = False


class Catalogue(Protocol):
    """Mistakes that are made when they are needed: called, each with what it returns for each call, as
    one array (calls, …) or a list of them.
    """

    def mistakes(self) -> list[Mistake]: ...

    def __call__(self, calls: list[Call], /) -> Sequence[tuple[Mistake, Sequence | np.ndarray]]: ...


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
        """The first whose numbers are those given, in all criteria but those of closed loops."""
        left = np.arange(len(self.mistakes))
        for k, criterion in enumerate(criteria):
            if criterion.in_loop:
                continue
            same = layout[k].same(self.rows[k][left], given[k], criterion.allows(met[k]))
            left = left[same]
        return self.mistakes[left[0]] if len(left) else None


def sentences(
    criteria: tuple[Criterion, ...],
    expected: Numbers,
    given: Numbers,
    met: list[bool],
    wrong: Wrong,
    terms: Callable[[], list[tuple[Term, Numbers]]],
    unsteady: Callable[[int], str],
    elsewhere: Callable[[int], str],
    on_top: Callable[[], list[tuple[str, ...]]],
) -> list[tuple[str, ...]]:
    """What to say of each criterion, where no mistake explains the whole answer: () of those met.

    terms, unsteady, elsewhere: asked only where no mistake matches. unsteady: what to say of criterion k
    where the same calls give other numbers. elsewhere: what more can be found out of it. Both give ""
    for nothing, and may cost calls. on_top: what to say of all criteria, where two mistakes are on top
    of each other, and not side by side; [] for nothing.
    """
    layout = layouts(given, expected)
    compared = Compared(
        criteria, layout, rows(layout, expected), rows(layout, given), wrong.rows,
        [mistake.claim for mistake in wrong.mistakes],
    )  # fmt: skip
    shown, true = _named(compared, expected, given, met, wrong.mistakes)
    if any(
        not (met[k] or shown[k] or criterion.is_property) for k, criterion in enumerate(criteria)
    ) and (both := on_top()):
        return both
    said: list[str] = []
    of_each: list[tuple[str, ...]] = [()] * len(criteria)
    for k, criterion in enumerate(criteria):
        accounted = any(own and not c.in_loop for own, c in zip(of_each, criteria, strict=True))
        if met[k] or (criterion.in_loop and accounted):
            continue
        before = len(said)
        named = [(wrong.mistakes[i].sentence, true[i]) for i in shown[k]]
        said += [sentence if as_it_is else OF_A_PART + sentence for sentence, as_it_is in named]
        if not shown[k]:
            if found := unsteady(k):
                said.append(found)
                of_each[k] = (found,)
                continue
            some = [wrong.mistakes[i].sentence for i in compared.of_single_numbers(k)]
            right, theirs = _part(k, expected), _part(k, given)
            parts = [(term, _part(k, numbers)) for term, numbers in terms()]
            found = findings.of_numbers(criterion, right, theirs, parts)
            if not some:
                found = found or criterion.unmet(Answered(expected, given, met)) or elsewhere(k)
            said += [*some, found]
        of_each[k] = tuple(dict.fromkeys(filter(None, said[before:])))
    return of_each


def _named(
    compared: Compared, expected: Numbers, given: Numbers, met: list[bool], mistakes: list[Mistake]
) -> tuple[list[tuple[int, ...]], np.ndarray]:
    """The places of the mistakes that each criterion shows; and whose sentences are true as they stand.

    Those that the whole answer bears out come first. Where it bears none out, one may be named that a
    part shows, but for those that claim properties, which no part shows.
    """
    order, spoils = _likeliest_first(compared, met, mistakes)
    likely = [i for i in order if mistakes[i].claim is not Claim.WHOLE]
    doubted: set[int] = set()
    while True:
        kept = [i for i in likely if i not in doubted]
        kept += [i for i in likely if i in doubted and mistakes[i].claim is Claim.CHANGED]
        shown = _of_each(compared, expected, given, met, mistakes, kept, spoils)
        named = sorted({i for found in shown for i in found})
        true = compared.borne_out(named) if named else np.zeros(len(mistakes), dtype=bool)
        if doubted.issuperset(i for i in named if not true[i]):
            return shown, true
        doubted.update(np.flatnonzero(~true).tolist())


def _of_each(
    compared: Compared, expected: Numbers, given: Numbers, met: list[bool], mistakes: list[Mistake],
    likely: list[int], spoils: np.ndarray,
) -> list[tuple[int, ...]]:  # fmt: skip
    """The places of the mistakes that each criterion shows: one, two or none."""
    # One of these by itself would have explained the whole answer.
    of_all = np.array([mistake.claim is Claim.JUDGED for mistake in mistakes], dtype=bool)
    found: list[tuple[int, ...]] = []
    for k, criterion in enumerate(compared.criteria):
        if met[k]:
            found.append(())
            continue
        before = {mistakes[i].sentence for shown in found for i in shown}
        if criterion.is_property:
            kept = [i for i in likely if mistakes[i].sentence in before]
        else:  # one that is said already is likelier than the same in this criterion alone
            kept = sorted(likely, key=lambda i: mistakes[i].sentence not in before)
        if criterion.is_truth:
            kept = [i for i in kept if compared.of_truths[i]]
        # Two mistakes may cancel each other in what is right; one alone cannot.
        shown = _shown(
            compared.layout[k], compared.right[k], compared.given[k], [mistakes[i] for i in kept],
            compared.wrong[k][kept], (criterion.is_truth | ~spoils[kept]) & ~of_all[kept],
            partial(compared.together, k, kept), criterion.allows(False),
        )  # fmt: skip
        # Numbers that never change say nothing of terms: two mistakes fit them by taking all away.
        # And nothing but zeros shows a mistake only where this explains the whole answer.
        right, theirs = _part(k, expected), _part(k, given)
        same = _is_one_number(theirs) or not any(map(np.any, theirs))
        if (len(shown) > 1 and same and not _is_one_number(right)) or (
            compared.is_zero and not criterion.is_truth
        ):
            shown = ()
        found.append(tuple(kept[i] for i in shown))
    return found


def _is_one_number(values: list[np.ndarray]) -> bool:
    """Whether each case has the same, which is not 0."""
    first = values[0]
    return bool(np.any(first)) and all(np.array_equal(first, other) for other in values[1:])


def _likeliest_first(
    compared: Compared, met: list[bool], mistakes: list[Mistake]
) -> tuple[np.ndarray, np.ndarray]:
    """The places of the mistakes, those last that are less likely where several explain a criterion; and
    which mistakes spoil what is right in the answer.

    Less likely is one that spoils what is right in the answer; that explains fewer criteria; that shows
    in others what the answer does not; that is seldom.
    """
    changed, shown = compared.changed, compared.shown
    spoils = np.any(changed & met, axis=1)
    explained, unseen = np.sum(shown, axis=1), np.sum(changed & ~shown, axis=1)
    seldom = np.array([mistake.seldom for mistake in mistakes], dtype=bool)
    return np.lexsort((seldom, unseen, -explained, spoils)), spoils


def _shown(
    layout: Layout,
    expected: np.ndarray,
    given: np.ndarray,
    mistakes: list[Mistake],
    wrong: np.ndarray,
    alone: np.ndarray,
    together: Callable[[int, int], bool],
    tolerance: float,
) -> tuple[int, ...]:
    """The places of one or two. alone: which may be the only one. together: which two may be both."""
    if not mistakes:
        return ()
    off = ~layout.same(expected, wrong, tolerance)
    if (one := np.flatnonzero(off & alone & layout.same(wrong, given, tolerance))).size:
        return (int(one[0]),)
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
                return int(places[i[at]]), int(places[j[at]])
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
