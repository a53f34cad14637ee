"""Code of `SerialChain.derivation()` against Pinocchio, which knows nothing of it."""

import numpy as np
import pytest

from armdyn import codegen
from tests.armdyn.robots import panda
from tests.peers import built
from tests.peers.test_agreement import largest_error, one_by_one, robot

CHAINS = [f"spatial-{n}-{k}" for n in range(1, 5) for k in range(2)]


def assert_agreement(chain, states, make):
    q, qd, u = states
    other = built.pinocchio(chain)
    model = make(chain.derivation(), {})
    M = model.M(q)
    inertia, weight = 1e-2 * np.max(np.abs(M)), 1e-2 * np.max(np.abs(chain.g_vec(q)))
    cases = {
        "M": (M, one_by_one(other.M, q), 0),
        "C": (model.C(q, qd), one_by_one(other.C, q, qd), inertia),
        "g": (model.g_vec(q), one_by_one(other.g_vec, q), weight),
        "P": (model.potential_energy(q), one_by_one(other.potential_energy, q), weight),
        "q̈": (model.dynamics(q, qd, u), one_by_one(other.dynamics, q, qd, u), 0),
    }
    errors = {term: largest_error(*case) for term, case in cases.items()}
    assert {term: error for term, error in errors.items() if error > 1e-10} == {}


@pytest.mark.parametrize("name", CHAINS)
def test_random_chains_in_numpy(name):
    chain, *states = robot(name)
    assert_agreement(chain, states, codegen.numpy_model)


@pytest.mark.usefixtures("compiler")
@pytest.mark.parametrize("name", ["spatial-3-1", "spatial-7-1"])
def test_random_chains_in_c(name):
    chain, *states = robot(name)
    assert_agreement(chain, states, codegen.c_model)


@pytest.mark.usefixtures("compiler")
def test_a_published_arm_in_c():
    states = np.random.default_rng(4).uniform(-2, 2, size=(3, 5, 7))
    assert_agreement(panda(), states, codegen.c_model)
