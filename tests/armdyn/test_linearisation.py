"""Slopes of the dynamics: against symbols, against differences of the motion, and against C."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from armdyn import Manipulator, Pendulum, Planar2R
from armdyn.codegen import NumpyModel, numpy_model
from armdyn.derive.derivation import from_inertia
from armdyn.linearisation import forward_dynamics_slopes, inverse_dynamics_slopes, linearise
from armdyn.properties import christoffel_form
from tests.armdyn.arms import a_few, arms, arms_and_states, assert_close, rate
from tests.armdyn.chains import spatial_chains
from tests.armdyn.derivations import EXAMPLES, numbers, states, values

smooth = arms(coulomb=st.just(0.0)) | spatial_chains(3, friction=st.just(0.0))


def jacobian(function, x):
    return np.stack([rate(function, x, e, h=1e-2) for e in np.eye(x.shape[-1])], axis=-1)


@a_few
@given(arms_and_states(smooth, parts=2))
def test_christoffel_symbols_are_those_of_m(case):
    model, q, qd = case
    h = model.christoffel_symbols(q)
    assert h.shape == (*q.shape, model.n, model.n)
    size = np.max(np.abs(model.M(q)))
    dM = np.stack([rate(model.M, q, axis) for axis in np.eye(model.n)], axis=-1)
    needed = 0.5 * (dM + np.swapaxes(dM, -1, -2) - np.moveaxis(dM, -1, -3))
    assert_close(h, needed, 10 * size, 1e-10)
    assert_close(h, np.swapaxes(h, -1, -2), 10 * size, 1e-12)
    assert_close(np.einsum("...ijk,...k->...ij", h, qd), model.C(q, qd), 60 * size, 1e-12)
    assert christoffel_form(model, q, qd).kind == "Christoffel"


class Plain(Manipulator):
    """What a model says of its motion, and nothing of where that comes from."""

    def __init__(self, model):
        self.n = model.n
        for name in ("M", "C", "g_vec", "f_vec", "potential_energy"):
            setattr(self, name, getattr(model, name))

    M = C = g_vec = potential_energy = None  # set above


class Weightless(NumpyModel):
    def g_vec(self, q):
        return 0 * super().g_vec(q)


def test_a_generated_model_with_another_gravity_has_its_slopes():
    d = EXAMPLES["2R"]()
    given = values(d)
    q, qd, qdd = states(2, (3,))
    found = inverse_dynamics_slopes(Weightless(d, given), q, qd, qdd)
    needed = inverse_dynamics_slopes(numpy_model(d, given | {"g": 0.0}), q, qd, qdd)
    np.testing.assert_allclose(found.q, needed.q, rtol=1e-11, atol=1e-12)


# Of three links, 30 digits take long; tests/peers has longer arms.
@pytest.mark.parametrize("name", [name for name in EXAMPLES if name != "3 links, offsets"])
def test_against_the_derivation(name):
    """The symbols h_ijk, and the slopes of u as exact as 30 digits make them."""
    d = EXAMPLES[name]()
    d = d.with_friction(sp.symbols(f"d1:{d.n + 1}"), sp.symbols(f"k1:{d.n + 1}"))
    given = values(d)
    q, qd, qdd = states(d.n)
    model = numpy_model(d, given)
    h = numbers(list(d.christoffel().reshape(d.n**3)), d, given, q, qd).reshape((d.n,) * 3)
    np.testing.assert_allclose(model.christoffel_symbols(q), h, rtol=1e-12, atol=1e-13)
    frictionless = EXAMPLES[name]()
    by_q, by_qd = frictionless.inverse_dynamics_slopes([sp.Float(float(a), 30) for a in qdd])
    model = numpy_model(frictionless, {p.name: given[p.name] for p in frictionless.parameters})
    found = inverse_dynamics_slopes(model, q, qd, qdd)
    for ours, exact in ((found.q, by_q), (found.qd, by_qd), (found.qdd, d.M)):
        exact = numbers(exact, d, given, q, qd)
        np.testing.assert_allclose(ours, exact, rtol=1e-13, atol=1e-14 * np.max(np.abs(exact)))
    assert model.slope_in_q(q, qd, qdd) is not None
    differences = inverse_dynamics_slopes(Plain(model), q, qd, qdd)
    np.testing.assert_allclose(differences.q, found.q, atol=1e-11 * np.max(np.abs(found.q)))
    assert not np.array_equal(differences.q, found.q)
    _, with_friction = d.inverse_dynamics_slopes(list(qdd))
    rubbing = numbers(with_friction - by_qd, d, given, q, qd)
    viscous = np.diag([given[f"d{i + 1}"] for i in range(d.n)])
    np.testing.assert_allclose(rubbing, viscous, atol=1e-12)


class Contact(Manipulator):
    """Springs, and a stiff ground below x1 = 0."""

    n = 5

    def M(self, q):
        return np.broadcast_to(np.eye(5), (*np.shape(q), 5))

    def C(self, q, qd):
        return np.zeros((*np.broadcast_shapes(np.shape(q), np.shape(qd)), 5))

    def potential_energy(self, q):
        q = np.asarray(q)
        return 5000 * np.maximum(0, q[..., 0]) ** 2 + np.sum(q**2, axis=-1)

    def g_vec(self, q):
        q = np.asarray(q)
        return 2 * q + 10000 * np.maximum(0, q[..., :1]) * np.eye(5)[0]


@pytest.mark.parametrize("x1", [-1.0, -0.06, -0.02, -1e-3, 2e-4, 0.01, 0.03, 0.5])
def test_a_contact_nearby_is_not_felt(x1):
    q = np.array([[0.5, 0.1, 0.2, 0.3, 0.4], [x1, 0.1, 0.2, 0.3, 0.4]])
    found = inverse_dynamics_slopes(Contact(), q, np.zeros(5), np.zeros(5)).q
    ground = np.where(q[:, 0] > 0, 10000, 0)[:, np.newaxis, np.newaxis] * np.diag(np.eye(5)[0])
    np.testing.assert_allclose(found, 2 * np.eye(5) + ground, atol=1e-5 if x1 > 0 else 1e-8)


q = sp.Symbol("q", real=True)


@pytest.mark.parametrize("sharing", [False, True])
@pytest.mark.parametrize(
    ("P", "at", "stiffness"),
    [
        (500 * sp.Max(0, q) ** 2, 0.5, 1000),
        (500 * sp.Max(0, q) ** 2, -0.5, 0),
        (sp.Abs(q) ** 3, -0.5, 3),
        (3 * sp.Abs(q), 0.5, 0),
        (sp.Abs(sp.Abs(q) - 1) ** 3, 0.5, 3),
    ],
)
def test_beside_a_kink_of_a_derivation(P, at, stiffness, sharing):
    d = from_inertia(sp.Matrix([[2 + sp.Abs(q)]]), P, (q,), (sp.Symbol("v", real=True),), ())
    if sharing:
        d = replace(d, bias=(d.C * sp.Matrix(d.qd) + d.g_vec).as_immutable())
    model = numpy_model(d, {})
    assert model.slope_in_q([at], [0.0], [0.0]) is not None
    found = linearise(model, [at, 0.0], model.g_vec([at]))
    np.testing.assert_allclose(found.A[1, 0], -stiffness / (2 + abs(at)), atol=1e-9)
    by_q = inverse_dynamics_slopes(model, [at], [3.0], [1.5]).q
    by_differences = inverse_dynamics_slopes(Plain(model), [at], [3.0], [1.5]).q
    np.testing.assert_allclose(by_q, by_differences, atol=1e-7)


@pytest.mark.parametrize("x1", [0.0, 3e-7, -2e-6, 2e-5])
def test_where_contact_begins_there_is_no_slope(x1):
    with pytest.raises(ValueError, match=r"^q: the torque has a kink near .* coordinate 1"):
        linearise(Contact(), [x1, 0.1, 0.2, 0.3, 0.4, *[0.0] * 5], np.zeros(5))


@a_few
@given(arms_and_states(smooth))
def test_against_differences_of_the_motion(case):
    model, q, qd, u = case
    x = np.concatenate([q, qd], axis=-1)
    found = linearise(model, x, u)
    A = jacobian(lambda x: model.state_derivative(x, u), x)
    B = jacobian(lambda u: model.state_derivative(x, u), u)
    size = 10 * np.maximum(np.max(np.abs(A)), np.max(np.abs(B)))
    stiff = np.linalg.cond(model.M(q)).max()
    assert_close(found.A, A, size * stiff, 1e-8)
    assert_close(found.B, B, size * stiff, 1e-10)
    np.testing.assert_array_equal(found.x_dot, model.state_derivative(x, u))
    forward = forward_dynamics_slopes(model, q, qd, u)
    assert_close(forward.u @ model.M(q), np.broadcast_to(np.eye(model.n), forward.u.shape), stiff)


@cache
def rubbing():
    return Planar2R(1.0, 0.8, 0.5, 0.4, 2.0, 1.5, 0.2, 0.1, viscous=(0.3, 0.2), coulomb=(0.4, 0.6))


@pytest.mark.parametrize("speed", [1e-3, 0.5, -7.0])
def test_friction_has_the_slope_of_its_viscous_part_while_a_joint_moves(speed):
    arm = rubbing()
    q, qd, qdd = np.array([0.3, 0.4]), np.array([speed, 1.0]), np.array([1.0, -2.0])
    bare = Planar2R(1.0, 0.8, 0.5, 0.4, 2.0, 1.5, 0.2, 0.1)
    difference = (
        inverse_dynamics_slopes(arm, q, qd, qdd).qd - inverse_dynamics_slopes(bare, q, qd, qdd).qd
    )
    np.testing.assert_allclose(difference, np.diag([0.3, 0.2]), atol=1e-11)


def test_coulomb_friction_at_rest_has_none():
    with pytest.raises(ValueError, match=r"^qd: friction jumps where joint 2 is at rest"):
        linearise(rubbing(), [0.3, 0.4, 1.0, 0.0], [0.0, 0.0])
    viscous = Planar2R(1.0, 0.8, 0.5, 0.4, 2.0, 1.5, 0.2, 0.1, viscous=(0.3, 0.2))
    assert np.isfinite(linearise(viscous, [0.3, 0.4, 0.0, 0.0], [0.0, 0.0]).A).all()


def test_a_hanging_pendulum_is_an_oscillator():
    pendulum = Pendulum(m=2.0, lc=0.5, I=0.6, viscous=0.12)
    about = linearise(pendulum, [0.0, 0.0], [0.0])
    np.testing.assert_allclose(about.A, [[0, 1], [-9.81 / 0.6, -0.2]], rtol=1e-13)
    np.testing.assert_allclose(about.B, [[0], [1 / 0.6]], rtol=1e-15)
    np.testing.assert_array_equal(about.x_dot, [0, 0])


def test_each_state_of_a_batch_is_as_alone():
    arm = Planar2R(1.0, 0.8, 0.5, 0.4, 2.0, 1.5, 0.2, 0.1, viscous=(0.3, 0.2))
    x, u = np.random.default_rng(0).normal(size=(2, 3, 4)), np.array([0.5, -1.0])
    together = linearise(arm, x, u)
    assert together.A.shape == (2, 3, 4, 4)
    for at in np.ndindex(2, 3):
        np.testing.assert_allclose(together.A[at], linearise(arm, x[at], u).A, atol=1e-12)


@pytest.mark.parametrize(
    ("x", "u", "says"),
    [
        ([0.0] * 3, [0.0, 0.0], r"^x: got shape \(3,\)"),
        ([0.0] * 4, [0.0], r"^u: got shape \(1,\)"),
        ([0.0] * 4, [0.0, np.nan], r"^u\[1\] = nan"),
    ],
)
def test_bad_input_is_named(x, u, says):
    with pytest.raises(ValueError, match=says):
        linearise(rubbing(), x, u)
