"""What is known of one answer of a mechanism: its mistakes, their sentences, and its parts."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from autograder.judging.diagnosis import Mistake
from autograder.mechanisms.outline import Outline
from autograder.mutation import kept
from autograder.mutation.answers import ANSWERS
from autograder.mutation.calls import Model, of_calls
from autograder.mutation.composed import catalogue_of
from autograder.mutation.references import contributions
from autograder.protocol import Call


@dataclass(frozen=True)
class _Wrong:
    """What the k-th mistake returns for one call."""

    mechanism: Outline
    answer: str
    k: int

    def __call__(self, *args) -> np.ndarray:
        return numbers_of(self.mechanism, self.answer, [Call(self.answer, args)])[self.k, 0]


@lru_cache(maxsize=64)
def mistakes_of(mechanism: Outline, answer: str) -> list[Mistake]:
    """Every mistake of an answer with its sentence.

    The sentences are kept by themselves: where one changes, only they are made anew.
    """
    mutants = catalogue_of(mechanism, answer).mutants

    def made() -> dict:
        from autograder.mutation.sentences import sentence

        return {"said": [sentence(m, mechanism, ANSWERS[answer]) for m in mutants]}

    def read(data: dict) -> list[str]:
        said = data["said"]
        if len(said) != len(mutants) or not all(isinstance(text, str) for text in said):
            raise ValueError("these are the sentences of other mistakes")
        return said

    parts = ("sentences", kept.sentences(), *kept.definition(mechanism), answer)
    return [
        Mistake(
            m.name,
            _Wrong(mechanism, answer, k),
            said,
            m.claim(answer),
            seldom=m.is_seldom,
            combines=m.operator not in ("doubled", "halved"),
        )
        for k, (m, said) in enumerate(zip(mutants, kept.entry(parts, made, read), strict=True))
    ]


def numbers_of(mechanism: Outline, answer: str, calls: list[Call]) -> np.ndarray:
    """What each mistake returns for each call, (mistakes, calls, …), as `of_calls`."""
    return of_calls(mechanism, answer, calls, catalogue_of(mechanism, answer).numbers)


@lru_cache(maxsize=64)
def parts_of(mechanism: Outline, answer: str) -> tuple[tuple[str, Model], ...]:
    """The parts of the right answer, by the terms of the energies or the torques they come from."""
    asked = ANSWERS[answer]
    found = list(contributions(mechanism, answer))
    if asked.composition:
        for name, numbers in asked.composition(mechanism).terms.items():
            found.append((name, Model(mechanism, answer, numbers)))
    return tuple(found)
