"""Each mutant's numbers, handed in: the check finds it and no other, and gives the credit it earns."""

from dataclasses import dataclass, field, replace

import numpy as np
import pytest

from autograder.judging.check import VISIBLE_CASES
from autograder.judging.verdict import State
from autograder.mechanisms import MECHANISMS
from autograder.mutation.answers import ANSWERS
from autograder.mutation.checks import check_of, mistakes_of
from autograder.protocol import Reply, read, real

ASKED = [(m, answer) for m in MECHANISMS.values() for answer in ANSWERS]
# In a night each mutant; else so many of each answer of some mechanisms, and of a few of the others'.
FEW, ON = 6, ("pendulum", "cart-pole", "planar-2r", "slider-crank")
SOME = [
    (m, answer)
    for i, m in enumerate(MECHANISMS.values())
    for k, answer in enumerate(ANSWERS)
    if m.name in ON or (i + k) % 4 == 0
]
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


class Named:
    """The catalogue of a check for the calls of one seed, whose sentences are the mutants' numbers."""

    def __init__(self, check):
        self.calls = check.calls(np.random.default_rng(SEED), VISIBLE_CASES)
        known = check.catalogue(self.calls)
        self.found = [(replace(m, sentence=str(k)), values) for k, (m, values) in enumerate(known)]

    def __call__(self, calls):
        return self.found


def earned(check, calls, given):
    """The shares of the criteria that numbers meet: 1e-5 of a value's size, or of a twentieth of the
    largest.
    """
    right = [read(call, check.reference(*map(real, call.args))) for call in calls]
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


def assert_each_is_found(mechanism, answer, few=None):
    check = check_of(mechanism, answer)
    named = Named(check)
    asked = replace(check, catalogue=named, quantities=Once(check.quantities))
    assert len(named.found) == len(mistakes_of(mechanism, answer))
    stride = max(1, len(named.found) // few) if few else 1
    for k in range(0, len(named.found), stride):
        mistake, values = named.found[k]
        if not np.isfinite(values).all():
            continue  # a square root of less than nothing, of a slider-crank
        verdict = asked.run(
            lambda calls, values=values: [Reply(value=value) for value in values],
            np.random.default_rng(SEED),
            VISIBLE_CASES,
        )
        assert verdict.diagnosis == (str(k),), mistake.name
        assert abs(verdict.credit - earned(check, named.calls, values)) < 1e-12, mistake.name
        partly = State.PARTLY_CORRECT if verdict.credit else State.INCORRECT
        assert verdict.state is partly, mistake.name


@pytest.mark.parametrize(("mechanism", "answer"), SOME, ids=[f"{m.name}-{a}" for m, a in SOME])
def test_some_are_found(mechanism, answer):
    assert_each_is_found(mechanism, answer, FEW)


@pytest.mark.long
@pytest.mark.parametrize(("mechanism", "answer"), ASKED, ids=[f"{m.name}-{a}" for m, a in ASKED])
def test_each_is_found(mechanism, answer):
    assert_each_is_found(mechanism, answer)
