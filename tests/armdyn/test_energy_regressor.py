import numpy as np
import pytest
from hypothesis import given

from armdyn import Pendulum, Planar2R
from armdyn.base_parameters import base_parameters
from armdyn.energy_regressor import (
    energy_regressor,
    kinetic_energy_regressor,
    potential_energy_regressor,
)
from armdyn.regressor import friction_columns, parameters, regressor
from tests.armdyn.arms import a_few, arms_and_states, assert_close, rate
from tests.armdyn.linked_arms import any_arm
from tests.armdyn.puma import puma_560

ARM = Planar2R(1.3, 0.8, 0.5, 0.4, 2, 1.5, 0.2, 0.1, viscous=(0.3, 0.2), coulomb=(0.1, 0.05))


@a_few
@given(arms_and_states(any_arm, parts=2))
def test_rows_times_parameters_are_the_energies(case):
    arm, q, qd = case
    pi = parameters(arm)
    K, P = kinetic_energy_regressor(arm, q, qd), potential_energy_regressor(arm, q)
    assert K.shape == P.shape == (*q.shape[:-1], len(pi))
    # The size of the terms, which may cancel.
    size = np.max(np.abs(K) @ np.abs(pi)) + np.max(np.abs(P) @ np.abs(pi)) + 20 * np.sum(np.abs(pi))
    assert_close(K @ pi, arm.kinetic_energy(q, qd), size)
    assert_close(P @ pi, arm.potential_energy(q), size)
    np.testing.assert_array_equal(energy_regressor(arm, q, qd), K + P)


@a_few
@given(arms_and_states(any_arm))
def test_energy_rises_by_the_power_of_the_joints(case):
    # d/dt (Y_E π) = q̇ᵀ Y π for each π: the two regressors are one equation, column by column.
    arm, q, qd, qdd = case
    E_dot = rate(
        lambda x: energy_regressor(arm, *np.split(x, 2, axis=-1)),
        np.concatenate([q, qd], axis=-1),
        np.concatenate([qd, qdd], axis=-1),
    )
    Y = regressor(arm, q, qd, qdd)
    size = np.max(np.abs(qd), initial=1) * np.max(np.abs(Y), initial=1) * 10
    assert_close(E_dot, np.vecmat(qd, Y), size, 1e-8)


def test_work_less_friction_is_the_rise_of_energy():
    # Along a motion: ∫ q̇ᵀ (u − f) dt = E(end) − E(start), without any acceleration in E.
    t = np.linspace(0, 2, 4001)[:, np.newaxis]
    phase = np.array([2.0, 3.1]) * t + [0.3, 1.0]
    q, qd, qdd = np.sin(phase), np.cos(phase) * [2.0, 3.1], -np.sin(phase) * [2.0**2, 3.1**2]
    u = ARM.inverse_dynamics(q, qd, qdd)
    power = np.vecdot(qd, u)
    lost = np.vecdot(qd, friction_columns(qd) @ np.ravel([ARM.viscous, ARM.coulomb]))
    row = energy_regressor(ARM, q[[0, -1]], qd[[0, -1]])
    rise = (row[1] - row[0]) @ parameters(ARM)
    assert np.trapezoid(power - lost, t[:, 0]) == pytest.approx(rise, rel=1e-5)


@pytest.mark.parametrize("arm", [ARM, puma_560()], ids=["2r", "puma"])
def test_differences_of_energy_show_what_torques_show(arm):
    # The motors see a rise of E and never its zero.
    q, qd = np.random.default_rng(1).normal(size=(2, 300, arm.n))
    rows = energy_regressor(arm, q, qd)
    base = base_parameters(arm)
    assert np.linalg.matrix_rank(rows[1:] - rows[0], tol=1e-9) == base.rank
    again = rows[:, list(base.independent)] @ base.combination
    np.testing.assert_allclose(np.diff(again, axis=0), np.diff(rows, axis=0), atol=1e-9)


def test_the_energy_of_a_pendulum_is_zero_at_rest():
    arm = Pendulum(2, 0.5, 0.7)
    assert not energy_regressor(arm, [0.0], [0.0]).any()
    # A quarter turn up: m g lc, by hand.
    row = energy_regressor(arm, [np.pi / 2], [3.0])
    np.testing.assert_allclose(row, [0, 9.81, 9.81, 4.5], atol=1e-14)


def test_batch_axes_broadcast():
    rng = np.random.default_rng(0)
    q, qd = rng.normal(size=(4, 1, 2)), rng.normal(size=(3, 2))
    row = energy_regressor(ARM, q, qd)
    assert row.shape == (4, 3, 8)
    np.testing.assert_allclose(row[2, 1], energy_regressor(ARM, q[2, 0], qd[1]), atol=1e-14)


def test_bad_arguments_are_named():
    with pytest.raises(ValueError, match=r"^qd: got shape \(3,\), needs real numbers"):
        energy_regressor(ARM, [0.0, 0.0], [0.0, 0.0, 0.0])
    with pytest.raises(ValueError, match=r"^q\[1\] = nan"):
        potential_energy_regressor(ARM, [0.0, np.nan])
    with pytest.raises(ValueError, match=r"^model: got str, needs a Pendulum"):
        kinetic_energy_regressor("arm", [0.0], [0.0])
