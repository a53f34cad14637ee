"""Motors behind gears: what a SerialChain's `armature` adds, and where."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from armdyn import Link, SerialChain, reflected_inertia
from armdyn.regressor import armature_columns, parameters, regressor
from armdyn.simulate import simulate
from tests.armdyn.arms import a_few, arms_and_states, assert_close, inertias, masses, vectors
from tests.armdyn.chains import spatial_chains
from tests.armdyn.identities import assert_batches, assert_canonical

motors = spatial_chains(armature=inertias)


@a_few
@given(arms_and_states(motors))
def test_identities(case):
    assert_canonical(*case)


@a_few
@given(arms_and_states(motors))
def test_it_stands_on_the_diagonal_of_M_and_nowhere_else(case):
    arm, q, qd, z = case
    bare = replace(arm, armature=None)
    M = bare.M(q) + np.diag(arm.armature)
    assert_close(arm.M(q), M)
    assert_close(arm.crba(q), M)
    assert_close(arm.kinetic_energy(q, qd), bare.kinetic_energy(q, qd) + qd**2 @ arm.armature / 2)
    for method, arguments in (("C", (q, qd)), ("g_vec", (q,)), ("bias", (q, qd))):
        np.testing.assert_array_equal(
            getattr(arm, method)(*arguments), getattr(bare, method)(*arguments)
        )
    size = 36 * np.max(M) + np.max(np.abs(arm.g_vec(q)))
    u = bare.rnea(q, qd, z) + np.array(arm.armature) * z
    assert_close(arm.rnea(q, qd, z), u, size)
    assert_close(arm.inverse_dynamics(q, qd, z), u, size)
    worst = max(1e-12, 1e-14 * np.max(np.linalg.cond(M)))
    assert_close(arm.aba(q, qd, u), z, 36, worst)
    assert_close(arm.dynamics(q, qd, u), z, 36, worst)


@a_few
@given(arms_and_states(motors))
def test_a_batch_is_its_states_one_by_one(case):
    assert_batches(*case, {"M": ("q", 2), "crba": ("q", 2), "rnea": ("q qd z", 1)})


@a_few
@given(arms_and_states(spatial_chains(friction=st.just(0.0), armature=inertias)))
def test_its_columns_make_the_regressor_whole(case):
    arm, q, qd, z = case
    u = regressor(arm, q, qd, z) @ parameters(arm) + armature_columns(z) @ arm.armature
    assert_close(u, arm.rnea(q, qd, z), 100 * np.max(np.abs(arm.M(q))) + 1000)


def test_it_is_kept_as_a_value():
    links = (Link("revolute", 1.0), Link("prismatic", 2.0))
    arm = SerialChain(links, armature=np.array([1, 2]))
    assert arm.armature == (1.0, 2.0)
    assert arm == SerialChain(links, armature=[1.0, 2.0])
    assert hash(arm) == hash(SerialChain(links, armature=[1.0, 2.0]))
    assert arm != SerialChain(links) == SerialChain(links, armature=(0, 0))
    assert eval(repr(arm)) == arm


def test_a_motor_makes_a_massless_link_move():
    arm = SerialChain((Link("revolute", 0.0),), armature=[0.5])
    assert arm.aba([0], [0], [2]) == arm.dynamics([0], [0], [2]) == 4


@a_few
@given(masses, inertias)
def test_a_geared_pendulum_swings_more_slowly(m, armature):
    """Small swings: ω² = m g ℓ / (m ℓ² + a)."""
    rod = Link("revolute", m, com=(1, 0, 0), rotation=((0, 0, 1), (0, 1, 0), (-1, 0, 0)))
    arm = SerialChain((rod,), armature=[armature])
    omega = np.sqrt(9.81 * m / (m + armature))
    t = np.linspace(0, 1 / omega, 3)
    x = simulate(arm.state_derivative, [1e-4, 0], [0.0], t, method="DOP853")
    np.testing.assert_allclose(x[:, 0], 1e-4 * np.cos(omega * t), rtol=1e-5)


@a_few
@given(vectors(3), st.tuples(*[inertias] * 3))
def test_the_rotor_has_the_energy_of_its_own_spin(ratio, rotor):
    armature = reflected_inertia(rotor, ratio)
    qd = np.array([0.3, -2, 1])
    assert_close(armature @ qd**2, np.array(rotor) @ (ratio * qd) ** 2)
    np.testing.assert_array_equal(armature, reflected_inertia(rotor, -ratio))


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ((-1.0, 2), r"^rotor_inertia = -1\.0: must not be negative"),
        (([1, np.nan], 2), r"^rotor_inertia\[1\] = nan"),
        ((1, "100:1"), r"^gear_ratio = '100:1'"),
        (([1, 2], [1, 2, 3]), r"^rotor_inertia \(2,\), gear_ratio \(3,\): needs shapes"),
    ],
)
def test_a_bad_motor_is_named(arguments, says):
    with pytest.raises(ValueError, match=says):
        reflected_inertia(*arguments)


@pytest.mark.parametrize(
    ("armature", "says"),
    [
        ([1, 2], r"^armature = \[1, 2\]: needs 1 numbers, one per joint, in kg·m² or kg"),
        ([-1], r"^armature\[0\] = -1: must not be negative"),
        (0.1, r"^armature = 0\.1"),
    ],
)
def test_a_bad_armature_is_named(armature, says):
    with pytest.raises(ValueError, match=says):
        SerialChain((Link("revolute", 1.0),), armature=armature)


@pytest.mark.parametrize("bad", [None, [np.inf], "a", 1.0])
def test_a_bad_acceleration_is_named(bad):
    with pytest.raises(ValueError, match=r"^qdd"):
        armature_columns(bad)
