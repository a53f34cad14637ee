"""What follows from a mechanism for one answer: the right one, its terms and its mistakes.

A check of a problem is declared with it. Nothing is derived before an answer is asked for, and
SymPy is not imported where what is needed is kept.
"""

from __future__ import annotations

import fnmatch
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from types import SimpleNamespace
from typing import TYPE_CHECKING

import numpy as np

from autograder.judging.diagnosis import Mistake
from autograder.judging.terms import Term
from autograder.protocol import Call

if TYPE_CHECKING:
    from autograder.mechanisms.outline import Outline
    from autograder.mutation.calls import Gathered, Model

NUMBERS_OF_THE_EXAMPLE = (
    "You always use the numbers of the example, whatever you are given. Where does your function read "
    "the parameters of its own argument?"
)


class Generated:
    """mechanism: its name, or itself. answer: one of `ANSWERS`. rows: a teacher's sentences, each by the
    name of its mistake, in which `*` stands for anything; the most specific counts. example: the
    mechanism of the notebook, for those who write its numbers into a function.
    """

    def __init__(
        self,
        mechanism: str | Outline,
        answer: str,
        rows: Mapping[str, str] | None = None,
        example: SimpleNamespace | None = None,
    ):
        self.given, self.answer, self.example = mechanism, answer, example
        self.rows = dict(rows or {})

    @cached_property
    def mechanism(self) -> Outline:
        if not isinstance(self.given, str):
            return self.given
        from autograder.mutation.outlines import outline

        return outline(self.given)

    @cached_property
    def reference(self) -> Model:
        """The right answer, with the arguments of the student's function."""
        from autograder.mutation.references import reference

        return reference(self.mechanism, self.answer)

    def terms(self) -> tuple[Term, ...]:
        from autograder.mutation.calls import Gathered
        from autograder.mutation.mistakes import parts_of

        return tuple(
            Term(name, Gathered(model, self._gathered))
            for name, model in parts_of(self.mechanism, self.answer)
        )

    def _gathered(self, args: tuple) -> tuple:
        """(q, q̇, arm) of all numbers, one by one, as some functions take them."""
        m, n = self.mechanism, self.mechanism.n
        if isinstance(args[-1], SimpleNamespace):
            return args
        numbers = dict(zip([p.name for p in m.parameters], args[2 * n :], strict=True))
        return np.array(args[:n]), np.array(args[n : 2 * n]), SimpleNamespace(**numbers)

    def mistakes(self) -> list[Mistake]:
        """Every mistake, with the sentence of its row, or else of its operator."""
        return self._made

    @cached_property
    def _made(self) -> list[Mistake]:
        from autograder.mutation.mistakes import mistakes_of

        made = [self._said(mistake) for mistake in mistakes_of(self.mechanism, self.answer)]
        return made + ([self._said(self._of_example())] if self.example else [])

    def __call__(self, calls: list[Call]) -> list[tuple[Mistake, Sequence | np.ndarray]]:
        """Every mistake, with what it returns for each call."""
        from autograder.mutation.mistakes import numbers_of

        values: list = [*numbers_of(self.mechanism, self.answer, calls)]
        if self.example:
            values.append(self._on_example.for_calls(calls))
        return list(zip(self.mistakes(), values, strict=True))

    def _of_example(self) -> Mistake:
        return Mistake("numbers of the example", self._on_example, NUMBERS_OF_THE_EXAMPLE)

    @property
    def _on_example(self) -> Gathered:
        from autograder.mutation.calls import Gathered

        return Gathered(self.reference, lambda args: (*args[:-1], self.example))

    def _said(self, mistake: Mistake) -> Mistake:
        fitting = [row for row in self._rows if fnmatch.fnmatchcase(mistake.name, row)]
        if not fitting:
            return mistake
        return replace(mistake, sentence=self._rows[max(fitting, key=_specific)])

    @cached_property
    def _rows(self) -> dict[str, str]:
        """The problem's, and those that the mechanism brings for this answer."""
        asked = f"{self.answer}: "
        brought = {
            mistake.removeprefix(asked): sentence
            for mistake, sentence in dict(self.mechanism.sentences).items()
            if mistake.startswith(asked)
        }
        return self.rows | brought

    def unused(self) -> list[str]:
        """The rows that fit no mistake: mistyped, or no mistake of this answer any more."""
        names = [mistake.name for mistake in self.mistakes()]
        return [row for row in self._rows if not fnmatch.filter(names, row)]


def _specific(pattern: str) -> int:
    return len(pattern.replace("*", ""))
