"""The numbers of one check, and models and mistakes that give them."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import cast

import numpy as np

from autograder.judging.claims import Claim
from autograder.judging.diagnosis import Mistake
from autograder.judging.models import Model
from autograder.judging.terms import Term
from autograder.protocol import Call
from autograder.stored import files
from autograder.stored.asking import key
from autograder.stored.reading import restored


class NotStoredError(LookupError):
    """Right numbers were asked for a call for which none are stored."""


class Numbers:
    """What is stored of one check. It is read when it is first asked for.

    name: of the file, the check's id, or `id@arm` on a student's own arm.
    """

    def __init__(self, name: str):
        self.name = name

    @cached_property
    def _all(self) -> dict:
        return files.read(f"numbers-{self.name}")

    @cached_property
    def _keys(self) -> list[str]:
        return [key(call) for call in self.calls()]

    def calls(self, rng: np.random.Generator | None = None, count: int = 0) -> list[Call]:
        """The calls of the visible check, as `Check.calls` gives them; there are no others."""
        return [restored(call) for call in self._all["calls"]]

    def reference(self) -> dict[str, object]:
        """Of the right answer, by the call."""
        return self._by_call("reference")

    def beside(self, place: int) -> dict[str, object]:
        """Of another right model that quantities need, by the call."""
        return self._by_call("beside", place)

    def of_mistake(self, place: int) -> dict[str, object]:
        """Of a mistake that is written, by the call."""
        return self._in_order(self._all["mistakes"][place])

    def terms(self) -> tuple[Term, ...]:
        """The parts of the right answer."""
        return tuple(
            Term(name, cast(Model, Stored(self._in_order(values))))
            for name, values in self._all["terms"]
        )

    def generated(self) -> list[tuple[Mistake, Sequence | np.ndarray]]:
        """The mistakes that followed from the energies, with their numbers for the visible calls."""
        return [
            (mistake_of(said, Stored({})), restored(values))
            for said, values in self._all["generated"]
        ]

    def pose(self, call: Call) -> list:
        """The joints of the arm in a call that a card may show, (x, y) in m each."""
        return restored(self._all["pose"][self._all["shown"].index(key(call))])

    def check_calls(self, calls: list[Call]) -> None:
        """NotStoredError where these are not the visible calls."""
        if [key(call) for call in calls] != self._keys:
            raise NotStoredError(f"no numbers of {self.name} are stored for other calls")

    def _in_order(self, values) -> dict[str, object]:
        return dict(zip(self._keys, restored(values), strict=True))

    def _by_call(self, name: str, place: int | None = None) -> dict[str, object]:
        found = self._all[name] if place is None else self._all[name][place]
        return dict(zip(self._all["asked"], restored(found), strict=True))


@dataclass(frozen=True)
class Stored:
    """A model whose numbers are stored, by the call."""

    values: dict[str, object]

    def for_calls(self, calls: list[Call]) -> list:
        """Its numbers for each call; NotStoredError where there are none."""
        try:
            return [self.values[key(call)] for call in calls]
        except KeyError:
            raise NotStoredError("no numbers are stored for this call") from None


@dataclass(frozen=True)
class Later:
    """A stored model of which nothing is read before it is asked. of: gives its numbers."""

    numbers: Numbers
    of: str
    place: int | None = None

    def for_calls(self, calls: list[Call]) -> list:
        """As Stored's."""
        read = getattr(self.numbers, self.of)
        return Stored(read() if self.place is None else read(self.place)).for_calls(calls)


@dataclass(frozen=True)
class StoredCatalogue:
    """The mistakes of a check that followed from the energies."""

    numbers: Numbers

    def mistakes(self) -> list[Mistake]:
        return [mistake for mistake, _ in self.numbers.generated()]

    def __call__(self, calls: list[Call]) -> list[tuple[Mistake, Sequence | np.ndarray]]:
        self.numbers.check_calls(calls)
        return self.numbers.generated()


def mistake_of(said: dict, wrong) -> Mistake:
    """A mistake by what is stored of it: its name, its sentence, and how it may be said."""
    return Mistake(
        said["name"],
        wrong,
        said["sentence"],
        Claim[said["claim"]],
        said["combines"],
        said["seldom"],
    )
