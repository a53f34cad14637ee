"""A row in a problem's table of wrong answers, and which mistakes a check names for it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, partial

import numpy as np

from autograder.judging.check import Check
from autograder.judging.diagnosis import Catalogue, Mistake
from autograder.judging.models import evaluated
from autograder.judging.verdict import Verdict
from autograder.problems import CHECKS
from autograder.protocol import Call
from tests.autograder.verdicts import judged_by


@dataclass(frozen=True)
class Row:
    """A wrong answer as a student would write it, and the one mistake or the several that it shows.

    check: its id. mistakes: their names in the check, in the order in which the card names them.
    body: what the function returns, or its whole body. credit: what is left.
    """

    check: str
    mistakes: str | tuple[str, ...]
    body: str
    credit: float

    @property
    def names(self) -> tuple[str, ...]:
        return (self.mistakes,) if isinstance(self.mistakes, str) else self.mistakes

    def __str__(self):
        return f"{self.check}: {' and '.join(self.names)}"


class Sentence(str):
    """A mistake's sentence that knows whose it is, as several mistakes may share one."""

    of: str

    def __new__(cls, mistake: Mistake):
        self = super().__new__(cls, mistake.sentence)
        self.of = mistake.name
        return self


@dataclass(frozen=True)
class Remembered:
    """What a function gives for these calls, found once: all rows of a check are tried with the same."""

    of: Callable[[list[Call]], Sequence | np.ndarray]
    found: dict = field(default_factory=dict)

    def __call__(self, calls):
        key = tuple(map(id, calls))
        if key not in self.found:
            # The calls are kept too, so that no others get their ids.
            self.found[key] = calls, self.of(calls)
        return self.found[key][1]


@dataclass(frozen=True)
class Wrong:
    """A mistake's model, asked for the numbers of several calls alone."""

    for_calls: Remembered


@dataclass(frozen=True)
class Naming:
    """A catalogue whose sentences know whose they are."""

    made: list[Mistake]
    numbers: Remembered

    @classmethod
    def of(cls, catalogue: Catalogue) -> "Naming":
        made = [named(mistake) for mistake in catalogue.mistakes()]
        return cls(made, Remembered(lambda calls: [values for _, values in catalogue(calls)]))

    def mistakes(self):
        return self.made

    def __call__(self, calls):
        return list(zip(self.made, self.numbers(calls), strict=True))


def named(mistake: Mistake) -> Mistake:
    return replace(mistake, sentence=Sentence(mistake))


@cache
def naming(check_id: str) -> Check:
    """The check, with sentences that know whose they are, and with the same calls for the same numbers
    drawn: these, and what each mistake gives for them, are found once for all rows.
    """
    check = CHECKS[check_id]
    mistakes = tuple(
        replace(named(m), wrong=Wrong(Remembered(partial(evaluated, m.wrong))))
        for m in check.mistakes
    )
    drawn: dict[tuple[str, int], list[Call]] = {}

    def calls(rng, count):
        key = str(rng.bit_generator.state), count
        if key not in drawn:
            drawn[key] = check.calls(rng, count)
        return drawn[key]

    catalogue = check.catalogue and Naming.of(check.catalogue)
    return replace(check, calls=calls, mistakes=mistakes, catalogue=catalogue)


def verdict_on(row: Row) -> Verdict:
    return judged_by(naming(row.check), row.body)


def names_in(verdict: Verdict) -> tuple[str, ...]:
    """The names of the mistakes in a verdict; "" where a sentence is no mistake's."""
    return tuple(getattr(sentence, "of", "") for sentence in verdict.diagnosis)
