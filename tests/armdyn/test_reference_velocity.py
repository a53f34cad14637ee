"""Y with a reference velocity, and what it is for: the adaptive controller of Slotine and Li."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given

from armdyn import Link, Planar2R, SerialChain
from armdyn.regressor import parameters, regressor
from armdyn.spatial import rotation
from tests.armdyn.arms import a_few, arms_and_states, assert_close, between
from tests.armdyn.linked_arms import any_arm

PLANAR = Planar2R(1.0, 0.8, 0.5, 0.4, 3, 2, 0.25, 0.11)
BODY = {"mass": 2.0, "com": (0.1, 0.2, -0.1), "inertia": np.diag([0.2, 0.3, 0.25])}
SPATIAL = SerialChain(
    (
        Link("revolute", **BODY),
        Link("revolute", **BODY, rotation=rotation((1, 0, 0), 1.2), translation=(0.3, 0.0, 0.4)),
        Link("prismatic", **BODY, rotation=rotation((0, 1, 0), 0.8), translation=(0.0, 0.2, 0.1)),
    )
)


@a_few
@given(arms_and_states(any_arm, parts=4))
def test_y_with_a_reference_velocity_has_the_christoffel_c(case):
    arm, q, qd, qd_ref, qdd_ref = case
    Y, pi = regressor(arm, q, qd, qdd_ref, qd_ref), parameters(arm)
    terms = (np.matvec(arm.M(q), qdd_ref), np.matvec(arm.C(q, qd), qd_ref), arm.g_vec(q))
    assert_close(Y @ pi, sum(terms), max(1, np.max(np.abs(Y) @ np.abs(pi))))


@a_few
@given(arms_and_states(any_arm, parts=4), between(-3, 3))
def test_linear_in_the_reference_velocity_and_symmetric(case, factor):
    arm, q, qd, qd_ref, qdd = case
    without = regressor(arm, q, qd, qdd, 0 * qd)
    once, more = (regressor(arm, q, qd, qdd, f * qd_ref) for f in (1, factor))
    assert_close(more - without, factor * (once - without), np.max(np.abs(once)) * 4)
    assert_close(regressor(arm, q, qd_ref, qdd, qd), once)
    np.testing.assert_array_equal(regressor(arm, q, qd, qdd, qd), regressor(arm, q, qd, qdd))


def test_a_small_reference_velocity_keeps_its_digits():
    # Formed as a difference of squares, C q̇r would lose what q̇ is larger by.
    q, qd, qd_ref = np.random.default_rng(0).normal(size=(3, 3))
    still = np.zeros(3)
    rows = regressor(SPATIAL, q, 1e6 * qd, still, 1e-6 * qd_ref) - regressor(
        SPATIAL, q, qd, still, still
    )
    np.testing.assert_allclose(rows @ parameters(SPATIAL), SPATIAL.C(q, qd) @ qd_ref, rtol=1e-12)


def test_shapes_of_the_reference_velocity():
    q, qd, qdd = np.random.default_rng(1).normal(size=(3, 2))
    many = np.random.default_rng(2).normal(size=(5, 2))
    Y = regressor(PLANAR, q, qd, qdd, many)
    assert Y.shape == (5, 2, 8)
    np.testing.assert_allclose(Y[3], regressor(PLANAR, q, qd, qdd, many[3]), atol=1e-14)
    with pytest.raises(ValueError, match=r"^qd_ref: got shape \(3,\), needs real numbers"):
        regressor(PLANAR, q, qd, qdd, [0.0, 0.0, 0.0])
    with pytest.raises(ValueError, match=r"^qd_ref\[0\] = nan"):
        regressor(PLANAR, q, qd, qdd, [np.nan, 0.0])


def with_payload(arm, mass):
    """The arm with a point mass at the end of its last link, which its controller knows nothing of."""
    if isinstance(arm, Planar2R):
        total = arm.m2 + mass
        lc2 = (arm.m2 * arm.lc2 + mass * arm.l2) / total
        about = arm.m2 * (lc2 - arm.lc2) ** 2 + mass * (arm.l2 - lc2) ** 2
        return replace(arm, m2=total, lc2=lc2, I2=arm.I2 + about)
    *others, last = arm.links
    return replace(arm, links=(*others, replace(last, mass=last.mass + mass)))


class Adaptive:
    """u = Y π̂ − D s with π̂' = −Γ Yᵀ s, s = q̇ − q̇r, q̇r = q̇d + Λ (qd − q): the law of 1987.

    Simulated in closed loop on the arm with its payload, from π̂ without. The state is [q; q̇; π̂].
    """

    def __init__(self, arm, payload, gain=0.5):
        self.true, self.n = with_payload(arm, payload), arm.n
        self.start = parameters(arm)
        self.Lambda, self.D, self.gain = 3.0, 8.0, gain

    def sliding(self, t, q, qd):
        rates = np.arange(1, self.n + 1) * 1.1
        aim, aim_d, aim_dd = (
            0.5 * np.sin(rates * t),
            0.5 * rates * np.cos(rates * t),
            -0.5 * rates**2 * np.sin(rates * t),
        )
        qd_ref = aim_d + self.Lambda * (aim - q)
        return qd - qd_ref, qd_ref, aim_dd + self.Lambda * (aim_d - qd)

    def rate(self, t, x):
        q, qd, guess = np.split(x, [self.n, 2 * self.n])
        s, qd_ref, qdd_ref = self.sliding(t, q, qd)
        Y = regressor(self.true, q, qd, qdd_ref, qd_ref)
        u = Y @ guess - self.D * s
        return np.concatenate([qd, self.true.dynamics(q, qd, u), -self.gain * Y.T @ s])

    def lyapunov(self, t, x):
        """V = ½ sᵀ M s + ½ π̃ᵀ Γ⁻¹ π̃, and V̇ = −sᵀ D s as the proof has it."""
        q, qd, guess = np.split(x, [self.n, 2 * self.n])
        s = self.sliding(t, q, qd)[0]
        wrong = guess - parameters(self.true)
        return s @ self.true.M(q) @ s / 2 + wrong @ wrong / (2 * self.gain), -self.D * s @ s


@pytest.mark.parametrize("arm", [PLANAR, SPATIAL], ids=["planar", "spatial"])
def test_the_adaptive_law_never_raises_its_lyapunov_function(arm):
    law, dt = Adaptive(arm, payload=1.5), 8e-3
    x = np.concatenate([np.full(arm.n, 0.4), np.zeros(arm.n), law.start])
    times = dt * np.arange(101)
    values, slopes = [], []
    for t in times:
        V, slope = law.lyapunov(t, x)
        values.append(V)
        slopes.append(slope)
        k1 = law.rate(t, x)
        k2 = law.rate(t + dt / 2, x + dt / 2 * k1)
        k3 = law.rate(t + dt / 2, x + dt / 2 * k2)
        k4 = law.rate(t + dt, x + dt * k3)
        x = x + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    assert np.max(np.diff(values)) <= 1e-9 * values[0]
    # And it falls as the proof says, in which M and C alone matter: Ṁ − 2C is skew.
    fallen = np.concatenate([[0], np.cumsum((np.array(slopes)[1:] + slopes[:-1]) / 2 * dt)])
    np.testing.assert_allclose(np.array(values) - values[0], fallen, atol=1e-4 * values[0])
    assert values[-1] < 0.9 * values[0]
