"""Chains by Denavit–Hartenberg parameters and by screw axes."""

from functools import reduce

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm

from armdyn import SerialChain
from armdyn.spatial import rigid_inertia, rotation, skew
from tests.armdyn.arms import a_few, assert_close, between, inertias, masses, vectors
from tests.armdyn.chains import angles, points, rotations, spatial_chains

CONVENTIONS = ("standard", "modified")


@st.composite
def bodies(draw):
    """Mass, centre of mass, and inertia about it."""
    spread = np.array([draw(inertias) for _ in range(3)])
    principal = draw(rotations())
    inertia = principal @ np.diag(spread.sum() - spread) @ principal.T
    return draw(masses), draw(points(1)), (inertia + inertia.T) / 2


@st.composite
def dh_tables(draw, most=5, kinds=("revolute", "prismatic")):
    """The arguments of from_dh, without the convention."""
    n = draw(st.integers(1, most))
    mass, com, inertia = zip(*(draw(bodies()) for _ in range(n)), strict=True)
    table = {name: draw(st.tuples(*[between(-1, 1)] * n)) for name in ("a", "d")}
    table |= {name: draw(st.tuples(*[angles] * n)) for name in ("alpha", "theta")}
    joints = draw(st.tuples(*[st.sampled_from(kinds)] * n))
    return table | {"mass": mass, "com": com, "inertia": inertia, "joints": joints}


def placed(R=None, p=(0, 0, 0)) -> np.ndarray:
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = np.eye(3) if R is None else R, p
    return T


def dh_frames(table, convention, q) -> list[np.ndarray]:
    """Of each link in the base, by multiplying the four steps as the convention has them."""
    frames, T = [], np.eye(4)
    for k, kind in enumerate(table["joints"]):
        turn = table["theta"][k] + (q[k] if kind == "revolute" else 0)
        slide = table["d"][k] + (q[k] if kind == "prismatic" else 0)
        z = placed(rotation((0, 0, 1), turn), (0, 0, slide))
        x = placed(rotation((1, 0, 0), table["alpha"][k]), (table["a"][k], 0, 0))
        T = T @ (z @ x if convention == "standard" else x @ z)
        frames.append(T)
    return frames


def assert_has_bodies(chain, q, frames, table):
    """K and P are those of these bodies on these frames, and so M, C and g are, too."""
    R, p = chain.link_placements(q)
    for k, T in enumerate(frames):
        link = chain.links[k]
        assert_close(p[k] + R[k] @ link.com, T[:3, :3] @ table["com"][k] + T[:3, 3], 10)
        ours = R[k] @ np.array(link.inertia) @ R[k].T
        assert_close(ours, T[:3, :3] @ table["inertia"][k] @ T[:3, :3].T)
        assert link.mass == table["mass"][k]


@a_few
@given(dh_tables(), st.sampled_from(CONVENTIONS), st.data())
def test_the_bodies_are_where_the_table_puts_them(table, convention, data):
    chain = SerialChain.from_dh(**table, convention=convention)
    q = data.draw(vectors(chain.n))
    assert_has_bodies(chain, q, dh_frames(table, convention, q), table)
    if convention == "modified":
        R, p = chain.link_placements(q)
        for k, T in enumerate(dh_frames(table, convention, q)):
            assert_close(placed(R[k], p[k]), T, 10)


def test_the_conventions_differ():
    row = {"a": (1.0,), "alpha": (0.5,), "d": (0,), "theta": (0,), "mass": (2,), "com": [(0, 0, 1)]}
    standard, modified = (SerialChain.from_dh(**row, convention=name) for name in CONVENTIONS)
    assert_close(standard.M([0.3]), [[2 * (1 + np.sin(0.5) ** 2)]])
    assert_close(modified.M([0.3]), [[0.0]])
    assert SerialChain.from_dh(**row) == standard


def test_a_planar_arm_by_its_table():
    """l1 and l2 as a, centres of mass measured back from the ends of the links."""
    arm = SerialChain.from_dh(
        a=(0.7, 0.4),
        alpha=(0, 0),
        d=(0, 0),
        theta=(0, 0),
        mass=(2, 1),
        com=[(-0.3, 0, 0), (-0.2, 0, 0)],
        gravity=(0, -9.81, 0),
        viscous=(0.1, 0.2),
        armature=(0.5, 0),
    )
    assert_close(arm.M([0, 0])[0, 0], 2 * 0.4**2 + 0.9**2 + 0.5)
    assert_close(arm.g_vec([0, 0]), 9.81 * np.array([2 * 0.4 + 0.9, 0.2]))
    assert (arm.viscous, arm.armature, arm.links[1].name) == ((0.1, 0.2), (0.5, 0), "link2")


@st.composite
def screw_arms(draw, most=5, at_com=False):
    """The arguments of from_screws, and the bodies of the links."""
    n = draw(st.integers(1, most))
    screws, homes, spatial, parts = [], [], [], []
    for _ in range(n):
        direction, through = draw(rotations())[:, 2], np.array(draw(points(1)))
        if draw(st.booleans()):
            screws.append([*direction, *np.cross(through, direction)])
        else:
            screws.append([0, 0, 0, *direction])
        homes.append(placed(draw(rotations()), draw(points(1))))
        mass, com, inertia = draw(bodies())
        com = (0, 0, 0) if at_com else com
        parts.append((mass, com, inertia))
        spatial.append(rigid_inertia(*parts[-1]))
    mass, com, inertia = zip(*parts, strict=True)
    arm = {"screws": np.array(screws), "homes": np.array(homes), "inertias": np.array(spatial)}
    return arm, {"mass": mass, "com": com, "inertia": inertia}


@a_few
@given(screw_arms(), st.data())
def test_the_bodies_are_where_the_exponentials_put_them(case, data):
    arm, table = case
    chain = SerialChain.from_screws(**arm)
    q = data.draw(vectors(chain.n))
    turns = []
    for screw, position in zip(arm["screws"], q, strict=True):
        twist = np.zeros((4, 4))
        twist[:3, :3], twist[:3, 3] = skew(screw[:3]), screw[3:]
        turns.append(expm(twist * position))
    frames = [reduce(np.matmul, [*turns[: k + 1], home]) for k, home in enumerate(arm["homes"])]
    R, p = chain.link_placements(q)
    for k, T in enumerate(frames):
        link, ours = chain.links[k], placed(R[k], p[k])
        size = 10 * chain.n
        com = T[:3, :3] @ table["com"][k] + T[:3, 3]
        assert_close(ours[:3, :3] @ link.com + ours[:3, 3], com, size)
        assert_close(ours[:3, :3], T[:3, :3], size)
        assert_close(link.mass, table["mass"][k])
        assert_close(link.inertia, table["inertia"][k], 10 * link.mass)


@a_few
@given(spatial_chains(), st.data())
def test_a_chain_by_its_own_screws_is_itself(chain, data):
    rest = np.zeros(chain.n)
    R, p = chain.link_placements(rest)
    screws = []
    for k, link in enumerate(chain.links):
        axis = R[k] @ link.axis
        turns = link.joint == "revolute"
        screws.append([*axis, *np.cross(p[k], axis)] if turns else [0, 0, 0, *axis])
    homes = [placed(R[k], p[k]) for k in range(chain.n)]
    other = SerialChain.from_screws(
        screws, homes, chain.link_inertias(), gravity=chain.gravity, viscous=chain.viscous
    )
    q = data.draw(vectors(chain.n))
    assert_close(other.M(q), chain.M(q))
    for ours, theirs in zip(other.link_placements(q), chain.link_placements(q), strict=True):
        assert_close(ours, theirs, 10 * chain.n)


GOOD = {"a": (1, 0), "alpha": (0, 0), "d": (0, 0), "theta": (0, 0), "mass": (1, 1)}


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"a": 1.0}, r"a: got shape \(\), needs one number per joint, in m"),
        ({"a": ()}, r"a: got shape \(0,\)"),
        ({"a": ("1", "0")}, "a = .*needs one number per joint"),
        ({"a": (1, np.nan)}, r"a\[1\] = nan"),
        ({"alpha": (0,)}, r"alpha: got shape \(1,\), needs real numbers of shape \(2,\), in rad"),
        ({"d": None}, "d = None"),
        ({"theta": (0, 1e60)}, "theta = .*at most 1e"),
        ({"mass": (1, -1)}, r"mass\[1\] = .*must not be negative"),
        ({"com": (0, 0, 0)}, r"com: got shape \(3,\), needs real numbers of shape \(2, 3\)"),
        ({"inertia": np.ones((2, 3))}, r"inertia: got shape \(2, 3\)"),
        ({"inertia": [np.eye(3), np.diag([1, 1, 3])]}, "link 'link2': inertia = .*triangle"),
        ({"joints": "revolute"}, "joints = 'revolute': needs 2 of"),
        ({"joints": ["revolute"]}, r"joints = \['revolute'\]: needs 2 of"),
        ({"joints": ["revolute", "ball"]}, r"joints\[1\] = 'ball': needs"),
        ({"convention": "craig"}, "convention = 'craig': needs 'standard' or 'modified'"),
        ({"gravity": (0, 0)}, "gravity: got shape"),
    ],
)
def test_a_bad_table_is_named(change, says):
    with pytest.raises(ValueError, match=f"^{says}"):
        SerialChain.from_dh(**(GOOD | change))


ARM = {"screws": [[0, 0, 1, 0, 0, 0]], "homes": [np.eye(4)], "inertias": [np.eye(6)]}
LOPSIDED = np.eye(6) + 0.1 * np.eye(6, k=1)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"screws": [0, 0, 1, 0, 0, 0]}, r"screws: got shape \(6,\), needs real numbers of shape \(n,"),
        ({"screws": np.zeros((6, 1))}, r"screws: got shape \(6, 1\)"),
        ({"screws": np.zeros((0, 6))}, r"screws: got shape \(0, 6\)"),
        ({"screws": None}, "screws = None"),
        ({"screws": [[0, 0, 2, 0, 0, 0]]}, r"screws\[0\] = .*\(a revolute joint; has 2 and 0\)"),
        ({"screws": [[0, 0, 1, 0, 0, 0.1]]}, r"screws\[0\] = .*has 1 and 0\.1"),
        ({"screws": [[0, 0, 0, 0, 0, 2]]}, r"screws\[0\] = .*v of length 1"),
        ({"screws": np.zeros((1, 6))}, r"screws\[0\] ="),
        ({"homes": np.eye(4)}, r"homes: got shape \(4, 4\), needs real numbers of shape \(1, 4, 4\)"),
        ({"homes": [2 * np.eye(4)]}, r"homes\[0\] = .*needs a rotation"),
        ({"homes": [np.diag([1, 1, -1, 1])]}, r"homes\[0\] = .*needs a rotation"),
        ({"homes": [np.eye(4).T + np.eye(4, k=-3)]}, r"homes\[0\] = .*over the row 0 0 0 1"),
        ({"inertias": [np.eye(3)]}, r"inertias: got shape \(1, 3, 3\)"),
        ({"inertias": [LOPSIDED]}, r"inertias\[0\]: needs the spatial inertia of a rigid body"),
        ({"inertias": [np.diag([1, 1, 1, 1, 1, 2])]}, r"inertias\[0\]: needs the spatial inertia"),
        ({"inertias": [-np.eye(6)]}, r"inertias\[0\]\[3, 3\] = -1: the mass must not be negative"),
        ({"inertias": [np.diag([1, 1, 3, 1, 1, 1])]}, "link 'link1': inertia = .*triangle"),
    ],
)  # fmt: skip
def test_a_bad_screw_arm_is_named(change, says):
    with pytest.raises(ValueError, match=f"^{says}"):
        SerialChain.from_screws(**(ARM | change))


@pytest.mark.parametrize("make", [SerialChain.from_dh, SerialChain.from_screws])
def test_published_inertias_are_taken_with_a_warning(make):
    bad = np.diag([1, 1, 3])
    arguments = {SerialChain.from_dh: GOOD | {"inertia": [bad, np.eye(3)]}}
    arguments[SerialChain.from_screws] = ARM | {"inertias": [np.diag([1, 1, 3, 1, 1, 1])]}
    with pytest.warns(UserWarning, match="link 'link1': inertia"):
        chain = make(**arguments[make], triangle="warn")
    assert_close(chain.links[0].inertia, bad)
