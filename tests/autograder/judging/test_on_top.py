"""A sign of the whole on top of another mistake: both are named, each with its own sentence."""

import numpy as np
import pytest

from autograder.judging.claims import ON_TOP, as_written
from autograder.mechanisms import MECHANISMS
from autograder.mutation.checks import check_of
from autograder.mutation.references import reference
from autograder.mutation.whole import whole
from autograder.problems import CHECKS
from tests.autograder.mutation.test_mistakes import judged as judged_by
from tests.autograder.problems.p5_state_space.table import drift
from tests.autograder.verdicts import judged, sentences

LOST = {"½ of K missing": "qd @ M(q) @ qd", "½ of K twice": "qd @ M(q) @ qd / 4"}


@pytest.mark.parametrize("mistake", LOST)
def test_a_drift_that_is_counted_backwards_of_a_wrong_energy(mistake):
    verdict = judged("p5-energy_drift", drift(K=LOST[mistake], returned="E[0] - E"))
    sign, other = sentences("p5-energy_drift", "sign of the whole", mistake)
    kinetic, potential, both = verdict.rows
    assert kinetic.said == both.said == (sign, ON_TOP + other)
    assert potential.said == (sign,)  # which the other mistake does not change
    assert verdict.credit == 0


@pytest.mark.parametrize(
    ("name", "answer", "wrong"),
    [
        ("planar-2r", "C", lambda right, q, qd, arm: -right.C.T),
        ("furuta", "C", lambda right, q, qd, arm: -(right.M_dot - right.C)),
        ("cart-pole", "M_dot", lambda right, q, qd, arm: -np.triu(right.M_dot)),
    ],
)
def test_a_wrong_sign_of_a_wrong_matrix(name, answer, wrong):
    mechanism = MECHANISMS[name]

    def theirs(q, qd, arm):
        numbers = whole(mechanism)(q[None], qd[None], [arm])
        numbers = type(numbers)(**{key: value[0] for key, value in numbers.named().items()})
        return wrong(numbers, q, qd, arm)

    check = check_of(mechanism, answer)
    said = judged_by(check, theirs).diagnosis
    known = {mistake.sentence for mistake in check.known_mistakes}
    assert {as_written(text) for text in said} <= known | {c.otherwise for c in check.criteria}
    assert sum(text.startswith(ON_TOP) for text in said) <= 1


def test_what_is_right_is_not_turned():
    """E(0) − (K − P): the change of P is right, and only K has the wrong sign."""
    verdict = judged("p5-energy_drift", drift(E="K - P", returned="E[0] - E"))
    assert verdict.credit == 0.35
    assert not any(text.startswith(ON_TOP) for text in verdict.diagnosis)


def test_a_sine_times_a_cosine_is_no_half_of_a_double_angle():
    right = reference(MECHANISMS["pendulum"], "g_vec")
    said = judged_by(CHECKS["p3-g_vec"], lambda q, pend: right(q, pend) * np.cos(q)).diagnosis
    assert not any("half" in text or text.startswith(ON_TOP) for text in said)
