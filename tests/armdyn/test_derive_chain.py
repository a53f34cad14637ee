"""`SerialChain.derivation()`: what it says is the chain's, and as short as can be."""

import pickle
from dataclasses import replace

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from armdyn import Link, PlanarChain, SerialChain, codegen, derive, ports, regressor
from armdyn.codegen import straight_line
from armdyn.codegen.vocabulary import writable
from armdyn.derive import graph
from armdyn.derive.frames import frames
from armdyn.spatial import rotation
from tests.armdyn.arms import assert_close, vectors
from tests.armdyn.chains import links, spatial, spatial_chains
from tests.armdyn.robots import panda

# An example is a derivation, and code of it: tenths of a second.
few = settings(deadline=None, max_examples=8)
BATCH = (3,)
QUARTER = np.pi / 2


def states(n, seed=0, batch=BATCH):
    return np.random.default_rng(seed).uniform(-3, 3, size=(3, *batch, n))


def size_of(chain, *rates):
    """What an entry of the chain's terms may come to, which rounding is relative to."""
    reach = sum(np.linalg.norm(link.translation) + np.linalg.norm(link.com) for link in chain.links)
    slides = sum(link.joint == "prismatic" for link in chain.links)
    inertia = sum(
        link.mass * (1 + reach + 4 * slides) ** 2 + np.trace(link.inertia) for link in chain.links
    )
    return (inertia + sum(chain.armature)) * (
        1 + np.max(np.abs(rates)) ** 2 + sum(np.abs(chain.gravity))
    )


def assert_agrees(chain, derivation, values, states, tolerance):
    """The derivation's terms in NumPy are the chain's own."""
    q, qd, u = states
    model = codegen.numpy_model(derivation, values)
    size = size_of(chain, qd)
    assert_close(model.M(q), chain.M(q), size, tolerance)
    np.testing.assert_array_equal(model.M(q), np.swapaxes(model.M(q), -1, -2))
    assert_close(model.C(q, qd), chain.C(q, qd), size, tolerance)
    assert_close(model.g_vec(q), chain.g_vec(q), size, tolerance)
    assert_close(model.potential_energy(q), chain.potential_energy(q), size, tolerance)
    assert_close(model.f_vec(qd), chain.f_vec(qd), size, 1e-15)
    # Code for q̈ is made of `bias`: then M q̈ is u less the chain's own.
    if np.all(np.linalg.cond(chain.M(q)) < 1e8):
        qdd = model.dynamics(q, qd, u)
        largest = size * (1 + np.max(np.abs(qdd))) + np.max(np.abs(chain.f_vec(qd)))
        assert_close(chain.rnea(q, qd, qdd), u, largest, tolerance)


@few
@given(spatial_chains(), st.data())
def test_says_what_any_chain_says(chain, data):
    given_states = [data.draw(vectors(chain.n, 3, BATCH)) for _ in range(3)]
    assert_agrees(chain, chain.derivation(tolerance=0), {}, given_states, 1e-11)
    assert_agrees(chain, chain.derivation(), {}, given_states, 1e-7)


@st.composite
def square_chains(draw):
    """Axes at right angles, in line and on one line; light links; gravity along no axis, or none."""
    quarters = st.integers(0, 3).map(lambda k: k * QUARTER)
    directions = st.sampled_from([*np.eye(3), *-np.eye(3)])
    lengths = st.sampled_from([0.0, 0.5, -0.3])
    chain = []
    for _ in range(draw(st.integers(1, 4))):
        body = draw(links())
        if draw(st.booleans()):
            body = replace(body, mass=0.0, inertia=np.zeros((3, 3)))
        turns = [rotation(axis, draw(quarters)) for axis in np.eye(3)]
        chain.append(
            replace(
                body,
                axis=draw(directions),
                rotation=turns[0] @ turns[1] @ turns[2],
                translation=[draw(lengths) for _ in range(3)],
                com=[draw(lengths) for _ in range(3)],
            )
        )
    gravity = draw(st.sampled_from([(0, 0, -9.81), (0, 0, 0), (3, -2, 9), (0, 9.81, 0)]))
    return SerialChain(tuple(chain), gravity=gravity)


@few
@given(square_chains())
def test_says_what_a_chain_of_right_angles_says(chain):
    assert_agrees(chain, chain.derivation(), {}, states(chain.n), 1e-11)


def an_arm():
    """Three joints, one of them a slide, in no special place; with friction and motors."""
    rng = np.random.default_rng(8)
    chain = []
    for k, body in enumerate(panda().links[1:4]):
        a, b = rng.normal(size=(2, 3))
        turn = rotation(a / np.linalg.norm(a), 1.0)
        kind = "prismatic" if k == 1 else "revolute"
        chain.append(
            replace(body, joint=kind, axis=b / np.linalg.norm(b), rotation=turn, translation=a / 2)
        )
    friction = {"viscous": (0.5, 0, 0.1), "coulomb": (1, 2, 0), "armature": (0.3, 2, 0)}
    return SerialChain(tuple(chain), gravity=(1, 2, -9), **friction)


ARMS = {"Panda": panda(gravity=(1, 2, -9)), "three joints": an_arm()}


@pytest.mark.parametrize("name", ARMS)
def test_numpy_code_of_an_arm(name):
    arm = ARMS[name]
    assert_agrees(arm, arm.derivation(), {}, states(arm.n, batch=(2, 3)), 1e-14)


@pytest.mark.usefixtures("compiler")
@pytest.mark.parametrize("name", ARMS)
def test_c_code_of_an_arm(name):
    arm = ARMS[name]
    model = codegen.c_model(arm.derivation(), {})
    q, qd, u = states(arm.n, batch=(40,))
    right = arm.aba(q, qd, u)
    assert_close(model.dynamics_many(q, qd, u), right, tolerance=1e-11)
    assert_close(model.dynamics(q[0], qd[0], u[0]), right[0], np.max(np.abs(right)), 1e-11)


@pytest.mark.parametrize("language", ports.LANGUAGES)
def test_source_of_an_arm_in_another_language(language):
    if line := ports.missing(language):
        pytest.skip(line)
    # Mathics3 takes a minute for what the others do at once.
    arm = SerialChain(panda().links[2:4]) if language == "wolfram" else ARMS["Panda"]
    arm = replace(arm, viscous=[0.5] * arm.n, coulomb=[1.0] * arm.n, armature=[0.2] * arm.n)
    q, qd, u = states(arm.n, batch=(2,))
    with ports.start(language, arm.derivation(), seconds=300) as program:
        found = program.terms([], np.concatenate([q, qd], axis=-1), u)
    size = size_of(arm, qd)
    assert_close(found.M, arm.M(q), size, 1e-14)
    assert_close(found.C, arm.C(q, qd), size, 1e-14)
    assert_close(found.g_vec, arm.g_vec(q), size, 1e-14)
    assert_close(found.f_vec, arm.f_vec(qd), size, 1e-14)
    assert_close(found.potential_energy, arm.potential_energy(q), size, 1e-14)
    assert_close(found.qdd, arm.dynamics(q, qd, u), tolerance=1e-11)


@pytest.mark.parametrize("name", ARMS)
def test_masses_may_be_symbols(name):
    arm = ARMS[name]
    derivation = arm.derivation(inertial_symbols=True)
    names = [symbol.name for symbol in derivation.parameters]
    assert names[-10:-6] == [f"{part}{arm.n}" for part in ("m", "mcx", "mcy", "mcz")]
    # A payload in the hand: its parameters are added to those of the last link.
    hand = arm.links[-1]
    mass, com = hand.mass + 2, (hand.mass * np.array(hand.com) + 2 * np.array((0.1, 0, 0.3)))
    apart = np.array(hand.com) - (0.1, 0, 0.3)
    between = hand.mass * 2 / mass * (apart @ apart * np.eye(3) - np.outer(apart, apart))
    loaded = replace(hand, mass=mass, com=com / mass, inertia=hand.inertia + between)
    for links_ in (arm.links, (*arm.links[:-1], loaded)):
        chain = replace(arm, links=links_)
        values = dict(zip(names, regressor.parameters(chain), strict=True))
        assert_agrees(chain, derivation, values, states(arm.n), 1e-13)


def parts_of(*matrices):
    return len(list(graph.parts([entry for matrix in matrices for entry in matrix])))


def sizes(*derivations):
    """The parts of M and C. Not inside an assert: pytest would write out what it was called with."""
    return [parts_of(d.M, d.C) for d in derivations]


@pytest.mark.parametrize(("quarter", "tolerance"), [(1.5708, 1e-5), (1.57079632679, 1e-9)])
def test_what_a_file_leaves_of_right_angles_is_cleared(quarter, tolerance):
    exact, written = panda(), panda(quarter)
    cleared, untouched = (written.derivation(tolerance=t) for t in (tolerance, 0))
    right, found, more = sizes(exact.derivation(), cleared, untouched)
    assert found == right
    assert more > 1.3 * right
    assert_agrees(exact, cleared, {}, states(7), 10 * tolerance)


def test_what_a_file_leaves_of_moments_is_cleared():
    def arm(noise):
        links_ = [
            replace(
                body,
                com=(noise, -noise, body.com[2]),
                inertia=np.diag(np.diag(body.inertia)) + noise * (1 - np.eye(3)),
            )
            for body in panda().links
        ]
        return SerialChain(tuple(links_))

    even, uneven = arm(0.0), arm(1e-13)
    right, found, more = sizes(
        even.derivation(), uneven.derivation(), uneven.derivation(tolerance=0)
    )
    assert found == right
    assert more > 1.3 * right


@pytest.mark.parametrize("place", [0.0, 1e5, 5e5, 1e7])
@pytest.mark.parametrize(("joint", "axis"), [("revolute", (0, 1, 0)), ("prismatic", (0, 0, 1))])
def test_a_small_robot_may_stand_far_away(joint, axis, place):
    first = Link(joint, 2.0, (4e-4, 0, 1e-3), axis=axis, translation=(place, 4 * place, 0))
    second = Link("revolute", 1.0, (1e-3, 1e-4, 0), translation=(1e-3, 0, 2e-3))
    chain = SerialChain([first, second])
    model = codegen.numpy_model(chain.derivation(), {})
    q, qd = [0.3, 0.4], [1.0, 2.0]
    for ours, own in ((model.M(q), chain.M(q)), (model.g_vec(q), chain.g_vec(q))):
        np.testing.assert_allclose(ours, own, rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(model.C(q, qd), chain.C(q, qd), rtol=1e-12, atol=1e-17)


def test_seven_numbers_are_left_of_a_turning_link():
    rng = np.random.default_rng(5)
    masses = [np.cov(rng.normal(size=(4, 9)))[..., np.newaxis] for _ in range(7)]
    found = frames(ARMS["Panda"].links, (0, 0, -9.81), masses, 1e-9)
    left = [np.count_nonzero(np.triu(joint.J[..., 0])) for joint in found.joints]
    assert left == [7] * 7


def test_what_an_arm_does_not_feel_is_not_in_its_equation():
    upright, leaning = panda().derivation(), panda(gravity=(1, 0, -9)).derivation()
    q, qd = upright.q, upright.qd
    in_M, in_g, in_P = (graph.symbols(e) for e in (upright.M, upright.g_vec, [upright.P]))
    assert in_M == in_g == in_P == set(q[1:])
    moving = graph.symbols([*upright.C, *upright.bias])
    assert moving == {*q[1:], *qd}
    assert upright.g_vec[0] == 0
    in_M, in_g = graph.symbols(leaning.M), graph.symbols(leaning.g_vec)
    assert in_M == set(q[1:])
    assert in_g == set(q)


def test_a_plane_arm_in_space_is_as_short_as_in_the_plane():
    rng = np.random.default_rng(2)
    planar = PlanarChain(*rng.uniform(0.1, 1, size=(4, 4)), ly=rng.uniform(0.1, 1, size=4))
    derivation, other = spatial(planar).derivation(), derive.planar_chain(4, offsets=True)
    for name in ("M", "g_vec"):
        ours, theirs = (parts_of(getattr(d, name)) for d in (derivation, other))
        assert ours < 1.5 * theirs
    read = graph.symbols([*derivation.M, *derivation.C])
    assert read == {*derivation.q[1:], *derivation.qd}


def test_a_derivation_is_kept_and_shown():
    derivation = panda().derivation()
    again = pickle.loads(pickle.dumps(derivation))
    for name in ("q", "qd", "parameters", "M", "C", "g_vec", "P", "bias", "f_vec"):
        same = getattr(again, name) == getattr(derivation, name)
        assert same, name
    assert repr(derivation) == "<Derivation in q1, q2, q3, q4, q5, q6, q7; parameters: none>"
    assert repr(derive.planar_chain(1)) == "<Derivation in q1; parameters: l1, lc1, m1, I1, g>"


def test_christoffel_symbols_are_the_slopes_of_c():
    arm = ARMS["three joints"]
    derivation = arm.derivation()
    h = list(derivation.christoffel())
    compute = sp.lambdify(
        derivation.q, h, cse=lambda e: graph.shared(e, sp.numbered_symbols("step"))
    )
    q, qd, _ = states(arm.n, batch=())
    h = np.array(compute(*q), dtype=float).reshape([arm.n] * 3)
    size = size_of(arm, qd)
    assert_close(h @ qd, arm.C(q, qd), size, 1e-13)
    assert_close(h, np.swapaxes(h, 1, 2), size, 1e-13)


def test_slopes_are_those_of_sympy():
    x, y = sp.symbols("x y", real=True)
    shared = sp.Add(x, sp.Mul(-1, y, evaluate=False), evaluate=False)
    product = sp.Mul(3, shared, sp.sin(shared), evaluate=False)
    expressions = [
        product,
        sp.Mul(1, x, evaluate=False),
        sp.Pow(product, -2, evaluate=False),
        sp.atan2(y, shared),
        y,
        sp.pi,
    ]
    for e, row in zip(expressions, graph.slopes(expressions, (x, y)), strict=True):
        for symbol, slope in zip((x, y), row, strict=True):
            assert sp.simplify(slope.doit() - e.doit().diff(symbol)) == 0
    with pytest.raises(ValueError, match="needs sums, products, powers and smooth functions"):
        graph.slopes([sp.Piecewise((x, x > 0), (0, True))], (x,))


def test_a_bias_of_another_shape_is_named():
    with pytest.raises(ValueError, match=r"bias = .*needs a matrix of shape \(7, 1\)"):
        replace(panda().derivation(), bias=[0] * 7)


@pytest.mark.parametrize("tolerance", [-1e-9, 0.1, np.nan, "1e-9", None])
def test_a_tolerance_that_is_none_is_named(tolerance):
    with pytest.raises(ValueError, match=r"tolerance = .*(needs|must not be negative)"):
        panda().derivation(tolerance=tolerance)


def test_writing_keeps_what_is_shared():
    derivation = panda().derivation()
    right, found = sizes(derivation, writable(derivation, "Java"))
    assert found == right
    operations = sum(
        term.count_ops() for _, term in straight_line.forward_dynamics(derivation).steps
    )
    assert operations < 1300
