from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given

from armdyn import Pendulum, Planar2R
from armdyn.properties import (
    gravity_gradient,
    positive_definiteness,
    power_balance,
    skew_symmetry,
    symmetry,
)
from tests.armdyn.arms import a_few, arms_and_states, planar_arms

NUMBERS = {"l1": 1, "l2": 0.8, "lc1": 0.5, "lc2": 0.4, "m1": 2, "m2": 1.5, "I1": 0.2, "I2": 0.1}


def a_velocity_above(qd, least=0.1):
    return np.where(np.abs(qd) < least, least, qd)


@a_few
@given(arms_and_states())
def test_every_property_holds_for_every_arm(case):
    arm, q, qd, u = case
    for finding in (
        symmetry(arm, q),
        positive_definiteness(arm, q),
        skew_symmetry(arm, q, qd),
        gravity_gradient(arm, q),
        power_balance(arm, q, qd, u),
    ):
        assert finding.holds, str(finding)


@dataclass(frozen=True)
class NotChristoffel(Planar2R):
    """C' q̇ = C q̇, so that the motion is the same, yet Ṁ − 2C' is not skew."""

    def C(self, q, qd):
        C = super().C(q, qd)
        h_qd1, h_qd2 = -C[..., 1, 0], C[..., 0, 0]
        other = np.zeros_like(C)
        other[..., 0, 1] = 2 * h_qd1 + h_qd2
        other[..., 1, 0] = -h_qd1
        return other


@a_few
@given(arms_and_states(planar_arms(), parts=3))
def test_a_valid_c_that_is_not_christoffel_is_not_skew(case):
    arm, q, qd, u = case
    qd = a_velocity_above(qd)
    elbow = np.full_like(q, 1.0)
    if abs(arm.lc2) < 0.05:
        return
    other = NotChristoffel(**{name: getattr(arm, name) for name in arm.__dataclass_fields__})
    np.testing.assert_allclose(
        other.inverse_dynamics(elbow, qd, u), arm.inverse_dynamics(elbow, qd, u), atol=1e-9
    )
    assert power_balance(other, elbow, qd, u).holds
    finding = skew_symmetry(other, elbow, qd)
    assert not finding.holds
    at, rate = finding.witness["q"], finding.witness["qd"]
    assert any(np.array_equal(rate, row) for row in qd.reshape(-1, 2))
    h = -arm.m2 * arm.l1 * arm.lc2 * np.sin(at[1])
    # N + Nᵀ as worked out by hand for this C'.
    expected = [[-4 * h * rate[1], -2 * h * rate[0]], [-2 * h * rate[0], 0]]
    expected = np.abs(expected)
    np.testing.assert_allclose(
        np.abs(finding.witness["N + Nᵀ"]), expected, rtol=1e-6, atol=1e-7 * np.max(expected)
    )


@dataclass(frozen=True)
class Reversed(Planar2R):
    def g_vec(self, q):
        return -super().g_vec(q)


@dataclass(frozen=True)
class Lopsided(Planar2R):
    def M(self, q):
        return super().M(q) + np.array([[0.0, 1e-9], [0.0, 0.0]])


@dataclass(frozen=True)
class Pushing(Planar2R):
    """Friction with the wrong sign in the equation of motion, the right one in f."""

    def dynamics(self, q, qd, u):
        return super().dynamics(q, qd, u + 2 * self.f_vec(qd))


@dataclass(frozen=True)
class Broken(Planar2R):
    def M(self, q):
        return np.where(np.asarray(q)[..., :1, None] > 0, np.nan, super().M(q))


def test_gravity_with_the_wrong_sign_is_found():
    arm = Reversed(**NUMBERS)
    finding = gravity_gradient(arm, [[0.3, 0.4], [np.pi / 2, 0.0]])
    assert not finding.holds
    np.testing.assert_array_equal(finding.witness["q"], [0.3, 0.4])
    np.testing.assert_allclose(finding.witness["g"], -finding.witness["gradient"], rtol=1e-8)
    assert not power_balance(arm, [0.3, 0.4], [1.0, 2.0], [0.0, 0.0]).holds


def test_an_inertia_that_is_not_symmetric_is_found():
    finding = symmetry(Lopsided(**NUMBERS), [0.3, 0.4])
    assert not finding.holds
    assert 1e-11 < finding.violation < 1e-8


def test_friction_that_pushes_is_found():
    arm = Pushing(**NUMBERS, viscous=(0.1, 0.1))
    assert power_balance(arm, [0.3, 0.4], [0.0, 0.0], [0.0, 0.0]).holds
    assert not power_balance(arm, [0.3, 0.4], [1.0, 2.0], [0.0, 0.0]).holds


def test_only_the_symmetric_part_decides_definiteness():
    class Twisted(Lopsided):
        def M(self, q):
            # Both triangles look harmless alone: the symmetric part has the eigenvalue −1.
            return np.array([[1.0, 4.0], [0.0, 1.0]]) + 0 * Planar2R.M(self, q)

    finding = positive_definiteness(Twisted(**NUMBERS), [0.3, 0.4])
    assert not finding.holds
    assert finding.witness["eigenvalue"] == pytest.approx(-1)


def test_the_worst_of_the_states_is_the_witness():
    arm = Planar2R(1, 1, lc1=0, lc2=0.5, m1=1, m2=1, I1=0, I2=0)
    q = np.array([[0.0, 1.0], [0.0, 0.0], [0.0, 2.0]])
    finding = positive_definiteness(arm, q)
    np.testing.assert_array_equal(finding.witness["q"], q[1])
    M = arm.M(q[1])
    idle = finding.witness["eigenvector"]
    np.testing.assert_allclose(M @ idle, 0, atol=1e-14)
    assert np.linalg.norm(idle) == pytest.approx(1)


def test_no_inertia_at_all_is_a_finding_not_a_crash():
    arm = Planar2R(1, 1, 0, 0, 0, 0, 0, 0)
    finding = positive_definiteness(arm, [[0.0, 0.0], [1.0, 1.0]])
    assert not finding.holds
    assert finding.witness["eigenvalue"] == 0
    assert symmetry(arm, [0.0, 0.0]).holds
    assert skew_symmetry(arm, [0.0, 0.0], [1.0, 1.0]).holds
    assert gravity_gradient(arm, [0.0, 0.0]).holds


def test_a_model_that_returns_nan_has_no_property():
    arm = Broken(**NUMBERS)
    q = [[-1.0, 0.0], [1.0, 0.5]]
    for finding in (symmetry(arm, q), positive_definiteness(arm, q)):
        assert not finding.holds
        np.testing.assert_array_equal(finding.witness["q"], [1.0, 0.5])


@pytest.mark.parametrize("q", [[0.5 * np.pi, np.pi], [0.0, 0.0]])
def test_no_false_alarm_where_potential_and_gravity_vanish(q):
    arm = Planar2R(1, 1, lc1=0, lc2=1, m1=1, m2=1, I1=0.1, I2=0.1)
    assert gravity_gradient(arm, q).holds
    assert power_balance(arm, q, [0.0, 0.0], [0.0, 0.0]).holds
    assert skew_symmetry(arm, q, [0.0, 0.0]).holds


@pytest.mark.parametrize("slow", [1e-12, 1e-109])
def test_no_false_alarm_where_friction_stops_a_slow_pendulum(slow):
    assert power_balance(Pendulum(1, 1, 2, g=0, coulomb=1), [0.0], [slow], [0.0]).holds


def test_a_finding_reads_as_a_sentence():
    good = str(skew_symmetry(Pendulum(1, 1, 1), [0.5], [2.0]))
    assert good.startswith("Ṁ − 2C is skew-symmetric: holds; 0.0e+00 against")
    bad = str(gravity_gradient(Reversed(**NUMBERS), [0.3, 0.4]))
    assert bad.startswith("g = ∂P/∂q: does not hold; ")
    assert "at q = [0.3 0.4]" in bad


@pytest.mark.parametrize("check", [symmetry, positive_definiteness, gravity_gradient])
def test_properties_name_bad_states(check):
    arm = Planar2R(**NUMBERS)
    with pytest.raises(ValueError, match=r"^q: got shape \(3,\)"):
        check(arm, [1.0, 2.0, 3.0])
    with pytest.raises(ValueError, match=r"^q: got shape \(0, 2\), needs at least 1 state"):
        check(arm, np.empty((0, 2)))
    with pytest.raises(ValueError, match=r"^q\[1\] = nan"):
        check(arm, [1.0, np.nan])
