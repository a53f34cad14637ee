"""What a right answer of a mechanism's check leads to is said, and true of the mechanism."""

import numpy as np
import pytest

from autograder.mechanisms import MECHANISMS
from autograder.mutation.answers import ANSWERS
from autograder.mutation.checks import check_of
from autograder.mutation.further import OF_ALL
from autograder.mutation.references import reference
from autograder.mutation.sentences.notation import written
from tests.autograder.mutation.test_mistakes import judged


def test_every_answer_leads_further():
    assert set(OF_ALL) == set(ANSWERS)
    check = check_of(MECHANISMS["cart-pole"], "M")
    verdict = judged(check, reference(MECHANISMS["cart-pole"], "M"))
    assert verdict.further == "K is the same at every x, so M does not change with x."


@pytest.mark.parametrize("name", ["planar-2r", "cart-pole", "furuta", "turn-and-slide", "pendulum"])
def test_what_does_not_depend_on_a_coordinate_does_not(name):
    mechanism, rng = MECHANISMS[name], np.random.default_rng(3)
    arm, q = mechanism.drawn(rng), mechanism.placed(rng)
    for answer in ("M", "g_vec"):
        said, right = check_of(mechanism, answer).further, reference(mechanism, answer)
        for k, c in enumerate(mechanism.coordinates):
            if f"at every {written(c.name, mechanism)}," not in said:
                continue
            moved = q + 0.7 * np.eye(mechanism.n)[k]
            assert np.allclose(right(q, arm), right(moved, arm))
            assert answer == "M" or np.allclose(np.ravel(right(q, arm))[k], 0)


@pytest.mark.parametrize("name", ["elastic-joint", "pendulum", "slider-crank"])
def test_a_constant_M_is_called_so(name):
    mechanism, rng = MECHANISMS[name], np.random.default_rng(5)
    arm, q, qd = mechanism.drawn(rng), mechanism.placed(rng), mechanism.moving(rng)
    M, C = reference(mechanism, "M"), reference(mechanism, "C")
    is_constant = np.allclose(M(q, arm), M(mechanism.placed(rng), arm))
    assert is_constant == np.allclose(C(q, qd, arm), 0)
    assert ("M never changes" in check_of(mechanism, "M").further) == is_constant


@pytest.mark.parametrize("name", ["planar-2r", "cart-pole"])
def test_the_power_of_M_dot_is_that_of_C(name):
    mechanism, rng = MECHANISMS[name], np.random.default_rng(4)
    q, qd, arm = mechanism.placed(rng), mechanism.moving(rng), mechanism.drawn(rng)
    M_dot, C = (np.asarray(reference(mechanism, of)(q, qd, arm)) for of in ("M_dot", "C"))
    assert qd @ M_dot @ qd / 2 == pytest.approx(qd @ C @ qd)
    assert np.allclose(M_dot - 2 * C, -(M_dot - 2 * C).T)
