"""All mistakes of an answer that is made of others: its own, and those of its parts that show in it."""

from functools import cached_property, lru_cache

import numpy as np

from autograder.mechanisms.outline import Outline
from autograder.mutation import kept
from autograder.mutation.answers import ANSWERS
from autograder.mutation.catalogue import Catalogue
from autograder.mutation.distinct import CASES, each_once
from autograder.mutation.mutant import Mutant


@lru_cache(maxsize=128)
def linear(mechanism: Outline, answer: str) -> Catalogue:
    """The mistakes of an answer by itself, made once in a process."""
    return Catalogue(mechanism, answer)


@lru_cache(maxsize=64)
def catalogue_of(mechanism: Outline, answer: str) -> "Catalogue | Composed":
    """The mistakes of an answer, made once in a process."""
    composed = ANSWERS[answer].composition
    return Composed(mechanism, answer) if composed else linear(mechanism, answer)


class Composed:
    """The mistakes of an answer, each once, none equal to the right one. The simplest reading counts."""

    def __init__(self, mechanism: Outline, answer: str):
        asked = ANSWERS[answer]
        assert asked.composition is not None
        self._composition = asked.composition(mechanism)

        def catalogue(name: str, of: Outline = mechanism) -> Catalogue:
            return linear(of, name)

        self._mechanism, self._asked = mechanism, asked
        self._groups = list(self._composition.groups(catalogue))
        self._kept = kept.entry(
            ("composed", *kept.definition(mechanism), answer), self._made, self._read
        )

    def _made(self) -> dict:
        """The places of the mistakes in their groups, as plain data."""
        self._kept = [np.arange(len(group.mutants)) for group in self._groups]
        rng = np.random.default_rng(0)
        calls = self._asked.calls(self._mechanism.full, rng, CASES)
        columns = self._composition.columns([call.args for call in calls])
        every = [(g, k) for g, places in enumerate(self._kept) for k in places.tolist()]
        found = each_once(every, self.numbers(*columns), self.right(*columns))
        groups = range(len(self._groups))
        return {
            "of": [len(group.mutants) for group in self._groups],
            "places": [[k for g, k in found if g == i] for i in groups],
        }

    def _read(self, data: dict) -> list[np.ndarray]:
        if data["of"] != [len(group.mutants) for group in self._groups]:
            raise ValueError("these are the places in other groups")
        found = [np.array(places, dtype=int) for places in data["places"]]
        for group, places in zip(self._groups, found, strict=True):
            if np.any((places < 0) | (places >= len(group.mutants))):
                raise ValueError("a place is outside its group")
        return found

    @cached_property
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
