from dataclasses import fields, replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from armdyn import Link, SerialChain
from armdyn.spatial import rotation
from tests.armdyn.arms import a_few, arms_and_states, assert_close, between, masses, vectors
from tests.armdyn.chains import links, points, rotations, spatial, spatial_chains
from tests.armdyn.identities import assert_batches, assert_canonical
from tests.armdyn.test_planar_chain import chains

RP = (
    Link("revolute", 2.0, com=(0.3, 0, 0), inertia=np.diag([0.1, 0.2, 0.2]), name="boom"),
    Link("prismatic", 1.5, inertia=np.diag([0.05] * 3), axis=(1, 0, 0), name="slide"),
)


@a_few
@given(arms_and_states(spatial_chains()))
def test_identities(case):
    assert_canonical(*case)


@a_few
@given(arms_and_states(spatial_chains(most=7)))
def test_the_recursive_algorithms_give_what_the_jacobians_give(case):
    arm, q, qd, z = case
    M, u = arm.M(q), arm.inverse_dynamics(q, qd, z)
    assert_close(arm.crba(q), M)
    size = np.max(np.abs(M)) * 36 + np.max(np.abs(arm.g_vec(q))) + np.max(np.abs(u))
    assert_close(arm.rnea(q, qd, z), u, size)
    worst = np.max(np.linalg.cond(M))
    assert_close(arm.aba(q, qd, u), z, 36, max(1e-12, 1e-14 * worst))
    qdd = arm.dynamics(q, qd, z)
    assert_close(arm.aba(q, qd, z), qdd, 36, max(1e-12, 1e-14 * worst))


@a_few
@given(arms_and_states(chains()))
def test_in_the_plane_it_is_the_planar_chain(case):
    planar, q, qd, z = case
    arm = spatial(planar)
    size = np.max(np.abs(planar.M(q)))
    weight = np.max(np.abs(planar.g_vec(np.zeros(planar.n)))) + np.max(np.abs(planar.g_vec(q)))
    assert_close(arm.M(q), planar.M(q), size)
    assert_close(arm.C(q, qd), planar.C(q, qd), size * 6)
    assert_close(arm.g_vec(q), planar.g_vec(q), weight)
    reach = planar.g * sum(planar.m) * (sum(planar.l) + 3)
    assert_close(arm.potential_energy(q), planar.potential_energy(q), reach)
    assert_close(arm.rnea(q, qd, z), planar.inverse_dynamics(q, qd, z), size * 36 + weight)


@a_few
@given(arms_and_states(spatial_chains(), parts=2))
def test_the_jacobians_are_the_rates_of_the_placements(case):
    arm, q, qd = case
    h = 1e-5
    (R_on, p_on), (R_back, p_back) = (arm.link_placements(q + s * h * qd) for s in (1, -1))
    R, _ = arm.link_placements(q)
    spin = np.swapaxes(R, -1, -2) @ (R_on - R_back) / (2 * h)
    omega = np.stack([spin[..., 2, 1], spin[..., 0, 2], spin[..., 1, 0]], axis=-1)
    v = np.vecmat((p_on - p_back) / (2 * h), R)
    velocity = np.concatenate([omega, v], axis=-1)
    J = arm.link_jacobians(q)
    assert_close(np.matvec(J, qd[..., np.newaxis, :]), velocity, 100, 1e-7)
    # A link is moved by the joints before it alone.
    for k in range(arm.n):
        np.testing.assert_array_equal(J[..., k, :, k + 1 :], 0)
    I = arm.link_inertias()
    assert_close(np.einsum("...kai,kab,...kbj->...ij", J, I, J), arm.M(q))


@a_few
@given(arms_and_states(spatial_chains()), rotations(), points(2))
def test_a_base_turned_with_gravity_changes_nothing(case, turn, shift):
    arm, q, qd, z = case
    first = arm.links[0]
    moved = replace(
        first,
        rotation=turn @ np.array(first.rotation),
        translation=turn @ np.array(first.translation) + shift,
    )
    other = replace(arm, links=(moved, *arm.links[1:]), gravity=turn @ np.array(arm.gravity))
    u = arm.rnea(q, qd, z)
    size = 36 * np.max(np.abs(arm.M(q)))
    assert_close(other.M(q), arm.M(q))
    assert_close(other.C(q, qd), arm.C(q, qd), size)
    assert_close(other.rnea(q, qd, z), u, size)
    mass = sum(link.mass for link in arm.links)
    P = arm.potential_energy(q) - mass * np.dot(other.gravity, shift)
    assert_close(other.potential_energy(q), P, mass * 200)


@a_few
@given(arms_and_states(spatial_chains()), st.integers(-9, 9), st.integers(-8, 6))
def test_other_units_of_mass_and_length(case, kilo, metre):
    """Grams or tonnes, microns or kilometres: the same arm."""
    arm, q, qd, z = case
    r, s = 10.0**kilo, 10.0**metre
    scaled = tuple(
        replace(
            link,
            mass=link.mass * r,
            com=np.array(link.com) * s,
            inertia=np.array(link.inertia) * r * s**2,
            translation=np.array(link.translation) * s,
        )
        for link in arm.links
    )
    unit = np.array([1.0 if link.joint == "revolute" else s for link in arm.links])
    other = SerialChain(scaled, gravity=np.array(arm.gravity) * s)
    arm = SerialChain(arm.links, arm.gravity)
    there = (q * unit, qd * unit, z * unit)
    force = r * s**2 / unit
    M = arm.M(q)
    assert_close(other.M(there[0]) / (force[:, np.newaxis] / unit), M)
    size = 36 * np.max(np.abs(M)) + np.max(np.abs(arm.g_vec(q)))
    assert_close(other.rnea(*there) / force, arm.rnea(q, qd, z), size, 1e-11)
    u = arm.rnea(q, qd, z)
    worst = np.max(np.linalg.cond(M))
    accelerations = other.aba(*there[:2], u * force) / unit
    assert_close(accelerations, z, 36, max(1e-11, 1e-13 * worst))


@a_few
@given(between(-6, 6), between(-2, 2), vectors(2), vectors(2))
def test_a_boom_with_a_slide(q1, q2, qd, qdd):
    """Polar coordinates: M = diag(I + m2 r², m2), C q̇ = m2 (2 r ṙ θ̇, −r θ̇²)."""
    arm = SerialChain(RP, gravity=(0, -9.81, 0))
    M11 = 0.2 + 2.0 * 0.3**2 + 0.05 + 1.5 * q2**2
    assert_close(arm.M([q1, q2]), np.diag([M11, 1.5]))
    coriolis = [2 * 1.5 * q2 * qd[1] * qd[0], -1.5 * q2 * qd[0] ** 2]
    assert_close(arm.C([q1, q2], qd) @ qd, coriolis, 200)
    g = [9.81 * (2.0 * 0.3 + 1.5 * q2) * np.cos(q1), 9.81 * 1.5 * np.sin(q1)]
    assert_close(arm.g_vec([q1, q2]), g, 30)
    P = 9.81 * (2.0 * 0.3 + 1.5 * q2) * np.sin(q1)
    assert_close(arm.potential_energy([q1, q2]), P, 30)
    assert_close(arm.rnea([q1, q2], qd, qdd), np.diag(arm.M([q1, q2])) * qdd + coriolis + g, 500)


@a_few
@given(masses, between(0.1, 2), between(-3, 3), between(-3, 3), vectors(2))
def test_a_spherical_pendulum(m, l, azimuth, tilt, qd):
    """A point mass on a rod, about the vertical and then a horizontal axis."""
    arm = SerialChain(
        (
            Link("revolute", 0),
            Link("revolute", m, com=(l, 0, 0), rotation=rotation((1, 0, 0), -np.pi / 2)),
        )
    )
    # The second axis is (0, 1, 0) at rest: a positive tilt lowers the mass.
    q = [azimuth, tilt]
    assert_close(arm.M(q), m * l**2 * np.diag([np.cos(tilt) ** 2, 1]))
    assert_close(arm.g_vec(q), [0, -m * 9.81 * l * np.cos(tilt)], m * l * 10)
    rate = -m * l**2 * np.sin(tilt) * np.cos(tilt)
    expected = rate * np.array([[qd[1], qd[0]], [-qd[0], 0]])
    assert_close(arm.C(q, qd), expected, m * l**2 * 6)


@a_few
@given(arms_and_states(spatial_chains(most=3)))
def test_a_batch_is_its_states_one_by_one(case):
    methods = {
        "M": ("q", 2),
        "crba": ("q", 2),
        "C": ("q qd", 2),
        "g_vec": ("q", 1),
        "f_vec": ("qd", 1),
        "potential_energy": ("q", 0),
        "kinetic_energy": ("q qd", 0),
        "inverse_dynamics": ("q qd z", 1),
        "rnea": ("q qd z", 1),
    }
    assert_batches(*case, methods)
    arm, q, qd, z = case
    together = arm.aba(q, qd, z)
    tolerance = max(1e-11, 1e-14 * np.max(np.linalg.cond(arm.M(q))))
    for at in np.ndindex(q.shape[:-1]):
        one = arm.aba(q[at], qd[at], z[at])
        assert_close(together[at], one, np.max(np.abs(together)), tolerance)


@a_few
@given(spatial_chains(most=3), st.data())
def test_batch_axes_broadcast(arm, data):
    n = arm.n
    q = data.draw(vectors(n, batch=(5, 1)))
    qd = data.draw(vectors(n, batch=(3,)))
    z = data.draw(vectors(n))
    full = [np.broadcast_to(a, (5, 3, n)) for a in (q, qd, z)]
    size = np.max(np.abs(arm.M(q))) * 36
    assert_close(arm.C(q, qd), arm.C(*full[:2]), size)
    assert_close(arm.C(q[0, 0], qd), arm.C(full[0][0, 0], qd), size)
    for few in ((q, qd, z), (q[0], qd, full[2])):
        many = [np.broadcast_to(a, (5, 3, n)) for a in few]
        assert_close(arm.rnea(*few) + np.zeros((5, 3, n)), arm.rnea(*many), size)
        accelerations = arm.aba(*few) + np.zeros((5, 3, n))
        assert_close(accelerations, arm.aba(*many), np.max(np.abs(accelerations)), 1e-9)


def test_an_empty_batch_stays_empty():
    arm, q = SerialChain(RP), np.empty((0, 2))
    assert arm.M(q).shape == arm.crba(q).shape == arm.C(q, q).shape == (0, 2, 2)
    assert arm.aba(q, q, q).shape == arm.rnea(q, q, q).shape == (0, 2)


def test_one_at_rest_stays_one():
    placements = SerialChain(RP).link_placements([0, 0])
    np.testing.assert_array_equal(placements[0], [np.eye(3)] * 2)
    np.testing.assert_array_equal(placements[1], np.zeros((2, 3)))


def test_friction_enters_both_ways():
    arm = SerialChain(RP, viscous=(0.3, 0.2), coulomb=(0.1, 0.4))
    bare = SerialChain(RP)
    q, qd, z = [0.3, 0.2], [2.0, -3.0], [1.0, 4.0]
    f = np.array([0.3 * 2 + 0.1, -0.2 * 3 - 0.4])
    assert_close(arm.rnea(q, qd, z), bare.rnea(q, qd, z) + f)
    assert_close(arm.aba(q, qd, z), bare.aba(q, qd, z - f))


@pytest.mark.parametrize(
    ("links", "joint"),
    [
        # A point mass on the axis of its joint.
        ((Link("revolute", 1, com=(1, 0, 0)), Link("revolute", 1)), 2),
        # Two slides along one line, the first without mass: the second takes all of it.
        ((Link("prismatic", 0), Link("prismatic", 1)), 1),
        ((Link("revolute", 0),), 1),
    ],
)
def test_a_motion_without_kinetic_energy_is_refused(links, joint):
    arm = SerialChain(links)
    none = np.zeros(arm.n)
    with pytest.raises(np.linalg.LinAlgError, match=rf"singular.*from joint {joint} outwards"):
        arm.aba(none, none, none)
    with pytest.raises(np.linalg.LinAlgError, match="singular"):
        arm.dynamics(none, none, none)


def test_a_very_light_last_link_is_not_singular():
    light = Link("revolute", 1e-9, com=(0.1, 0, 0), translation=(1, 0, 0))
    assert np.isfinite(SerialChain((*RP, light)).aba([0, 1, 2], [1, 1, 1], [0, 0, 0])).all()


@a_few
@given(links())
def test_links_are_values(link):
    again = Link(**{f.name: getattr(link, f.name) for f in fields(link)})
    names = ("com", "inertia", "axis", "rotation", "translation")
    arrays = replace(link, **{name: np.array(getattr(link, name)) for name in names})
    assert link == again == arrays
    assert hash(link) == hash(arrays)
    chain = SerialChain([link])
    assert chain == SerialChain((arrays,), np.array([0, 0, -9.81]), viscous=[0])
    assert hash(chain) == hash(SerialChain((arrays,)))


@a_few
@given(links(), st.floats(1e-12, 9e-10))
def test_numbers_from_a_file_are_made_exact(link, error):
    off = np.full((3, 3), error / 8)
    rough = replace(link, rotation=np.array(link.rotation) + off, axis=np.array(link.axis) + off[0])
    R, axis = np.array(rough.rotation), np.array(rough.axis)
    assert_close(R.T @ R, np.eye(3), 1, 1e-14)
    assert_close(np.linalg.norm(axis), 1.0, 1, 1e-15)
    assert_close(R, link.rotation, 1, error)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"joint": "ball"}, "joint = 'ball': needs 'revolute' or 'prismatic'"),
        ({"joint": None}, "joint = None"),
        ({"mass": -1}, "mass = -1: must not be negative"),
        ({"mass": "1"}, "mass = '1'"),
        ({"com": (0, 0)}, r"com: got shape \(2,\), needs real numbers of shape \(3,\), in m"),
        ({"com": (0, np.nan, 0)}, r"com\[1\] = nan"),
        ({"com": (0, 1e60, 0)}, "com = .*at most 1e\\+50 m"),
        ({"translation": None}, "translation = None"),
        ({"axis": (0, 0, 2)}, r"axis = \[0\.0, 0\.0, 2\.0\]: needs length 1, has 2"),
        ({"axis": (0, 0, 0)}, "axis = .*has 0"),
        ({"axis": (0, 0, 1 + 1e-8)}, "axis = .*needs length 1"),
        ({"rotation": np.eye(2)}, r"rotation: got shape \(2, 2\)"),
        ({"rotation": 2 * np.eye(3)}, "rotation = .*needs orthogonal columns of length 1"),
        ({"rotation": 1.5 * np.eye(3)}, "rotation = .*needs orthogonal columns of length 1"),
        ({"rotation": np.diag([1e40, 1, 1])}, "rotation = .*needs orthogonal columns"),
        ({"rotation": np.diag([1, 1, -1])}, "rotation = .*a reflection"),
        ({"inertia": [[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]}, "inertia = .*needs a symmetric matrix"),
        ({"inertia": np.diag([1, 1, -0.1])}, r"inertia = .*negative principal moment -0\.1"),
        ({"inertia": np.diag([1, 1, 2.1])}, r"inertia = .*1, 1, 2\.1 break the triangle"),
        ({"inertia": [[1, 1, 1]] * 2}, r"inertia: got shape \(2, 3\)"),
        ({"triangle": True}, "triangle = True: needs 'error' or 'warn'"),
        ({"inertia": [[1, 1], [1]]}, "inertia = .*different lengths"),
    ],
)
def test_a_bad_link_is_named(change, says):
    good = {"joint": "revolute", "mass": 1.0}
    with pytest.raises(ValueError, match=f"^{says}"):
        Link(**(good | change))
    with pytest.raises(ValueError, match=f"^link 'forearm': {says}"):
        Link(**(good | change), name="forearm")


@pytest.mark.parametrize("principal", [(0, 0.35, 0), (1, 1, -0.1)])
def test_a_published_inertia_that_no_body_can_have(principal):
    """The first is that of link 1 of the PUMA 560 in Corke and Armstrong-Hélouvry (1994)."""
    inertia = np.diag(principal)
    with pytest.warns(UserWarning, match=r"^link 'trunk': inertia = .*(triangle|negative)"):
        link = Link("revolute", 0, inertia=inertia, name="trunk", triangle="warn")
    np.testing.assert_array_equal(link.inertia, inertia)
    assert_close(SerialChain((link,)).M([0.3]), [[principal[2]]])
    with pytest.raises(ValueError, match=r"triangle=\"warn\""):
        Link("revolute", 0, inertia=inertia, name="trunk")


def test_rounding_of_a_point_mass_s_inertia_is_no_negative_moment():
    """iCub's links are point masses whose inertia a program has subtracted."""
    rounded = np.diag([-5.4e-20, -5.4e-20, 0])
    assert Link("revolute", 0.526, com=(0, 0, 0.03), inertia=rounded).mass == 0.526
    with pytest.raises(ValueError, match="negative principal moment"):
        Link("revolute", 0.526, com=(0, 0, 0.03), inertia=1e8 * rounded)


def test_a_name_is_text():
    with pytest.raises(ValueError, match=r"^name = 3: needs text"):
        Link("revolute", 1.0, name=3)


def test_extreme_inertias_a_body_can_have():
    for inertia in ([0, 0, 0], [0, 1, 1], [1, 1, 2]):
        assert Link("revolute", 1, inertia=np.diag(inertia)).inertia[2][2] == inertia[2]


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"links": ()}, r"^links = \(\): needs one Link or more"),
        ({"links": RP[0]}, r"^links = Link\(.*needs one Link or more"),
        ({"links": (RP[0], "boom")}, r"^links\[1\] = 'boom': needs a Link"),
        ({"gravity": (0, 9.81)}, r"^gravity: got shape \(2,\)"),
        ({"gravity": np.zeros((2, 3))}, r"^gravity: got shape \(2, 3\)"),
        ({"gravity": (0, np.inf, 0)}, r"^gravity\[1\] = inf"),
        ({"gravity": (0, 1e60, 0)}, r"^gravity\[1\] = .*1e\+60"),
        ({"viscous": (1,)}, r"^viscous = \(1,\): needs 2 numbers, one per joint"),
        ({"coulomb": (1, -1)}, r"^coulomb\[1\] = -1: must not be negative"),
    ],
)
def test_a_bad_chain_is_named(change, says):
    with pytest.raises(ValueError, match=says):
        SerialChain(**({"links": RP} | change))


@pytest.mark.parametrize("method", ["M", "crba", "g_vec", "potential_energy", "link_jacobians"])
def test_a_bad_q_is_named(method):
    with pytest.raises(ValueError, match=r"^q: got shape \(3,\).*\(\.\.\., 2\)"):
        getattr(SerialChain(RP), method)([0, 0, 0])


@pytest.mark.parametrize(("method", "last"), [("rnea", "qdd"), ("aba", "u")])
def test_a_bad_last_argument_is_named(method, last):
    with pytest.raises(ValueError, match=rf"^{last}\[0\] = nan"):
        getattr(SerialChain(RP), method)([0, 0], [0, 0], [np.nan, 0])


class Floating:
    def g_vec(self, q):
        return np.zeros_like(np.asarray(q, dtype=float))


class Heavier:
    def M(self, q):
        return 2 * super().M(q)


class Slippery:
    def f_vec(self, qd):
        return 3 * np.asarray(qd)


class Space(Floating, SerialChain):
    pass


class Loaded(Heavier, SerialChain):
    pass


class Oiled(Slippery, SerialChain):
    pass


def test_the_algorithms_on_the_links_refuse_another_term():
    q, qd, u = np.array([0.3, 0.4]), np.array([1.0, 2.0]), np.array([0.1, 0.2])
    for kind, term in ((Space, "g_vec"), (Loaded, "M")):
        arm = kind(RP)
        says = f"is of the links; this {kind.__name__} has another {term}: use"
        for name in ("aba", "rnea"):
            with pytest.raises(ValueError, match=f"^{name} {says}"):
                getattr(arm, name)(q, qd, u)
        with pytest.raises(ValueError, match=f"^derivation {says}"):
            arm.derivation()
    with pytest.raises(ValueError, match=r"^crba is of the links; this Loaded"):
        Loaded(RP).crba(q)
    np.testing.assert_allclose(Space(RP).crba(q), Space(RP).M(q))
    oiled = Oiled(RP)
    np.testing.assert_allclose(oiled.aba(q, qd, u), oiled.dynamics(q, qd, u), rtol=1e-12)
    with pytest.raises(ValueError, match=r"^derivation is of the links; this Oiled"):
        oiled.derivation()
