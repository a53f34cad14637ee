"""Hands each mutant's numbers in to a check: it finds that one and no other, and gives what it earns."""

from dataclasses import dataclass, field, replace

import numpy as np

from autograder.judging.check import VISIBLE_CASES, Check
from autograder.judging.diagnosis import Mistake
from autograder.judging.models import evaluated
from autograder.judging.quantities import each
from autograder.judging.verdict import State
from autograder.protocol import Reply

SEED = 5


@dataclass
class Once:
    """Quantities that are formed once of the same values, as a catalogue's are asked for again."""

    of: object
    formed: dict = field(default_factory=dict)

    def __call__(self, calls, values):
        if id(values) not in self.formed:
            # The values are kept too, so that no others get their id.
            self.formed[id(values)] = values, self.of(calls, values)
        return self.formed[id(values)][1]


@dataclass(frozen=True)
class Found:
    """A catalogue's mistakes for the calls of one seed."""

    made: list[tuple[Mistake, object]]

    def mistakes(self):
        return [mistake for mistake, _ in self.made]

    def __call__(self, calls):
        return self.made


def earned(check: Check, calls, given) -> float:
    """The shares of the criteria that numbers meet: 1e-5 of a value's size, or of a twentieth of the
    largest.
    """
    right = [evaluated(check.reference, [call])[0] for call in calls]
    cases = [list(zip(*check.quantities(calls, values), strict=True)) for values in (right, given)]
    total = 0.0
    for criterion, expected, got in zip(check.criteria, *cases, strict=True):
        sizes = [np.abs(value).max(initial=0.0) for value in expected]
        met = (
            np.abs(g - e).max(initial=0.0) <= 1e-5 * (max(size, max(sizes) / 20) or 1.0)
            for e, g, size in zip(expected, got, sizes, strict=True)
        )
        total += criterion.share * all(met)
    return total


def assert_each_is_found(check: Check, few: int | None = None, count: int = VISIBLE_CASES) -> None:
    """few: so many of them, spread over all; None for each. count: of cases. Each is told by its name,
    also from those with its sentence.
    """
    assert check.catalogue is not None
    calls = check.calls(np.random.default_rng(SEED), count)
    made = check.catalogue(calls)
    found = Found([(replace(m, sentence=f"{k}: {m.name}"), v) for k, (m, v) in enumerate(made)])
    assert [m for m, _ in made] == check.catalogue.mistakes()
    # Those of each call by itself are formed for all mutants at once.
    formed = check.quantities if isinstance(check.quantities, each) else Once(check.quantities)
    asked = replace(check, catalogue=found, quantities=formed)
    stride = max(1, len(made) // few) if few else 1
    for k in range(0, len(made), stride):
        mistake, values = found.made[k]
        if not all(np.isfinite(value).all() for value in values):
            continue  # a square root of less than nothing, of a slider-crank
        verdict = asked.run(
            lambda calls, values=values: [Reply(value=value) for value in values],
            np.random.default_rng(SEED),
            count,
        )
        # A written mistake with these numbers comes first, and must say the same.
        assert verdict.diagnosis in ((mistake.sentence,), (made[k][0].sentence,)), mistake.name
        assert abs(verdict.credit - earned(check, calls, values)) < 1e-12, mistake.name
        partly = State.PARTLY_CORRECT if verdict.credit else State.INCORRECT
        assert verdict.state is partly, mistake.name
