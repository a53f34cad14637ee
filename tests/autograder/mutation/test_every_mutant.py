"""Each mutant's numbers, handed in: the check finds it and no other, and gives the credit it earns."""

import pytest

from autograder.mechanisms import MECHANISMS
from autograder.mutation.answers import ANSWERS
from autograder.mutation.checks import check_of
from tests.autograder.every_mutant import assert_each_is_found

ASKED = [(m, answer) for m in MECHANISMS.values() for answer in ANSWERS]
# In a night each mutant; else so many of each answer of some mechanisms, and of a few of the others'.
FEW, ON = 6, ("pendulum", "cart-pole", "planar-2r", "slider-crank")
SOME = [
    (m, answer)
    for i, m in enumerate(MECHANISMS.values())
    for k, answer in enumerate(ANSWERS)
    if m.name in ON or (i + k) % 4 == 0
]


@pytest.mark.parametrize(("mechanism", "answer"), SOME, ids=[f"{m.name}-{a}" for m, a in SOME])
def test_some_are_found(mechanism, answer):
    assert_each_is_found(check_of(mechanism, answer), FEW)


@pytest.mark.long
@pytest.mark.parametrize(("mechanism", "answer"), ASKED, ids=[f"{m.name}-{a}" for m, a in ASKED])
def test_each_is_found(mechanism, answer):
    assert_each_is_found(check_of(mechanism, answer))
