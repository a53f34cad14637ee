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
# Before what is wrong beside a factor of the whole, of which the sentence before speaks.
ON_TOP = "With that mended, this is left: "
# So many mistakes are named of one criterion.
MOST_NAMED = 2
# A criterion of more numbers than these is taken as one.
MOST_NUMBERS = 12


def as_written(sentence: str) -> str:
    """A sentence of a mistake without what a card says before it."""
    return sentence.removeprefix(OF_A_PART).removeprefix(ON_TOP)


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
        """Whether two of those kept that explain criterion k together show in no other as something
        else.

        Properties count where one of the two speaks of all that is judged: two entries of C may add
        up to the C q̇ of another C.
        """
        of_all = any(self.claims[kept[i]] is Claim.JUDGED for i in (first, second))
        for other, of in enumerate(self.layout):
            criterion = self.criteria[other]
            if other == k or criterion.is_truth or (criterion.is_property and not of_all):
                continue
            right, wrong = self.right[other], self.wrong[other]
            sums = wrong[kept[first]] + wrong[kept[second]] - right
            if not of.same(right, sums, criterion.tolerance) and not of.same(
                self.given[other], sums, criterion.tolerance
            ):
                return False
        return True

    def borne_out(self, named: Sequence[int]) -> np.ndarray:
        """Which mistakes' sentences the numbers bear out: (mistakes,).

        Where a sentence speaks of numbers, they are the mistake's, or its own and those of one more that
        is named.
        """
        found = np.ones(len(self.claims), dtype=bool)
        for k, criterion in enumerate(self.criteria):
            silent = self._of_changes & (criterion.is_property | ~self.changed[:, k])
            asked = np.flatnonzero(found & ~silent)
            found[asked] = self._explained(k, asked, named)
        return found

    def of_single_numbers(self, k: int) -> list[int]:
        """Mistakes that explain some numbers of criterion k, where others are wrong for other reasons.

        The one that changes most numbers comes first, then what that one leaves; at most MOST_NAMED.
        """
        if k not in self._changed_numbers or self.is_zero:
            return []
        changed, left = self._changed_numbers[k], self._changed_numbers[k].copy()
        named: list[int] = []
        while len(named) < MOST_NAMED and np.any(at := self._by_itself & np.any(left, axis=1)):
            named.append(int(np.argmax(np.where(at, self._reach, 0))))
            left &= ~changed[named[-1]]
        return named

    @cached_property
    def _by_itself(self) -> np.ndarray:
        """Which mistakes an answer has all of, whatever else is wrong in other numbers: (mistakes,)."""
        return self._of_changes & self.borne_out([])

    @cached_property
    def _changed_numbers(self) -> dict[int, np.ndarray]:
        """(mistakes, numbers) of each criterion of numbers."""
        return {
            k: ~self._same_numbers(k, self.wrong[k], self.right[k])
            for k, criterion in enumerate(self.criteria)
            if not (criterion.is_property or criterion.is_truth)
        }

    @cached_property
    def _reach(self) -> np.ndarray:
        """How many numbers each mistake changes: (mistakes,)."""
        return np.sum([np.sum(of, axis=1) for of in self._changed_numbers.values()], axis=0)

    @cached_property
    def _of_changes(self) -> np.ndarray:
        return np.array([claim is Claim.CHANGED for claim in self.claims], dtype=bool)

    def _explained(self, k: int, asked: np.ndarray, named: Sequence[int]) -> np.ndarray:
        """Whether the numbers of criterion k are a mistake's, alone or beside one more; of one that says
        nothing of what it does not change, number by number: (asked,).
        """
        right, given, wrong = self.right[k], self.given[k], self.wrong[k][asked]
        if self.criteria[k].is_truth:
            return np.all((wrong == right) | (wrong == given), axis=1)
        same = self.layout[k].same
        # Two mistakes at once need not add up as exactly as one is told from its like.
        tolerance = self.criteria[k].tolerance
        found = self.shown[asked, k] | same(wrong, given, tolerance)
        for other in named:
            left = np.flatnonzero(~found & (asked != other))
            found[left] = same(wrong[left] + self.wrong[k][other] - right, given, tolerance)
        left = np.flatnonzero(~found & self._of_changes[asked])
        wrong = wrong[left]
        parts = self._same_numbers(k, wrong, given) | self._same_numbers(k, wrong, right)
        for other in named:
            both = self._same_numbers(k, wrong + self.wrong[k][other] - right, given)
            parts |= both & (asked[left] != other)[:, np.newaxis]
        found[left] = np.all(parts, axis=1)
        return found

    def _same_numbers(self, k: int, rows: np.ndarray, numbers: np.ndarray) -> np.ndarray:
        """Whether each number of criterion k is the same in all cases: (rows, numbers).

        One for all of them, where cases differ in how many they have, or have many.
        """
        of, tolerance = self.layout[k], self.criteria[k].tolerance
        cases = [case for case, size in enumerate(of.sizes) if size > 1]
        sizes = {of.sizes[case] - 1 for case in cases}
        if len(sizes) != 1 or max(sizes) > MOST_NUMBERS:
            return of.same(numbers, rows, tolerance)[:, np.newaxis]
        at = of.starts[cases][:, np.newaxis] + 1 + np.arange(*sizes)
        size = np.abs(numbers[at])
        scale = np.maximum(np.maximum(size, LEAST_SCALE * np.max(size, axis=0)), of.floor)
        error = np.abs(rows[:, at] - numbers[at])
        return np.all(error <= tolerance * np.where(scale > 0, scale, 1.0), axis=1)
