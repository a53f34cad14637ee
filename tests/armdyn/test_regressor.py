from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from armdyn import Link, Manipulator, Pendulum, Planar2R, PlanarChain, SerialChain
from armdyn.base_parameters import on_link_axes
from armdyn.friction import joint_friction
from armdyn.regressor import friction_columns, parameter_names, parameters, regressor
from tests.armdyn.arms import (
    a_few,
    arms,
    arms_and_states,
    assert_close,
    between,
    vectors,
)
from tests.armdyn.chains import spatial
from tests.armdyn.linked_arms import any_arm, planar_chains

ARM_COLUMNS = ("m1", "m1 cx1", "m1 cy1", "J1", "m2", "m2 cx2", "m2 cy2", "J2")
ARM = Planar2R(l1=1.3, l2=0.8, lc1=0.5, lc2=0.4, m1=2, m2=1.5, I1=0.2, I2=0.1)


def assert_linear(arm, q, qd, qdd):
    Y, pi = regressor(arm, q, qd, qdd), parameters(arm)
    assert Y.shape == (*np.shape(q), len(pi))
    assert len(parameter_names(arm)) == len(pi)
    # The size of the terms, which may cancel.
    size = max(1, np.max(np.abs(Y) @ np.abs(pi)))
    assert_close(Y @ pi + arm.f_vec(qd), arm.inverse_dynamics(q, qd, qdd), size)


@a_few
@given(arms_and_states(any_arm))
def test_regressor_times_parameters_is_the_equation_of_motion(case):
    assert_linear(*case)


def varied(arm, factor):
    """The same geometry, other bodies."""
    if isinstance(arm, SerialChain):
        links = (
            replace(
                link,
                mass=factor * link.mass,
                com=np.add(link.com, [0.1, 0.2, -0.3]),
                inertia=np.array(link.inertia) * factor + 0.1 * np.eye(3),
            )
            for link in arm.links
        )
        return replace(arm, links=tuple(links))
    names = [name for name in ("m1", "m2", "m", "I1", "I2", "I") if hasattr(arm, name)]
    return replace(
        arm, **{name: np.multiply(factor, getattr(arm, name)).tolist() for name in names}
    )


@a_few
@given(arms_and_states(any_arm), between(1.1, 3))
def test_the_regressor_holds_geometry_alone(case, factor):
    arm, q, qd, qdd = case
    other = varied(arm, factor)
    assert not np.array_equal(parameters(other), parameters(arm))
    np.testing.assert_array_equal(regressor(other, q, qd, qdd), regressor(arm, q, qd, qdd))
    assert_linear(other, q, qd, qdd)


@a_few
@given(planar_chains(), st.data())
def test_the_plane_is_a_part_of_space(arm, data):
    q, qd, qdd = (data.draw(vectors(arm.n)) for _ in range(3))
    in_space = spatial(arm)
    Y = regressor(in_space, q, qd, qdd)
    names = parameter_names(in_space)
    # In space, J of the plane is Jzz; nothing out of the plane loads a joint.
    same = [j for j, name in enumerate(names) if name.startswith(("m", "Jzz")) and "cz" not in name]
    assert_close(Y[:, same], regressor(arm, q, qd, qdd))
    assert_close(parameters(in_space)[same], parameters(arm))
    others = np.setdiff1d(np.arange(len(names)), same)
    assert np.max(np.abs(Y[:, others])) <= 1e-12 * max(1, np.max(np.abs(Y)))


@a_few
@given(arms_and_states(any_arm))
def test_a_joint_is_loaded_by_its_own_link_and_those_after(case):
    arm, q, qd, qdd = case
    per_link = len(parameters(arm)) // arm.n
    blocks = regressor(arm, q, qd, qdd).reshape(*q.shape, arm.n, per_link)
    for joint in range(arm.n):
        assert not blocks[..., joint, :joint, :].any()


@pytest.mark.parametrize(
    "arm", [ARM, Pendulum(1, 0.5, 1), PlanarChain((1, 1, 1), (0.5,) * 3, (1,) * 3, (0.1,) * 3)]
)
def test_batch_axes_broadcast(arm):
    rng = np.random.default_rng(1)
    q, qd, qdd = (rng.normal(size=(*batch, arm.n)) for batch in ((4, 1), (3,), (4, 3)))
    Y = regressor(arm, q, qd, qdd)
    assert Y.shape == (4, 3, arm.n, 4 * arm.n)
    np.testing.assert_allclose(Y[2, 1], regressor(arm, q[2, 0], qd[1], qdd[2, 1]), atol=1e-14)


def test_parameters_of_the_2r_by_hand():
    pi = [2, 1.0, 0, 0.2 + 2 * 0.25, 1.5, 0.6, 0, 0.1 + 1.5 * 0.16]
    np.testing.assert_allclose(parameters(ARM), pi, rtol=1e-15)
    assert parameter_names(ARM) == ARM_COLUMNS


def test_parameters_of_a_body_in_space_are_integrals_over_it():
    # Point masses: Σ m (|x|² 1 − x xᵀ) about the origin of the frame needs no theorem.
    rng = np.random.default_rng(2)
    mass, x = rng.uniform(0.1, 1, 6), rng.normal(size=(6, 3))
    about = sum(m * (p @ p * np.eye(3) - np.outer(p, p)) for m, p in zip(mass, x, strict=True))
    com = mass @ x / mass.sum()
    central = about - mass.sum() * (com @ com * np.eye(3) - np.outer(com, com))
    link = Link("revolute", mass.sum(), com=com, inertia=(central + central.T) / 2)
    expected = [mass.sum(), *(mass @ x), *about[[0, 0, 1, 0, 1, 2], [0, 1, 1, 2, 2, 2]]]
    np.testing.assert_allclose(parameters(SerialChain((link,))), expected, atol=1e-13)
    names = ("m1", "m1 cx1", "m1 cy1", "m1 cz1", "Jxx1", "Jxy1", "Jyy1", "Jxz1", "Jyz1", "Jzz1")
    assert parameter_names(SerialChain((link,))) == names


@a_few
@given(arms_and_states(arms(), parts=1))
def test_friction_has_its_own_columns(case):
    arm, qd = case
    coefficients = np.ravel([arm.viscous, arm.coulomb])
    np.testing.assert_allclose(friction_columns(qd) @ coefficients, arm.f_vec(qd), atol=1e-14)


def test_friction_is_no_inertial_parameter():
    arm = replace(ARM, viscous=(0.3, 0.2), coulomb=(0.1, 0.2))
    q, qd, qdd = np.random.default_rng(3).normal(size=(3, 50, 2))
    np.testing.assert_array_equal(parameters(arm), parameters(ARM))
    # No π explains the friction: it is outside the span of Y.
    Y = regressor(arm, q, qd, qdd).reshape(100, 8)
    f = joint_friction(qd, arm.viscous, arm.coulomb).ravel()
    rest = f - Y @ np.linalg.lstsq(Y, f, rcond=None)[0]
    assert np.linalg.norm(rest) > 0.5 * np.linalg.norm(f)


def test_linear_in_pi_and_not_in_lc():
    # Trap 5: at a fixed mass and inertia about the centre of mass, lc enters by its square.
    state = [0.3, 0.4], [1.0, 2.0], [0.5, -0.7]
    u = [replace(ARM, lc2=lc2).inverse_dynamics(*state) for lc2 in (0.3, 0.4, 0.5)]
    assert np.max(np.abs(u[0] - 2 * u[1] + u[2])) > 1e-3
    pi = [parameters(ARM) + step * np.arange(8) for step in (-1, 0, 1)]
    u = [regressor(ARM, *state) @ p for p in pi]
    np.testing.assert_allclose(u[0] - 2 * u[1] + u[2], 0, atol=1e-12)


def test_bad_arguments_are_named():
    class Other(Manipulator):
        n = 1
        M = C = g_vec = potential_energy = None

    with pytest.raises(ValueError, match=r"^model: got Other, needs a Pendulum"):
        regressor(Other(), [0.0], [0.0], [0.0])
    with pytest.raises(ValueError, match=r"^model: got Other, needs a Pendulum"):
        parameters(Other())
    with pytest.raises(ValueError, match=r"^model: got SerialChain, needs a planar arm"):
        on_link_axes(SerialChain((Link("revolute", 1.0),)))
    with pytest.raises(ValueError, match=r"^qd: got shape \(3,\), needs real numbers"):
        regressor(ARM, [0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0])
    with pytest.raises(ValueError, match=r"^qdd\[0\] = nan"):
        regressor(ARM, [0.0, 0.0], [0.0, 0.0], [np.nan, 0.0])
    with pytest.raises(ValueError, match="needs batch axes that broadcast"):
        regressor(ARM, np.zeros((3, 2)), np.zeros((2, 2)), [0.0, 0.0])
    for bad in (1.0, None, [np.inf, 0.0]):
        with pytest.raises(ValueError, match=r"^qd"):
            friction_columns(bad)


class Geared(Planar2R):
    """Motors add to M, and no column of Y says so."""

    def M(self, q):
        return super().M(q) + 0.3 * np.eye(2)


class Sticky(Planar2R):
    """Other friction, which is none of Y's business."""

    def f_vec(self, qd):
        return np.tanh(qd)


def test_an_arm_with_an_m_of_its_own_is_refused_and_not_given_a_wrong_y():
    state = [0.3, 0.4], [1.0, 2.0], [0.5, -0.7]
    names = ("l1", "l2", "lc1", "lc2", "m1", "m2", "I1", "I2")
    geared, sticky = (kind(*(getattr(ARM, name) for name in names)) for kind in (Geared, Sticky))
    with pytest.raises(ValueError, match=r"^model: this Geared has its own M"):
        regressor(geared, *state)
    assert_linear(sticky, *(np.array(part) for part in state))
