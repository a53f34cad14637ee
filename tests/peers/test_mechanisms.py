"""What problems are judged by, M, C, g and P of each mechanism, as others derive them."""

from types import SimpleNamespace

import numpy as np
import pytest

from autograder.mechanisms import MECHANISMS
from autograder.mutation.references import reference
from tests.peers import built
from tests.peers.mechanisms import LINKS, SCENES, chain
from tests.peers.scene import solved_for

EVERY = pytest.mark.parametrize("name", MECHANISMS)
STATES = 5
# Chains whose first joint is the mechanism's second coordinate.
TURNED_ROUND = ("spherical-pendulum",)


def states(mechanism, seed=0):
    rng = np.random.default_rng(seed)
    for _ in range(STATES):
        yield mechanism.placed(rng), mechanism.moving(rng), mechanism.drawn(rng)


def assert_equal(ours, theirs, scale):
    assert np.max(np.abs(ours - theirs)) <= 1e-10 * max(scale, np.max(np.abs(theirs)))


def derived_again(mechanism, method):
    """Their A and b and potential energy, as one function of numbers."""
    parameters = {p.name: p.symbol for p in mechanism.parameters}
    assert mechanism.name in SCENES, (
        f"SCENES in tests/peers/mechanisms.py has to build {mechanism.name} of points, frames and bodies"
    )
    scene = SCENES[mechanism.name](SimpleNamespace(**parameters))
    A, b = getattr(scene, method)()
    return scene.compiled([A, b, scene.potential], parameters)


@EVERY
@pytest.mark.parametrize("method", ["by_lagrange", "by_kane"])
def test_points_frames_and_bodies(name, method):
    mechanism = MECHANISMS[name]
    theirs, n = derived_again(mechanism, method), mechanism.n
    M, C, g, P = (reference(mechanism, a) for a in ("M", "C", "g_vec", "potential_energy"))
    for q, qd, arm in states(mechanism):
        A, b, energy = theirs(q, qd, arm)
        inertia, bias = solved_for(n, A, b)
        at_rest = theirs(q, 0 * qd, arm)
        _, weight = solved_for(n, *at_rest[:2])
        _, _, zero = theirs(0 * q, 0 * qd, arm)
        size = np.max(np.abs(inertia))
        assert_equal(M(q, arm), inertia, 0)
        assert_equal(C(q, qd, arm) @ qd, bias - weight, 1e-2 * size)
        assert_equal(g(q, arm), weight, 1e-2 * size)
        assert_equal(P(q, arm) - P(0 * q, arm), energy - zero, 1e-2 * size)


@pytest.mark.parametrize("name", LINKS)
def test_chains_of_links(name):
    mechanism = MECHANISMS[name]
    order = slice(None, None, -1) if name in TURNED_ROUND else slice(None)
    M, C, g, P = (reference(mechanism, a) for a in ("M", "C", "g_vec", "potential_energy"))
    for q, qd, arm in states(mechanism):
        theirs = built.pinocchio(chain(name, arm))
        own, speed = q[order], qd[order]
        inertia = theirs.M(own)[order, order]
        size = np.max(np.abs(inertia))
        assert_equal(M(q, arm), inertia, 0)
        assert_equal(C(q, qd, arm), theirs.C(own, speed)[order, order], 1e-2 * size)
        assert_equal(C(q, qd, arm) @ qd, theirs.Cqd(own, speed)[order], 1e-2 * size)
        assert_equal(g(q, arm), theirs.g_vec(own)[order], 1e-2 * size)
        change = theirs.potential_energy(own) - theirs.potential_energy(0 * own)
        assert_equal(P(q, arm) - P(0 * q, arm), change, 1e-2 * size)
