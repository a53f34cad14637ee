"""What only p3-pendulum asks: an energy in symbols, an inertia about the pivot, a frequency."""

import numpy as np
import pytest

from armdyn import Pendulum
from autograder.judging.verdict import State
from autograder.problems import CHECKS


def test_the_lagrangian_and_the_inertia_agree_with_the_library():
    rng = np.random.default_rng(3)
    check = CHECKS["p3-lagrangian"]
    for call in check.calls(rng, 50):
        for point in call.at:
            q, qd, *parameters = point.values()
            model = Pendulum(**dict(zip(("m", "lc", "I", "g"), parameters, strict=True)))
            L = model.kinetic_energy([q], [qd]) - model.potential_energy([q])
            assert check.reference(*point.values()) == pytest.approx(L, rel=1e-13)
    check = CHECKS["p3-inertia_about_pivot"]
    for call in check.calls(rng, 50):
        I_com, m, lc = call.args
        expected = Pendulum.from_com(m=m, lc=lc, I_com=I_com).I
        assert check.reference(*call.args) == pytest.approx(expected)


def test_frequency_is_that_of_the_linearised_pendulum():
    """q̈ = −ω² q near hanging, with q̈ from armdyn's dynamics."""
    check = CHECKS["p3-small_angle_frequency"]
    for call in check.calls(np.random.default_rng(4), 50):
        (pend,) = call.args
        qdd = Pendulum(**vars(pend)).dynamics([1e-6], [0.0], [0.0]).item()
        assert check.reference(pend) ** 2 == pytest.approx(-qdd / 1e-6, rel=1e-9)


def test_failing_reference_blames_the_check():
    """A check whose reference breaks is our fault, and says so."""
    check = CHECKS["p3-M"]
    broken = type(check)(
        check.id, check.signature, lambda q, pend: pend.mass, check.calls, check.criteria
    )
    verdict = broken.run(lambda calls: [], np.random.default_rng(0))
    assert verdict.state is State.CHECK_FAILED
    assert "not your fault" in verdict.next_step
