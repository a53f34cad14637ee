"""All mistakes of an answer that is made of others: its own, and those of its parts that show in it."""

from functools import lru_cache

import numpy as np

from autograder.mechanisms import Mechanism
from autograder.mutation.answers import ANSWERS
from autograder.mutation.catalogue import CASES, Catalogue, each_once
from autograder.mutation.mutant import Mutant


@lru_cache(maxsize=128)
def linear(mechanism: Mechanism, answer: str) -> Catalogue:
    """The mistakes of an answer by itself, made once in a process."""
    return Catalogue(mechanism, answer)


@lru_cache(maxsize=64)
def catalogue_of(mechanism: Mechanism, answer: str) -> "Catalogue | Composed":
    """The mistakes of an answer, made once in a process."""
    composed = ANSWERS[answer].composition
    return Composed(mechanism, answer) if composed else linear(mechanism, answer)


class Composed:
    """The mistakes of an answer, each once, none equal to the right one. The simplest reading counts."""

    def __init__(self, mechanism: Mechanism, answer: str):
        asked = ANSWERS[answer]
        assert asked.composition is not None
        self._composition = asked.composition(mechanism)
        self._groups = list(self._composition.groups(lambda name: linear(mechanism, name)))
        self._kept = [np.arange(len(group.mutants)) for group in self._groups]
        calls = asked.calls(mechanism, np.random.default_rng(0), CASES)
        columns = self._composition.columns([call.args for call in calls])
        numbers = self.numbers(*columns)
        every = [(g, k) for g, kept in enumerate(self._kept) for k in kept]
        kept = each_once(every, numbers, self.right(*columns))
        self._kept = [np.array([k for g, k in kept if g == i], int) for i in range(len(self._kept))]

    @property
    def mutants(self) -> list[Mutant]:
        return [
            group.mutants[k]
            for group, kept in zip(self._groups, self._kept, strict=True)
            for k in kept
        ]

    def numbers(self, *columns) -> np.ndarray:
        """What each mutant returns: (mutants, cases, …). columns: those of the composition."""
        with np.errstate(all="ignore"):
            return np.concatenate(
                [
                    group.numbers(*columns)[kept]
                    for group, kept in zip(self._groups, self._kept, strict=True)
                ]
            )

    def right(self, *columns) -> np.ndarray:
        """The right answer, (cases, …)."""
        return self._composition.right(*columns)
