"""Denavit–Hartenberg tables as roboticstoolbox reads them, screw axes as modern_robotics does."""

import warnings
from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from armdyn import SerialChain, reflected_inertia
from tests.armdyn.arms import a_few, assert_close, inertias, vectors
from tests.armdyn.test_conventions import CONVENTIONS, dh_tables, screw_arms
from tests.peers.built import library

rtb = library("roboticstoolbox")
mr = library("modern_robotics")
GRAVITY = (1.0, -2.0, 9.0)

KINDS = {
    ("revolute", "standard"): rtb.RevoluteDH,
    ("prismatic", "standard"): rtb.PrismaticDH,
    ("revolute", "modified"): rtb.RevoluteMDH,
    ("prismatic", "modified"): rtb.PrismaticMDH,
}


def dh_robot(table, convention, armature):
    links = []
    for k, kind in enumerate(table["joints"]):
        # Of theta and d, its link takes the constant one and adds the offset to the other.
        fixed, moving = ("d", "theta") if kind == "revolute" else ("theta", "d")
        row = {fixed: table[fixed][k], "offset": table[moving][k]}
        row |= {name: table[name][k] for name in ("a", "alpha")}
        body = {"m": table["mass"][k], "r": table["com"][k], "I": table["inertia"][k]}
        links.append(KINDS[kind, convention](**row, **body, Jm=armature[k], G=1.0))
    return rtb.DHRobot(links, gravity=GRAVITY)


@a_few
@given(dh_tables(), st.sampled_from(CONVENTIONS), st.data())
def test_a_table_is_the_dh_robot_of_roboticstoolbox(table, convention, data):
    n = len(table["joints"])
    armature = data.draw(st.tuples(*[inertias] * n))
    chain = SerialChain.from_dh(**table, convention=convention, gravity=GRAVITY, armature=armature)
    robot = dh_robot(table, convention, armature)
    q, qd, qdd = (data.draw(vectors(n, size=3)) for _ in range(3))
    size = 36 * np.max(np.abs(chain.M(q))) + 100 * sum(table["mass"])
    # Its `rne` in C, and all that calls it, is wrong with prismatic joints: not the gradient of P.
    u = robot.rne_python(q, qd, qdd)
    assert_close(chain.rnea(q, qd, qdd), u, size, 1e-11)
    assert_close(chain.g_vec(q), robot.rne_python(q, 0 * q, 0 * q), size, 1e-11)
    if "prismatic" not in table["joints"]:
        assert_close(chain.M(q), robot.inertia(q).reshape(n, n), size, 1e-11)
        assert_close(chain.rnea(q, qd, qdd), robot.rne(q, qd, qdd).ravel(), size, 1e-11)


def test_the_puma_560_of_roboticstoolbox():
    """Its published inertias break the triangle inequality, and its motors have gears."""
    puma = rtb.models.DH.Puma560()
    each = {
        name: [getattr(link, field) for link in puma.links]
        for name, field in {
            "a": "a", "alpha": "alpha", "d": "d", "theta": "offset", "mass": "m", "com": "r",
            "inertia": "I",
        }.items()
    }  # fmt: skip
    rotor, ratio = ([getattr(link, name) for link in puma.links] for name in ("Jm", "G"))
    assert np.max(np.abs(ratio)) > 100
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        chain = SerialChain.from_dh(
            **each,
            triangle="warn",
            gravity=puma.gravity,
            armature=reflected_inertia(rotor, ratio),
        )
    assert any("link 'link1': inertia" in str(warning.message) for warning in told)
    q, qd, qdd = np.random.default_rng(0).uniform(-2, 2, size=(3, 6))
    assert_close(chain.M(q), puma.inertia(q), tolerance=1e-10)
    assert_close(chain.g_vec(q), puma.gravload(q), tolerance=1e-10)
    assert_close(
        chain.rnea(q, qd, qdd),
        puma.nofriction(coulomb=True, viscous=True).rne(q, qd, qdd),
        tolerance=1e-10,
    )


@a_few
@given(screw_arms(at_com=True), st.data())
def test_screws_are_those_of_modern_robotics(case, data):
    """There the links' frames are at their centres of mass."""
    arm, _ = case
    chain = SerialChain.from_screws(**arm, gravity=GRAVITY)
    before = [np.eye(4), *arm["homes"]]
    steps = [np.linalg.inv(a) @ b for a, b in pairwise(before)]
    peer = (np.array([*steps, np.eye(4)]), arm["inertias"], arm["screws"].T)
    q, qd, qdd = (data.draw(vectors(chain.n, size=3)) for _ in range(3))
    # It takes angles below 1e-6 for 0.
    q = np.where(np.abs(q) < 1e-5, 0.0, q)
    size = 36 * np.max(np.abs(chain.M(q))) + 1000 * chain.n
    gravity = np.array(GRAVITY)
    assert_close(chain.M(q), mr.MassMatrix(q, *peer), size, 1e-11)
    assert_close(chain.g_vec(q), mr.GravityForces(q, gravity, *peer), size, 1e-11)
    Cqd = mr.VelQuadraticForces(q, qd, *peer)
    assert_close(chain.C(q, qd) @ qd, Cqd, size, 1e-11)
    u = mr.InverseDynamics(q, qd, qdd, gravity, np.zeros(6), *peer)
    assert_close(chain.rnea(q, qd, qdd), u, size, 1e-11)
