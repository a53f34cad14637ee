"""The inertia of motors, estimated with that of the links."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from armdyn import Link, SerialChain
from armdyn.base_parameters import base_parameters, motors_apart
from armdyn.consistency import consistent_parameters
from armdyn.geometry import reach
from armdyn.identify import excitation, identify
from armdyn.regressor import armature_columns, parameters, regressor
from tests.armdyn.arms import a_few, assert_close, inertias
from tests.armdyn.chains import spatial_chains
from tests.armdyn.puma import puma_560

ARMATURE = (1.1, 4.7, 0.9, 0.2, 0.18, 0.19)


def motion(n, samples=200):
    return np.random.default_rng(5).uniform(-2, 2, size=(3, samples, n))


@settings(a_few, max_examples=10)
@given(spatial_chains(most=3, friction=st.just(0.0), armature=inertias))
def test_each_armature_is_seen_alone_or_in_a_base_parameter(arm):
    q, qd, qdd = motion(arm.n, 20)
    base = base_parameters(arm, tolerance=0)
    joints, shares = motors_apart(arm, base)
    # A first slide along gravity shows its links' mass by their weight.
    assert 0 not in joints or arm.links[0].joint == "prismatic"
    seen = np.concatenate([base.combination @ parameters(arm), np.zeros(len(joints))])
    seen += shares @ arm.armature
    Y = regressor(arm, q, qd, qdd)[..., list(base.independent)]
    columns = np.concatenate([Y, armature_columns(qdd)[..., joints]], axis=-1)
    u = arm.inverse_dynamics(q, qd, qdd)
    assert_close(columns @ seen, u, np.max(np.abs(columns)) * np.max(np.abs(seen)), 1e-6)


def test_the_motors_of_a_puma():
    arm = replace(puma_560(), armature=ARMATURE, viscous=(1.0,) * 6)
    q, qd, qdd = motion(6)
    u = arm.inverse_dynamics(q, qd, qdd)
    found = identify(arm, q, qd, qdd, u, friction=True, armature=True)
    told = dict(zip((f"armature{j}" for j in range(1, 7)), ARMATURE, strict=True))
    assert 3 <= len(found.armature) < 6
    for name, value in found.armature.items():
        np.testing.assert_allclose(value, told[name], rtol=1e-6)
    for name in told.keys() - found.armature.keys():
        assert any(f"+ {name}" in other for other in found.names)
    np.testing.assert_allclose(found.friction, [1.0] * 6 + [0.0] * 6, atol=1e-6)
    assert found.residual < 1e-8
    assert excitation(arm, q, qd, qdd, friction=True, armature=True).names == found.names
    # Without its columns, motors that the model does not know of do not fit.
    bare = replace(arm, armature=None)
    assert identify(bare, q, qd, qdd, u, friction=True).residual > 1e-2


def test_bodies_exist_beside_motors_that_torque_does_not_show_alone():
    # The arm's own links and motors are an example, though no link alone has the sums.
    arm = replace(puma_560(), armature=ARMATURE)
    q, qd, qdd = motion(6)
    found = identify(arm, q, qd, qdd, arm.inverse_dynamics(q, qd, qdd), armature=True)
    assert found.consistent
    joints, shares = motors_apart(arm, found.base)
    sums = found.base.combination @ found.consistency.parameters
    sums += np.delete(shares[: found.base.rank], joints, axis=1) @ found.consistency.motors
    np.testing.assert_allclose(sums, found.estimate[: found.base.rank], atol=1e-8)
    assert np.all(found.consistency.motors > 0)
    alone = (found.base.combination, found.estimate[: found.base.rank], found.base.columns)
    assert not consistent_parameters(*alone, arm.n, reach(arm)).exists


def test_no_motor_makes_up_for_a_negative_inertia():
    arm = replace(puma_560(), armature=ARMATURE)
    q, qd, qdd = motion(6)
    u = arm.inverse_dynamics(q, qd, qdd) - 20 * armature_columns(qdd)[..., 1]
    assert not identify(arm, q, qd, qdd, u, armature=True).consistent


@settings(a_few, max_examples=10)
@given(spatial_chains(most=3, armature=inertias))
def test_a_known_armature_changes_no_parameter(arm):
    """It is the model's, and its torque is no torque of the links."""
    arm = replace(arm, gravity=(0.0, 0.0, -9.81))
    bare = replace(arm, armature=None)
    q, qd, qdd = motion(arm.n, 60)
    # Not with every digit of the geometry believed: axes that are all but parallel show only rounding.
    assume(excitation(arm, q, qd, qdd, friction=True).condition < 1e4)
    with_motors, without = (
        identify(a, q, qd, qdd, a.inverse_dynamics(q, qd, qdd), friction=True) for a in (arm, bare)
    )
    size = max(1.0, np.max(np.abs(without.estimate)))
    assert with_motors.names == without.names
    assert_close(with_motors.estimate, without.estimate, size, 1e-8)


@pytest.mark.parametrize("length", [1e-4, 1.0, 1e4])
def test_a_motor_acts_like_a_mass_at_any_length(length):
    # About upright axes, a mass on joint 2 loads joint 1 by length², and joint 2 not at all.
    link = Link("revolute", 1.0, inertia=np.eye(3))
    arm = SerialChain((link, replace(link, translation=(length, 0.0, 0.0))))
    joints, shares = motors_apart(arm, base_parameters(arm, columns=(10,)))
    np.testing.assert_array_equal(joints, [1])
    np.testing.assert_allclose(shares, [[length**-2, 0], [0, 1]], rtol=1e-9)


@pytest.mark.parametrize("bad", [ARMATURE, "yes", 1, None])
def test_the_choice_is_true_or_false(bad):
    arm = puma_560()
    states = motion(6)
    with pytest.raises(ValueError, match=r"^armature = .*: needs True to estimate it or False"):
        excitation(arm, *states, armature=bad)
    with pytest.raises(ValueError, match=r"^armature = .*: needs True to estimate it or False"):
        identify(arm, *states, arm.inverse_dynamics(*states), armature=bad)


@pytest.mark.parametrize("bad", [np.ones(36), np.ones((35, 1)), np.full((36, 1), np.nan), "two"])
def test_bad_motors_of_consistency_are_named(bad):
    base = base_parameters(puma_560())
    estimate = base.combination @ parameters(puma_560())
    with pytest.raises(ValueError, match=r"^motors"):
        consistent_parameters(base.combination, estimate, base.columns, 6, motors=bad)


def test_rounded_angles_tell_no_motor_from_its_link():
    exact = puma_560()
    joints, _ = motors_apart(exact, base_parameters(exact))
    for digits in (4, 6):
        rounded = puma_560(digits)
        np.testing.assert_array_equal(motors_apart(rounded, base_parameters(rounded))[0], joints)


def test_a_single_joint_shows_one_sum():
    arm = SerialChain((Link("revolute", 0.0, inertia=np.eye(3)),), armature=[0.5])
    q, qd, qdd = motion(1)
    found = identify(arm, q, qd, qdd, arm.inverse_dynamics(q, qd, qdd), armature=True)
    assert found.armature == {}
    (own,) = (k for k, name in enumerate(found.names) if name.startswith("Jzz1"))
    assert found.names[own] == "Jzz1 + armature1"
    np.testing.assert_allclose(found.estimate[own], 1.5)


@pytest.mark.parametrize("armature", [True, False])
@pytest.mark.parametrize("friction", [True, False])
def test_torque_of_a_motion_that_was_not_fitted(armature, friction):
    rubbed = {"viscous": (1.0,) * 3, "coulomb": (0.5,) * 3} if friction else {}
    arm = SerialChain(puma_560().links[:3], armature=ARMATURE[:3], **rubbed)
    q, qd, qdd = motion(3, 60)
    u = arm.inverse_dynamics(q, qd, qdd)
    found = identify(arm, q, qd, qdd, u, friction=friction, armature=armature)
    other = np.random.default_rng(6).uniform(-3, 3, size=(3, 2, 5, 3))
    assert found.torque(*other).shape == (2, 5, 3)
    np.testing.assert_allclose(found.torque(*other), arm.inverse_dynamics(*other), atol=1e-6)
    with pytest.raises(ValueError, match="qd"):
        found.torque(other[0], other[1][..., :2], other[2])
