"""All mistakes of one answer for one mechanism, as they are kept.

The numbers of all of them come from one tape. They are derived where none are kept (`deriving.py`).
"""

from collections.abc import Sequence
from functools import cached_property
from types import SimpleNamespace

import numpy as np

from autograder.mechanisms.outline import Outline
from autograder.mutation import kept
from autograder.mutation.answers import ANSWERS, PARTS
from autograder.mutation.mutant import Mutant
from autograder.mutation.numbers import Made, Numbers
from autograder.mutation.shared import shared
from autograder.mutation.steps import STEPS
from autograder.mutation.tape import Tape


class Catalogue:
    """The mistakes of an answer, each once, none equal to the right one. The simplest reading counts."""

    def __init__(self, mechanism: Outline, answer: str):
        self.mechanism, self.answer = mechanism, (ANSWERS | PARTS)[answer]
        self.numbers = shared(self._numbers)
        self._kept, self._computed = kept.entry(
            ("catalogue", *kept.definition(mechanism), answer), self._made, self._read
        )

    def _made(self) -> dict:
        """All mistakes, as plain data."""
        from autograder.mutation.deriving import Deriving

        return Deriving(self.mechanism.full, self.answer).as_data()

    def _read(self, data: dict) -> tuple[list[tuple[Mutant, Made]], Numbers]:
        of_term = data["of_term"]
        found: list[tuple[Mutant, Made]] = []
        for fields, of in data["mutants"]:
            if isinstance(of, str):
                STEPS[self.answer.name][of]  # KeyError where there is none
                found.append((Mutant(*fields), of))
            else:
                which, mask = of
                [of_term[k] for k in which]  # IndexError likewise
                mask = None if mask is None else np.array(mask, dtype=float)
                found.append((Mutant(*fields), (which, mask)))
        terms = len(self.answer.term_names(self.mechanism))
        tape = Tape.from_data(data["tape"])
        return found, Numbers(self.mechanism, self.answer, terms, of_term, tape)

    @cached_property
    def mutants(self) -> list[Mutant]:
        return [mutant for mutant, _ in self._kept]

    def _numbers(self, q, qd, arms: Sequence[SimpleNamespace]) -> np.ndarray:
        """What each mutant returns: (mutants, cases, …). q, qd: (cases, n); arms: one a case."""
        with np.errstate(all="ignore"):  # a wrong term may have no value everywhere
            return self._computed.of(self._kept, q, qd, arms)

    def right(self, q, qd, arms) -> np.ndarray:
        """The right answer, (cases, …)."""
        return self._computed.right(q, qd, arms)
