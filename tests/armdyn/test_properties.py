from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from armdyn import Manipulator, Pendulum, Planar2R, PlanarChain
from armdyn.properties import (
    christoffel_form,
    gravity_gradient,
    inertia_rate,
    positive_definiteness,
    power_balance,
    skew_symmetry,
    symmetry,
)
from tests.armdyn.arms import a_few, arms_and_states, between, planar_arms, vectors
from tests.armdyn.chains import spatial_chains

NUMBERS = {"l1": 1, "l2": 0.8, "lc1": 0.5, "lc2": 0.4, "m1": 2, "m2": 1.5, "I1": 0.2, "I2": 0.1}


def a_velocity_above(qd, least=0.1):
    return np.where(np.abs(qd) < least, least, qd)


def findings(arm, q, qd, u):
    """Every property, for one arm."""
    form = christoffel_form(arm, q, qd)
    return (
        symmetry(arm, q),
        positive_definiteness(arm, q),
        skew_symmetry(arm, q, qd),
        inertia_rate(arm, q, qd),
        form,
        form.torque,
        gravity_gradient(arm, q),
        power_balance(arm, q, qd, u),
    )


def assert_all_hold(arm, q, qd, u):
    for finding in findings(arm, q, qd, u):
        assert finding.holds, f"{arm}\n{finding}"


@a_few
@given(arms_and_states())
def test_every_property_holds_for_every_arm(case):
    assert_all_hold(*case)


@a_few
@given(arms_and_states(spatial_chains(), parts=3))
def test_every_property_holds_for_spatial_chains(case):
    assert_all_hold(*case)


magnitudes = between(-3, 3).map(lambda exponent: 10.0**exponent)


@st.composite
def extreme_chains(draw):
    """Lengths, masses and inertias from 1e-3 to 1e3, each for itself, gravity too."""
    n = draw(st.integers(1, 5))
    every = st.tuples(*[magnitudes] * n)
    signs = st.tuples(*[st.sampled_from([-1.0, 1.0])] * n)
    lc = np.multiply(draw(every), draw(signs))
    return PlanarChain(
        *(draw(every), lc, draw(every), draw(every)),
        g=draw(magnitudes),
        ly=draw(every),
        viscous=draw(every),
    )


@a_few
@given(extreme_chains(), magnitudes, magnitudes, magnitudes, st.data())
def test_no_false_alarm_at_extreme_magnitudes(arm, far, fast, strong, data):
    q, qd, u = (data.draw(vectors(arm.n, size=1.0, batch=(3,))) for _ in range(3))
    assert_all_hold(arm, far * q, fast * qd, strong * u)


@a_few
@given(magnitudes, magnitudes, magnitudes, between(-6, 6), between(-6, 6))
def test_no_false_alarm_for_an_arm_that_counterweights_balance(l1, lc1, m2, q1, q2):
    # m1 lc1 + m2 l1 = 0 to rounding: P and g hold nothing else.
    arm = Planar2R(l1, 1, -lc1, 0, m2 * l1 / lc1, m2, 1, 1)
    assert_all_hold(arm, [q1, q2], [0.0, 0.0], [0.0, 0.0])
    assert_all_hold(arm, [q1, q2], [1e-6, 0.0], [0.0, 0.0])


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
class OtherSkew(Planar2R):
    """C q̇ is wrong by [q̇2, −q̇1], yet Ṁ − 2C is skew: the extra term is."""

    def C(self, q, qd):
        return super().C(q, qd) + np.array([[0.0, 1.0], [-1.0, 0.0]])


@dataclass(frozen=True)
class Transposed(Planar2R):
    def C(self, q, qd):
        return np.swapaxes(super().C(q, qd), -1, -2)


@dataclass(frozen=True)
class WrongInertia(Planar2R):
    """The right C to an M that does not turn with the elbow."""

    def M(self, q):
        return super().M(0 * np.asarray(q) + np.array([0.0, 1.0]))


STATE = [[0.3, 0.9], [1.2, -0.7]], [[1.0, -2.0], [0.5, 1.5]]


@pytest.mark.parametrize(
    ("model", "kind", "skew"),
    [
        (Planar2R, "Christoffel", True),
        (NotChristoffel, "merely valid", False),
        (OtherSkew, "neither", True),
        (Transposed, "neither", True),
        (WrongInertia, "neither", False),
    ],
)
def test_skew_and_christoffel_are_two_questions(model, kind, skew):
    arm = model(**NUMBERS)
    assert christoffel_form(arm, *STATE).kind == kind
    assert skew_symmetry(arm, *STATE).holds == skew
    assert inertia_rate(arm, *STATE).holds == skew


@a_few
@given(arms_and_states(planar_arms(), parts=2), between(0.05, 5))
def test_a_part_that_turns_no_joint_is_merely_valid(case, size):
    arm, q, qd = case
    qd = a_velocity_above(qd)

    class Idle(Planar2R):
        """C + w aᵀ with aᵀ q̇ = 0 has the same C q̇."""

        def C(self, q, qd):
            across = np.stack([-qd[..., 1], qd[..., 0]], axis=-1)[..., np.newaxis, :]
            return super().C(q, qd) + size * np.array([[1.0], [2.0]]) * across

    other = Idle(**{name: getattr(arm, name) for name in arm.__dataclass_fields__})
    form = christoffel_form(other, q, qd)
    assert form.kind == "merely valid", str(form)
    assert form.torque.holds
    assert not inertia_rate(other, q, qd).holds


def test_the_witness_of_the_christoffel_form_is_both_sides():
    form = christoffel_form(NotChristoffel(**NUMBERS), [0.3, 0.9], [1.0, -2.0])
    arm = Planar2R(**NUMBERS)
    np.testing.assert_allclose(form.witness["Σ h q̇"], arm.C([0.3, 0.9], [1.0, -2.0]), atol=1e-10)
    off = form.witness["C"] - form.witness["Σ h q̇"]
    np.testing.assert_allclose(off @ form.witness["qd"], 0, atol=1e-10)
    size = np.max(np.abs(off))
    M, qd = arm.M([0.3, 0.9]), form.witness["qd"]
    assert size / (np.max(np.abs(M)) * np.max(np.abs(qd))) > form.violation > 0.01 * size
    # One line for C itself, one for what it does.
    claim, torque = str(form).splitlines()
    assert claim.startswith("C = Σ h q̇: does not hold")
    assert torque.startswith("C q̇ = Σ h q̇ q̇: holds")


def test_the_rate_of_inertia_has_both_sides_as_witness():
    arm = NotChristoffel(**NUMBERS)
    finding = inertia_rate(arm, [0.3, 0.9], [1.0, -2.0])
    C = Planar2R(**NUMBERS).C([0.3, 0.9], [1.0, -2.0])
    np.testing.assert_allclose(finding.witness["Ṁ"], C + C.T, atol=1e-9)
    other = arm.C([0.3, 0.9], [1.0, -2.0])
    np.testing.assert_allclose(finding.witness["C + Cᵀ"], other + other.T, rtol=1e-14)


@dataclass(frozen=True)
class Reversed(Planar2R):
    # The arm's own solves the equation of motion without asking for g_vec.
    dynamics = Manipulator.dynamics

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
    form = christoffel_form(arm, q, np.ones(2))
    assert form.kind == "neither"
    for finding in (symmetry(arm, q), positive_definiteness(arm, q), form):
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


@pytest.mark.parametrize("check", [skew_symmetry, inertia_rate, christoffel_form])
def test_properties_name_bad_velocities(check):
    arm = Planar2R(**NUMBERS)
    with pytest.raises(ValueError, match=r"^qd: got shape \(3,\)"):
        check(arm, [1.0, 2.0], [1.0, 2.0, 3.0])
    with pytest.raises(ValueError, match=r"^q, qd: got shape \(0, 2\), needs at least 1 state"):
        check(arm, np.empty((0, 2)), [1.0, 2.0])
