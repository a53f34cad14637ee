import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from armdyn import Pendulum
from armdyn.simulate import simulate
from tests.armdyn.arms import (
    a_few,
    arms_and_states,
    assert_close,
    between,
    inertias,
    lengths,
    masses,
    pendulums,
)


@a_few
@given(arms_and_states(pendulums()))
def test_the_equation_of_motion(case):
    p, q, qd, qdd = case
    u = p.I * qdd + p.m * p.g * p.lc * np.sin(q) + p.viscous * qd + p.coulomb * np.sign(qd)
    size = p.I * 6 + p.m * p.g * p.lc + p.viscous * 6
    assert_close(p.inverse_dynamics(q, qd, qdd), u, size)
    assert_close(p.potential_energy(q), p.m * p.g * p.lc * (1 - np.cos(q[..., 0])), size)


@a_few
@given(masses, lengths, inertias)
def test_the_inertia_about_the_pivot_is_the_parallel_axis_theorem(m, lc, I_com):
    p = Pendulum.from_com(m, lc, I_com)
    # A swinging body: its centre moves at lc q̇ and it turns at q̇.
    assert_close(p.kinetic_energy([0.4], [3.0]), 0.5 * m * (3 * lc) ** 2 + 0.5 * I_com * 9)
    assert p == Pendulum(m, lc, I_com + m * lc**2)


@a_few
@given(masses, lengths)
def test_a_point_mass_is_allowed(m, lc):
    assert_close(Pendulum.from_com(m, lc, 0).M([0.0]), [[m * lc**2]])
    assert_close(Pendulum(m, lc, m * lc * lc).M([0.0]), [[m * lc**2]])


@a_few
@given(masses, lengths, between(0.01, 0.999))
def test_an_inertia_below_the_point_mass_is_refused(m, lc, part):
    with pytest.raises(ValueError, match=r"^I = .*at least m lc² = .*from_com"):
        Pendulum(m, lc, part * m * lc**2)


def test_an_inertia_about_the_centre_of_mass_is_explained():
    rod = {"m": 3.0, "lc": 0.5}
    with pytest.raises(ValueError, match=r"I = 0\.25: .* at least m lc² = 0\.75 kg·m²"):
        Pendulum(**rod, I=0.25)
    assert Pendulum.from_com(**rod, I_com=0.25).I == 1.0
    with pytest.raises(ValueError, match=r"^I_com = -1"):
        Pendulum.from_com(**rod, I_com=-1)


def test_friction_and_gravity_pass_through_from_com():
    p = Pendulum.from_com(1, 1, 1, g=1.62, viscous=0.1, coulomb=0.2)
    assert (p.g, p.viscous, p.coulomb) == (1.62, 0.1, 0.2)


@given(st.sampled_from([1, 1.0, np.float32(1), np.int64(1)]))
def test_parameters_are_kept_as_floats(one):
    p = Pendulum(one, one, 2 * one)
    assert p == Pendulum(1.0, 1.0, 2.0)
    assert hash(p) == hash(Pendulum(1.0, 1.0, 2.0))
    assert all(type(getattr(p, name)) is float for name in p.__dataclass_fields__)


def test_the_angle_is_from_hanging_down():
    p = Pendulum(2, 0.5, 0.7)
    assert p.g_vec([0.0])[0] == 0
    assert p.potential_energy([0.0]) == 0
    assert_close(p.g_vec([np.pi / 2]), [2 * 9.81 * 0.5])
    assert p.dynamics([0.1], [0.0], [0.0])[0] < 0 < p.dynamics([np.pi - 0.1], [0.0], [0.0])[0] * -1


@a_few
@given(masses, lengths, inertias)
def test_small_swings_have_the_linear_period(m, lc, I_com):
    p = Pendulum.from_com(m, lc, I_com)
    period = 2 * np.pi * np.sqrt(p.I / (m * p.g * lc))
    small = 1e-4
    t = np.linspace(0, period, 61)
    x = simulate(p.state_derivative, [small, 0.0], [0.0], t)
    assert np.max(np.abs(x[:, 0] - small * np.cos(2 * np.pi * t / period))) < 1e-3 * small
