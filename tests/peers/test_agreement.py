"""armdyn's models against five libraries that know nothing of it."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from armdyn import Link, Planar2R, PlanarChain, SerialChain
from tests.armdyn.chains import spatial
from tests.peers import built

PEERS = ("pinocchio", "roboticstoolbox", "modern_robotics", "mujoco", "drake")
STATES = 3


def planar_2r(rng):
    l1, l2, lc1, lc2 = rng.uniform(0.2, 1.5, size=4)
    return Planar2R(l1, l2, lc1, -lc2, *rng.uniform(0.5, 5, 2), *rng.uniform(0.02, 0.5, 2))


def planar_chain(n, rng):
    l, lc, m, I, ly = rng.uniform(0.1, 1, size=(5, n))
    return PlanarChain(l, lc, 5 * m, I / 5, ly=ly - 0.5)


def spatial_chain(n, rng):
    links = []
    for _ in range(n):
        axis = rng.normal(size=3)
        # Six equal masses in random places have an inertia that a body can have.
        places = rng.normal(size=(6, 3)) * 0.2
        places -= places.mean(axis=0)
        mass = rng.uniform(0.5, 5)
        spread = mass / 6 * places.T @ places
        links.append(
            Link(
                ("revolute", "prismatic")[rng.integers(2)],
                mass,
                com=rng.normal(size=3) * 0.3,
                inertia=np.trace(spread) * np.eye(3) - spread,
                axis=axis / np.linalg.norm(axis),
                rotation=Rotation.random(rng=rng).as_matrix(),
                translation=rng.normal(size=3) * 0.5,
            )
        )
    return SerialChain(tuple(links), gravity=rng.normal(size=3) * 6)


def with_motors(n, rng):
    return replace(spatial_chain(n, rng), armature=rng.uniform(0.1, 3, size=n))


def as_spatial(model) -> SerialChain:
    if isinstance(model, Planar2R):
        two = ((model.l1, model.l2), (model.lc1, model.lc2), (model.m1, model.m2))
        model = PlanarChain(*two, (model.I1, model.I2), model.g)
    return spatial(model) if isinstance(model, PlanarChain) else model


ROBOTS = {f"2r-{k}": (planar_2r, ()) for k in range(3)}
ROBOTS |= {f"planar-{n}r": (planar_chain, (n,)) for n in range(1, 7)}
ROBOTS |= {f"spatial-{n}-{k}": (spatial_chain, (n,)) for n in range(1, 8) for k in range(2)}
ROBOTS |= {f"motors-{n}": (with_motors, (n,)) for n in (1, 2, 3, 6)}


@cache
def robot(name):
    """The model, and q, q̇ and q̈ or u of some states, away from q = 0."""
    make, arguments = ROBOTS[name]
    rng = np.random.default_rng(sorted(ROBOTS).index(name))
    model = make(*arguments, rng)
    q = rng.uniform(0.1, 3, size=(STATES, model.n)) * rng.choice([-1, 1], size=(STATES, model.n))
    return model, q, *rng.uniform(-3, 3, size=(2, STATES, model.n))


@cache
def peer(library, name):
    return getattr(built, library)(as_spatial(robot(name)[0]))


def largest_error(ours, theirs, floor):
    """Of all states, relative to the largest entry; `floor` stands for that where all are 0."""
    ours, theirs = np.asarray(ours), np.asarray(theirs)
    assert ours.shape == theirs.shape
    axes = tuple(range(1, theirs.ndim))
    size = np.maximum(np.max(np.abs(theirs), axis=axes), floor)
    return np.max(np.max(np.abs(ours - theirs), axis=axes) / size)


def one_by_one(function, *states):
    return [function(*state) for state in zip(*states, strict=True)]


@pytest.mark.parametrize(
    ("library", "name"),
    # modern_robotics has no motors.
    [
        (library, name)
        for library in PEERS
        for name in ROBOTS
        if not (library == "modern_robotics" and name.startswith("motors"))
    ],
)
def test_all_terms(library, name):
    other = peer(library, name)
    model, q, qd, z = robot(name)
    M, C = model.M(q), model.C(q, qd)
    # One link, or slides alone, has C = 0, and its zeros are rounded products of this size.
    floor = 1e-2 * np.max(np.abs(M))
    weight = 1e-2 * np.max(np.abs(model.g_vec(q)))
    cases = {
        "M": (M, (other.M, q), 0),
        "C q̇": (np.matvec(C, qd), (other.Cqd, q, qd), floor),
        "g": (model.g_vec(q), (other.g_vec, q), weight),
        "u": (model.inverse_dynamics(q, qd, z), (other.inverse_dynamics, q, qd, z), 0),
        "q̈": (model.dynamics(q, qd, z), (other.dynamics, q, qd, z), 0),
    }
    if isinstance(model, SerialChain):
        cases |= {
            "M by crba": (model.crba(q), cases["M"][1], 0),
            "u by rnea": (model.rnea(q, qd, z), cases["u"][1], 0),
            "q̈ by aba": (model.aba(q, qd, z), cases["q̈"][1], 0),
        }
    if other.C:
        cases["C"] = (C, (other.C, q, qd), floor)
    if other.kinetic_energy:
        cases["K"] = (model.kinetic_energy(q, qd), (other.kinetic_energy, q, qd), 0)
        cases["P"] = (model.potential_energy(q), (other.potential_energy, q), weight)
    tolerance = 1e-12 if library == "pinocchio" and name.startswith("2r") else 1e-10
    errors = {
        term: largest_error(ours, one_by_one(*theirs), floor)
        for term, (ours, theirs, floor) in cases.items()
    }
    assert {term: error for term, error in errors.items() if error > tolerance} == {}


def test_the_chains_have_joints_of_both_kinds():
    joints = [link.joint for name in ROBOTS for link in as_spatial(robot(name)[0]).links]
    assert {"revolute", "prismatic"} == set(joints)
    mixed = [
        name for name in ROBOTS if len({b.joint for b in as_spatial(robot(name)[0]).links}) > 1
    ]
    assert len(mixed) > 5


def test_what_a_library_has_is_compared():
    """MuJoCo, Drake and modern_robotics give C q̇ alone."""
    peers = {library: peer(library, "2r-0") for library in PEERS}
    assert {name for name, p in peers.items() if p.C} == {"pinocchio", "roboticstoolbox"}
    with_energies = {"pinocchio", "mujoco", "drake"}
    assert {name for name, p in peers.items() if p.kinetic_energy} == with_energies
    assert {name for name, p in peers.items() if p.potential_energy} == with_energies
