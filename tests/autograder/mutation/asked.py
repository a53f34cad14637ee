"""A check asked on the calls of one seed: its mistakes, and what of their numbers is judged."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from autograder.judging.check import VISIBLE_CASES, Check
from autograder.judging.claims import MOST_NUMBERS, Claim
from autograder.judging.criterion import relative_errors
from autograder.judging.diagnosis import Mistake
from autograder.judging.models import evaluated
from autograder.judging.verdict import Verdict
from autograder.protocol import Reply
from tests.autograder.every_mutant import Found

SEED = 0


@dataclass(frozen=True)
class Asked:
    """A check on the calls of one seed. wrong: what each mistake returns for them."""

    check: Check

    @cached_property
    def calls(self) -> list:
        return self.check.calls(np.random.default_rng(SEED), VISIBLE_CASES)

    @cached_property
    def once(self) -> Check:
        """The check; its catalogue is evaluated once."""
        catalogue = self.check.catalogue
        return replace(self.check, catalogue=Found(catalogue(self.calls)) if catalogue else None)

    @cached_property
    def right(self) -> list:
        return arrays(evaluated(self.check.reference, self.calls))

    @cached_property
    def wrong(self) -> list[tuple[Mistake, list]]:
        known = [(m, evaluated(m.wrong, self.calls)) for m in self.check.mistakes]
        known += self.once.catalogue.made if self.once.catalogue else []
        found = [(mistake, arrays(values)) for mistake, values in known]
        return [(m, values) for m, values in found if all(map(np.all, map(np.isfinite, values)))]

    def verdict(self, given: list) -> Verdict:
        """On these values; to what is asked afterwards there is no reply."""
        replies = iter([[Reply(value=value) for value in given]])
        rng = np.random.default_rng(SEED)
        return self.once.run(lambda calls: next(replies, []), rng, VISIBLE_CASES)

    def judged(self, values: list) -> list[np.ndarray]:
        """Of each criterion its numbers, (cases, numbers); (all, 1) where cases differ or have many."""
        parts = zip(*self.check.quantities(self.calls, values), strict=True)
        found = []
        for cases in parts:
            own = [np.ravel(np.asarray(case, float)) for case in cases if np.size(case)]
            alike = len({len(case) for case in own}) == 1 and len(own[0]) <= MOST_NUMBERS
            found.append(np.array(own) if alike else np.concatenate(own)[:, np.newaxis])
        return found

    @cached_property
    def expected(self) -> list[np.ndarray]:
        return self.judged(self.right)

    @cached_property
    def errors(self) -> list[list[np.ndarray]]:
        """Of each mistake's numbers, criterion by criterion."""
        return [
            [own - right for own, right in zip(self.judged(values), self.expected, strict=True)]
            for _, values in self.wrong
        ]

    @cached_property
    def of_text(self) -> dict[str, list[int]]:
        """The places of the mistakes with a sentence."""
        found: dict[str, list[int]] = {}
        for i, (mistake, _) in enumerate(self.wrong):
            found.setdefault(mistake.sentence, []).append(i)
        return found

    def near(self, k: int, one: np.ndarray, other: np.ndarray) -> np.ndarray:
        """Whether numbers of criterion k are the same in all cases: (numbers,)."""
        size = max(np.max(np.abs(self.expected[k])), np.max(np.abs(other))) or 1.0
        tolerance = 2 * self.check.criteria[k].tolerance * size
        return np.all(np.abs(one - other) <= tolerance, axis=0)

    def changes(self, i: int, k: int) -> bool:
        """Whether mistake i shows in criterion k."""
        right, error, criterion = self.expected[k], self.errors[i][k], self.check.criteria[k]
        if criterion.matching is None:
            return not np.all(self.near(k, right + error, right))
        return bool(np.any(relative_errors(list(right), list(right + error)) > criterion.matching))

    def bears_out(self, i: int, k: int, given: np.ndarray, beside: list[int]) -> bool:
        """Whether criterion k's numbers are those of mistake i wherever its sentence speaks of them."""
        right, own = self.expected[k], self.expected[k] + self.errors[i][k]
        criterion, claim = self.check.criteria[k], self.wrong[i][0].claim
        if criterion.is_truth:
            return bool(np.all((own == right) | (own == given)))
        if claim is Claim.CHANGED and criterion.is_property:
            return True
        same = self.near(k, own, given)
        if claim is not Claim.WHOLE:
            for other in beside:
                same |= self.near(k, own + self.errors[other][k], given)
        if claim is Claim.CHANGED:
            same |= self.near(k, own, right)
        return bool(np.all(same))


def arrays(values) -> list:
    return [np.asarray(value, dtype=float) for value in values]
