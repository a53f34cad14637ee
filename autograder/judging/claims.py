"""What the sentence on a mistake says of an answer's numbers, and whether they bear it out."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum, auto
from functools import cached_property

import numpy as np

from autograder.judging.criterion import LEAST_SCALE, Criterion
from autograder.judging.stacked import Layout

# Before a sentence that says more than one part of the answer shows, and no other part bears out.
OF_A_PART = "Judging by this part alone: "
# So many mistakes are named of one criterion.
MOST_NAMED = 2
# A criterion of more numbers than these is taken as one.
MOST_NUMBERS = 12


class Claim(Enum):
    """Of which numbers a sentence speaks, all of which must bear it out.

    CHANGED: of those that the mistake changes, but for properties, as wrong answers may share them.
    JUDGED: of all that is judged, as no part shows the mistake: an entry of C does not show in C q̇.
    WHOLE: of the answer altogether, which has no other mistake, as "twice the right one" says.
    """

    CHANGED = auto()
    JUDGED = auto()
    WHOLE = auto()


@dataclass(frozen=True)
class Compared:
    """An answer beside the right one and all mistakes, criterion by criterion.

    right, given: a row of numbers for each criterion. wrong: for each, one row a mistake. claims: one a
    mistake.
    """

    criteria: tuple[Criterion, ...]
    layout: list[Layout]
    right: list[np.ndarray]
    given: list[np.ndarray]
    wrong: list[np.ndarray]
    claims: Sequence[Claim]

    @cached_property
    def changed(self) -> np.ndarray:
        """Where a mistake differs from the right answer: (mistakes, criteria)."""
        parts = zip(self.criteria, self.layout, self.right, self.wrong, strict=True)
        return np.transpose([~of.same(right, own, c.tolerance) for c, of, right, own in parts])

    @cached_property
    def shown(self) -> np.ndarray:
        """Where a mistake differs from the right answer as the given one does: (mistakes, criteria)."""
        parts = zip(self.criteria, self.layout, self.given, self.wrong, strict=True)
        same = [of.same(given, own, c.allows(met=False)) for c, of, given, own in parts]
        return self.changed & np.transpose(same)

    @cached_property
    def is_zero(self) -> bool:
        """Whether the answer is nothing but zeros, which many mistakes leave in places."""
        return not any(np.any(row) for row in self.given)

    @cached_property
    def of_truths(self) -> np.ndarray:
        """Which mistakes' errors the answer has all of, where numbers are counts or truths: (mistakes,).

        Of so few different numbers those of one criterion may be a mistake's by chance.
        """
        parts = zip(self.right, self.given, self.wrong, strict=True)
        return np.all(
            [np.all((own == right) | (own == given), axis=1) for right, given, own in parts], axis=0
        )

    def together(self, k: int, kept: Sequence[int], first: int, second: int) -> bool:
        """Whether two of those kept that explain criterion k show in no other as something else."""
        for other, of in enumerate(self.layout):
            criterion = self.criteria[other]
            if other == k or criterion.is_property or criterion.is_truth:
                continue
            right, wrong = self.right[other], self.wrong[other]
            sums = wrong[kept[first]] + wrong[kept[second]] - right
            if not of.same(right, sums, criterion.tolerance) and not of.same(
                self.given[other], sums, criterion.tolerance
            ):
                return False
        return True

    def of_single_numbers(self, k: int) -> list[int]:
        """Mistakes that explain some numbers of criterion k, where others are wrong for other reasons.

        All that such a mistake changes, anywhere, is its own in the answer. The one that explains most
        comes first, then what that one leaves; at most MOST_NAMED.
        """
        of_changes = np.array([claim is Claim.CHANGED for claim in self.claims], dtype=bool)
        judged = [j for j, c in enumerate(self.criteria) if not (c.is_property or c.is_truth)]
        if k not in judged or self.is_zero:
            return []
        parts = {j: self._by_number(j) for j in judged}
        found = of_changes
        for changed, same in parts.values():
            found = found & np.all(~changed | same, axis=1)
        size = np.sum([np.sum(changed, axis=1) for changed, _ in parts.values()], axis=0)
        left = parts[k][0].copy()
        named: list[int] = []
        while len(named) < MOST_NAMED and np.any(at := found & np.any(left, axis=1)):
            one = int(np.argmax(np.where(at, size, 0)))
            named.append(one)
            left &= ~parts[k][0][one]
        return named

    def _by_number(self, k: int) -> tuple[np.ndarray, np.ndarray]:
        """Of each number of criterion k, in all cases: which mistakes change it, and of which it is,
        both (mistakes, numbers).
        """
        of = self.layout[k]
        cases = [case for case, shape in enumerate(of.shapes) if np.prod(shape)]
        sizes = {of.sizes[case] - 1 for case in cases}
        if len(sizes) != 1 or max(sizes) > MOST_NUMBERS:
            return self.changed[:, [k]], self.shown[:, [k]]
        at = of.starts[cases][:, np.newaxis] + 1 + np.arange(*sizes)
        right, given, wrong = self.right[k][at], self.given[k][at], self.wrong[k][:, at]
        tolerance = self.criteria[k].tolerance

        def same(numbers: np.ndarray) -> np.ndarray:
            size = np.abs(numbers)
            scale = np.maximum(size, LEAST_SCALE * np.max(size, axis=0))
            scale = np.maximum(scale, of.floor)
            error = np.abs(wrong - numbers)
            return np.all(error <= tolerance * np.where(scale > 0, scale, 1.0), axis=1)

        return ~same(right), same(given)

    def borne_out(self, named: Sequence[int]) -> np.ndarray:
        """Which mistakes' sentences the numbers bear out: (mistakes,).

        Where a sentence speaks of a criterion, its numbers are the mistake's, or its own and those of
        one more that is named.
        """
        of_changes = np.array([claim is Claim.CHANGED for claim in self.claims], dtype=bool)
        found = np.ones(len(of_changes), dtype=bool)
        for k, criterion in enumerate(self.criteria):
            silent = of_changes & (criterion.is_property | ~self.changed[:, k])
            found &= silent | self._explained(k, named)
        return found

    def _explained(self, k: int, named: Sequence[int]) -> np.ndarray:
        """Whether the numbers of criterion k are a mistake's, alone or beside one more: (mistakes,)."""
        right, given, wrong = self.right[k], self.given[k], self.wrong[k]
        if self.criteria[k].is_truth:
            return np.all((wrong == right) | (wrong == given), axis=1)
        same = self.layout[k].same
        # Two mistakes at once need not add up as exactly as one is told from its like.
        tolerance = self.criteria[k].tolerance
        found = self.shown[:, k] | same(wrong, given, tolerance)
        for other in named:
            left = np.flatnonzero(~found & (np.arange(len(found)) != other))
            found[left] = same(wrong[left] + (wrong[other] - right), given, tolerance)
        return found
