"""Elastic joints and the slider-crank, each by another route than the one that derived it."""

import doctest
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols

from armdyn import Link, SerialChain
from armdyn.codegen import numpy_model
from armdyn.derive import elastic_joints, mechanisms, planar_2r, planar_chain, slider_crank
from armdyn.properties import christoffel_form, gravity_gradient, power_balance
from armdyn.simulate import energy_drift, simulate
from tests.armdyn.arms import assert_close, between
from tests.armdyn.derivations import values

t = dynamicsymbols._t
ARM = {"l1": 1.0, "l2": 0.8, "lc1": 0.5, "lc2": 0.4, "m1": 3.0, "m2": 2.0, "I1": 0.25, "I2": 0.11}
ARM["g"] = 9.81


def test_the_examples_in_the_docstrings_run():
    found = doctest.testmod(mechanisms)
    assert found.attempted >= 4
    assert found.failed == 0


def test_spongs_equations_are_lagranges():
    """A pendulum on a spring, from its two energies by SymPy's LagrangesMethod."""
    arm = elastic_joints(planar_chain(1))
    link, motor = dynamicsymbols("a b")
    s = {p.name: p for p in arm.parameters}
    inertia = s["I1"] + s["m1"] * s["lc1"] ** 2
    K = (inertia * link.diff(t) ** 2 + s["J1"] * motor.diff(t) ** 2) / 2
    P = s["m1"] * s["g"] * s["lc1"] * sp.sin(link) + s["k1"] * (link - motor) ** 2 / 2
    theirs = LagrangesMethod(K - P, [link, motor]).form_lagranges_equations()
    qdd = link.diff(t, 2), motor.diff(t, 2)
    moving = dict(zip((*arm.q, *arm.qd), (link, motor, link.diff(t), motor.diff(t)), strict=True))
    ours = sp.Matrix([equation.lhs.xreplace(moving) for equation in arm.equations(qdd, (0, 0))])
    assert sp.simplify((ours - theirs).doit()) == sp.zeros(2, 1)
    assert [p.name for p in arm.parameters] == ["l1", "lc1", "m1", "I1", "g", "J1", "k1"]


def test_the_spring_joins_what_the_rigid_arm_has_in_one():
    """Both rows together: the spring drops out, and D + J is what resists."""
    rigid = planar_2r()
    arm = elastic_joints(rigid)
    together = sp.Matrix([[1, 0, 1, 0], [0, 1, 0, 1]])
    locked = dict(zip((*arm.q[2:], *arm.qd[2:]), (*arm.q[:2], *arm.qd[:2]), strict=True))
    J = sp.diag(*sp.symbols("J1 J2", real=True))
    for ours, needed in (
        (together * arm.M * together.T, rigid.M + J),
        (together * arm.C * together.T, rigid.C),
        (together * arm.g_vec, rigid.g_vec),
    ):
        assert sp.simplify((ours.xreplace(locked) - needed).doit()).is_zero_matrix
    assert sp.simplify(arm.P.xreplace(locked) - rigid.P) == 0


@cache
def elastic(stiffness):
    numbers = ARM | {"J1": 0.3, "J2": 0.1, "k1": stiffness, "k2": stiffness}
    return numpy_model(elastic_joints(planar_2r()), numbers)


def test_stiff_joints_are_rigid_joints():
    """The links move as those of the rigid arm with D + J, but for what shrinks as 1/K."""
    rigid = planar_2r()
    J = sp.symbols("J1 J2", real=True)
    heavy = numpy_model(
        replace(
            rigid, M=(rigid.M + sp.diag(*J)).as_immutable(), parameters=(*rigid.parameters, *J)
        ),
        ARM | {"J1": 0.3, "J2": 0.1},
    )
    q, qd, u = np.array([0.3, -0.8]), np.array([1.0, 0.5]), np.array([2.0, -1.0])
    times = np.linspace(0, 0.3, 4)
    needed = simulate(heavy, [*q, *qd], u, times, "DOP853")[:, :2]
    off = []
    for stiffness in (1e4, 1e5):
        model = elastic(stiffness)
        x0 = np.concatenate([q, q, qd, qd])
        x = simulate(model, x0, [0, 0, *u], times, "DOP853", 1e-8, 1e-10)
        off.append(np.max(np.abs(x[:, :2] - needed)))
        assert np.max(np.abs(x[:, :2] - x[:, 2:4])) < 100 / stiffness
    assert off[0] < 0.01
    assert off[1] < off[0] / 5


@settings(max_examples=10)
@given(*[st.tuples(*[between(-3, 3)] * 4)] * 3)
def test_elastic_joints_have_the_structure(q, qd, u):
    model = elastic(50.0)
    assert christoffel_form(model, q, qd).kind == "Christoffel"
    assert gravity_gradient(model, q).holds
    assert power_balance(model, q, qd, u).holds


CRANK = {"l1": 0.3, "l2": 0.9, "lc1": 0.1, "lc2": 0.35, "m1": 1.2, "m2": 0.8, "m3": 2.5}
CRANK |= {"I1": 0.02, "I2": 0.06, "g": 9.81}


@cache
def crank_model(**changes):
    return numpy_model(slider_crank(), CRANK | changes)


def by_constraints(q, qd, u, l1, l2, lc1, lc2, m1, m2, m3, I1, I2, g):
    """q̈ of the crank from three free bodies and eight constraints: nothing is eliminated by hand.

    Each body's x, y and angle; [[M, Aᵀ], [A, 0]] [Ẍ; λ] = [forces; −Ȧ Ẋ].
    """

    def constraints(X):
        x1, y1, a1, x2, y2, a2, x3, y3, a3 = X
        return np.array(
            [
                x1 - lc1 * np.cos(a1),
                y1 - lc1 * np.sin(a1),
                x1 + (l1 - lc1) * np.cos(a1) - x2 + lc2 * np.cos(a2),
                y1 + (l1 - lc1) * np.sin(a1) - y2 + lc2 * np.sin(a2),
                x2 + (l2 - lc2) * np.cos(a2) - x3,
                y2 + (l2 - lc2) * np.sin(a2) - y3,
                y3,
                a3,
            ]
        )

    def jacobian(X):
        return np.stack([constraints(X + 1e-30j * e).imag / 1e-30 for e in np.eye(9)], axis=-1)

    a2 = -np.arcsin(l1 * np.sin(q) / l2)
    pin = l1 * np.array([np.cos(q), np.sin(q)])
    along = np.array([np.cos(a2), np.sin(a2)])
    X = np.array([*pin * lc1 / l1, q, *(pin + lc2 * along), a2, *(pin + l2 * along), 0.0])
    assert np.max(np.abs(constraints(X))) < 1e-14
    A = jacobian(X)
    _, _, rows = np.linalg.svd(A)
    V = rows[-1] * qd / rows[-1][2]  # the one motion left, with this q̇ of the crank
    h = 1e-5
    A_dot = (jacobian(X + h * V) - jacobian(X - h * V)) / (2 * h)
    mass = np.diag([m1, m1, I1, m2, m2, I2, m3, m3, 1.0])
    forces = np.array([0, -m1 * g, u, 0, -m2 * g, 0, 0, -m3 * g, 0])
    whole = np.block([[mass, A.T], [A, np.zeros((8, 8))]])
    return np.linalg.solve(whole, np.concatenate([forces, -A_dot @ V]))[2], V @ mass @ V / 2


@settings(max_examples=40)
@given(between(-7, 7), between(-5, 5), between(-10, 10), st.sampled_from([0.05, 0.3, 0.8]))
def test_the_slider_crank_is_three_bodies_with_constraints(q, qd, u, l1):
    model = crank_model(l1=l1)
    qdd, kinetic = by_constraints(q, qd or 1.0, u, **CRANK | {"l1": l1})
    found = model.dynamics([q], [qd or 1.0], [u])[0]
    assert_close(found, qdd, 100, 1e-7)
    assert_close(model.kinetic_energy([q], [qd or 1.0]), kinetic, kinetic, 1e-12)


def test_one_joint_with_a_coriolis_term():
    """C = ½ M′ q̇ beside M is not small, and energy is kept."""
    model = crank_model()
    q, qd = np.linspace(0, 2 * np.pi, 50)[:, np.newaxis], np.array([2.0])
    assert np.ptp(model.M(q)) > 0.5 * np.min(model.M(q))
    assert np.max(np.abs(model.C(q, qd))) > 0.1 * np.max(model.M(q))
    assert christoffel_form(model, q, qd).kind == "Christoffel"
    assert gravity_gradient(model, q).holds
    x = simulate(model, [0.3, 15.0], [0.0], np.arange(0, 1, 1e-3))
    assert np.ptp(x[:, 0]) > np.pi
    assert np.max(np.abs(energy_drift(model, x))) < 1e-5
    x = simulate(model, [0.3, 15.0], [0.0], np.arange(0, 1, 1e-2), "energy_momentum")
    assert np.max(np.abs(energy_drift(model, x))) < 1e-11


def test_all_mass_in_the_slider_moves_as_the_slider_does():
    """M = m3 (dx/dq)², by hand at a right angle: dx/dq = −l1."""
    light = dict.fromkeys(("m1", "m2", "I1", "I2"), 0.0)
    model = crank_model(**light, m3=2.0, l1=0.4)
    np.testing.assert_allclose(model.M([np.pi / 2]), [[2.0 * 0.4**2]], rtol=1e-14)
    np.testing.assert_allclose(model.M([0.0]), [[0.0]], atol=1e-15)


k = sp.Symbol("k", real=True)


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: elastic_joints(planar_2r(), [k]), r"^stiffness: got 1 entries, needs 2"),
        (lambda: elastic_joints(planar_2r(), k), r"^stiffness = k: needs 2 symbols"),
        (lambda: elastic_joints(planar_2r(), None, 3), r"^rotor_inertia = 3: needs 2 symbols"),
        (
            lambda: elastic_joints(planar_2r(), [k, k * planar_2r().q[0]]),
            r"^stiffness\[1\] = k\*q1: depends on q1; needs a constant",
        ),
        (lambda: elastic_joints(planar_2r(), [k, None]), r"^stiffness\[1\] = None: needs a symbol"),
        (
            lambda: elastic_joints(planar_2r(), [k, sp.Symbol("theta1")]),
            r"^stiffness\[1\]: the symbol theta1 has the name of a motor angle",
        ),
        (
            lambda: elastic_joints(elastic_joints(planar_chain(1))),
            r"^rigid: the symbol theta1 has the name of a motor angle",
        ),
        (
            lambda: elastic_joints(planar_2r(), [k, sp.Symbol("l1")]),
            r"2 different symbols are called l1",
        ),
    ],
)
def test_bad_input_is_named(make, says):
    with pytest.raises(ValueError, match=says):
        make()


def test_one_symbol_may_serve_all_joints_and_friction_stays():
    rigid = planar_2r().with_friction(sp.symbols("d1 d2"))
    arm = elastic_joints(rigid, [k, k], [2 * k, 0.1])
    assert arm.parameters == (*rigid.parameters, k)
    assert arm.f_vec[:2, :] == rigid.f_vec
    assert arm.n == 4
    assert numpy_model(arm, values(arm)).M([0.1, 0.2, 0.3, 0.4]).shape == (4, 4)


def test_the_motors_of_a_chain_go_to_the_rotors_and_count_once():
    """As the docstring says: stiff, the joints move as the chain does with its armature."""
    link = Link("revolute", 2.0, com=(0.4, 0, 0), inertia=np.diag([0.0, 0.1, 0.1]), axis=(0, 1, 0))
    chain = SerialChain([link], armature=[0.2])
    motors = [sp.Float(a) for a in chain.armature]
    bare = replace(chain, armature=None).derivation()
    arm = elastic_joints(bare, [sp.Integer(10**6)], motors)
    M = numpy_model(arm, {}).M([0.3, 0.3])
    np.testing.assert_allclose(M, np.diag([2.0 * 0.4**2 + 0.1, 0.2]), rtol=1e-12)
    # Of the motion in which spring and rotor go together.
    np.testing.assert_allclose(np.ones(2) @ M @ np.ones(2), chain.M([0.3])[0, 0], rtol=1e-12)
