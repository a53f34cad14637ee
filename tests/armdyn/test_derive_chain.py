"""`SerialChain.derivation()`: what it says is the chain's, and as short as can be."""

import copy
import pickle
from dataclasses import replace

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from armdyn import Link, PlanarChain, SerialChain, codegen, derive, ports, regressor
from armdyn.codegen import graph
from armdyn.spatial import rotation
from tests.armdyn.arms import assert_close, vectors
from tests.armdyn.chains import links, points, spatial, spatial_chains
from tests.armdyn.robots import panda
from tests.armdyn.test_codegen_sources import PACKAGES, WRITERS

# An example is a derivation, and code of it: tenths of a second.
few = settings(deadline=None, max_examples=20)
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
    # Code for q̈ is made of `bias`: then M q̈ is u less the chain's own.
    if np.all(np.linalg.cond(chain.M(q)) < 1e8):
        qdd = model.dynamics(q, qd, u)
        largest = size * (1 + np.max(np.abs(qdd))) + np.max(np.abs(u))
        assert_close(chain.rnea(q, qd, qdd), u, largest, tolerance)


@few
@given(spatial_chains(friction=st.just(0.0)), st.data())
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


def test_a_published_arm():
    arm = panda(gravity=(1, 2, -9))
    given_states = states(7)
    assert_agrees(arm, arm.derivation(), {}, given_states, 1e-14)


def test_the_bias_is_that_of_c_and_g():
    arm = panda()
    derivation = arm.derivation()
    q, qd, _ = states(7)
    model = codegen.numpy_model(replace(derivation, g_vec=derivation.bias), {})
    names = dict(zip(derivation.q, derivation.qd, strict=True))
    assert graph.symbols(derivation.bias) == {*names, *names.values()} - {
        derivation.q[0],
        derivation.q[6],
    } | {derivation.q[6]}
    del model, q, qd


def size(derivation):
    """The number of different parts of M and C."""
    return len(list(graph.parts([*derivation.M, *derivation.C, *derivation.bias])))


@pytest.mark.parametrize(("quarter", "tolerance"), [(1.5708, 1e-5), (1.57079632679, 1e-9)])
def test_what_a_file_leaves_of_right_angles_is_cleared(quarter, tolerance):
    exact, written = panda(), panda(quarter)
    derivation = written.derivation(tolerance=tolerance)
    assert size(derivation) == size(exact.derivation())
    assert size(written.derivation(tolerance=0)) > 1.5 * size(derivation)
    assert_agrees(exact, derivation, {}, states(7), 10 * tolerance)
