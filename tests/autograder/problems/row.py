"""A row in a problem's table of wrong answers, and which mistakes a check names for it."""

from dataclasses import dataclass, replace
from functools import cache

from autograder.judging.check import Check
from autograder.judging.diagnosis import Catalogue, Mistake
from autograder.judging.verdict import Verdict
from autograder.problems import CHECKS
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
class Naming:
    """A catalogue whose sentences know whose they are."""

    of: Catalogue

    def mistakes(self):
        return [replace(m, sentence=Sentence(m)) for m in self.of.mistakes()]

    def __call__(self, calls):
        values = (values for _, values in self.of(calls))
        return list(zip(self.mistakes(), values, strict=True))


@cache
def naming(check_id: str) -> Check:
    """The check, with sentences that know whose they are."""
    check = CHECKS[check_id]
    named = tuple(replace(m, sentence=Sentence(m)) for m in check.mistakes)
    catalogue = check.catalogue and Naming(check.catalogue)
    return replace(check, mistakes=named, catalogue=catalogue)


def verdict_on(row: Row) -> Verdict:
    return judged_by(naming(row.check), row.body)


def names_in(verdict: Verdict) -> tuple[str, ...]:
    """The names of the mistakes in a verdict; "" where a sentence is no mistake's."""
    return tuple(getattr(sentence, "of", "") for sentence in verdict.diagnosis)
