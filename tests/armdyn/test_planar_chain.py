import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from armdyn import Pendulum, Planar2R, PlanarChain
from tests.armdyn.arms import (
    a_few,
    arms_and_states,
    assert_close,
    between,
    frictions,
    inertias,
    lengths,
    masses,
    offsets,
    planar_arms,
    vectors,
)
from tests.armdyn.identities import assert_batches, assert_canonical

THREE = {"l": (1, 0.8, 0.5), "lc": (0.5, 0.4, 0.2), "m": (3, 2, 1), "I": (0.3, 0.2, 0.1)}


@st.composite
def chains(draw, most=6):
    n = draw(st.integers(1, most))
    parts = {"l": lengths, "lc": offsets, "ly": offsets, "m": masses, "I": inertias}
    parts |= {"viscous": frictions, "coulomb": frictions}
    values = {name: draw(st.tuples(*[part] * n)) for name, part in parts.items()}
    return PlanarChain(**values, g=draw(between(0, 20)))


@a_few
@given(arms_and_states(chains()))
def test_identities(case):
    arm, q, qd, z = case
    assert_canonical(arm, q, qd, z)
    assert np.all(np.linalg.eigvalsh(arm.M(q)) > 0)


@a_few
@given(arms_and_states(planar_arms()))
def test_two_links_are_the_2r(case):
    arm, q, qd, z = case
    chain = PlanarChain(
        (arm.l1, arm.l2),
        (arm.lc1, arm.lc2),
        (arm.m1, arm.m2),
        (arm.I1, arm.I2),
        arm.g,
        viscous=arm.viscous,
        coulomb=arm.coulomb,
    )
    size = np.max(np.abs(arm.M(q)))
    weight = arm.g * (arm.m1 * abs(arm.lc1) + arm.m2 * (arm.l1 + abs(arm.lc2)))
    assert_close(chain.M(q), arm.M(q), size, 1e-13)
    assert_close(chain.C(q, qd), arm.C(q, qd), 6 * size, 1e-13)
    assert_close(chain.g_vec(q), arm.g_vec(q), weight, 1e-13)
    assert_close(chain.potential_energy(q), arm.potential_energy(q), weight, 1e-13)
    np.testing.assert_array_equal(chain.f_vec(qd), arm.f_vec(qd))
    u = arm.inverse_dynamics(q, qd, z)
    assert_close(chain.inverse_dynamics(q, qd, z), u, 36 * size + weight, 1e-13)


@a_few
@given(arms_and_states(chains(), parts=2))
def test_energies_are_those_of_the_moving_bodies(case):
    """The centres of mass placed one link after the other, their velocities by difference."""
    arm, q, qd = case

    def com(q):
        where, angle, places = 0, 0, []
        for k in range(arm.n):
            angle = angle + q[..., k]
            along = np.exp(1j * angle)
            places.append(where + (arm.lc[k] + 1j * arm.ly[k]) * along)
            where = where + arm.l[k] * along
        return np.stack(places, axis=-1)

    m, I = np.array(arm.m), np.array(arm.I)
    h = 1e-5
    velocity = (com(q + h * qd) - com(q - h * qd)) / (2 * h)
    K = 0.5 * np.sum(m * np.abs(velocity) ** 2 + I * np.cumsum(qd, axis=-1) ** 2, axis=-1)
    assert_close(arm.kinetic_energy(q, qd), K, np.max(np.abs(arm.M(q))) * 36, 1e-6)
    P = arm.g * np.sum(m * com(q).imag, axis=-1)
    assert_close(arm.potential_energy(q), P, arm.g * np.sum(m) * np.sum(arm.l))


@a_few
@given(arms_and_states(chains(), parts=2))
def test_the_first_angle_enters_neither_m_nor_c(case):
    arm, q, qd = case
    turned = q.copy()
    turned[..., 0] += 1.7
    np.testing.assert_array_equal(arm.M(turned), arm.M(q))
    np.testing.assert_array_equal(arm.C(turned, qd), arm.C(q, qd))


@a_few
@given(chains(most=5), st.data())
def test_with_its_last_joint_locked_it_is_a_shorter_chain(arm, data):
    """A point on the last link becomes a part of the link before."""
    if arm.n == 1:
        return
    k = arm.n - 2
    angle = data.draw(between(-3, 3))
    q, qd, z = (data.draw(vectors(arm.n - 1)) for _ in range(3))
    last = arm.l[k] + (arm.lc[-1] + 1j * arm.ly[-1]) * np.exp(1j * angle)
    first = arm.lc[k] + 1j * arm.ly[k]
    m = arm.m[k] + arm.m[-1]
    both = (arm.m[k] * first + arm.m[-1] * last) / m
    I = arm.I[k] + arm.I[-1]
    I += arm.m[k] * abs(first - both) ** 2 + arm.m[-1] * abs(last - both) ** 2
    short = PlanarChain(
        arm.l[:-1],
        (*arm.lc[:k], both.real),
        (*arm.m[:k], m),
        (*arm.I[:k], I),
        arm.g,
        ly=(*arm.ly[:k], both.imag),
        viscous=arm.viscous[:-1],
        coulomb=arm.coulomb[:-1],
    )
    u = arm.inverse_dynamics([*q, angle], [*qd, 0.0], [*z, 0.0])
    size = 36 * np.max(np.abs(arm.M([*q, angle])))
    assert_close(short.inverse_dynamics(q, qd, z), u[:-1], size + np.max(np.abs(u)))


@a_few
@given(masses, lengths, inertias, between(-6, 6), between(-6, 6))
def test_one_link_is_a_pendulum_seen_from_the_horizontal(m, lc, I, q, qd):
    chain, pendulum = PlanarChain((1,), (lc,), (m,), (I,)), Pendulum.from_com(m, lc, I)
    assert_close(chain.M([q]), pendulum.M([q]))
    np.testing.assert_array_equal(chain.C([q], [qd]), np.zeros((1, 1)))
    assert_close(chain.g_vec([q]), pendulum.g_vec([q + np.pi / 2]), m * lc * 10)


@a_few
@given(arms_and_states(chains()))
def test_a_batch_is_its_states_one_by_one(case):
    methods = {
        "M": ("q", 2),
        "C": ("q qd", 2),
        "g_vec": ("q", 1),
        "f_vec": ("qd", 1),
        "potential_energy": ("q", 0),
        "inverse_dynamics": ("q qd z", 1),
        "dynamics": ("q qd z", 1),
    }
    assert_batches(*case, methods)


def test_arguments_are_left_as_they_are():
    q = np.array([0.1, 0.2, 0.3])
    PlanarChain(**THREE).M(q)
    np.testing.assert_array_equal(q, [0.1, 0.2, 0.3])


def test_chains_are_values():
    arm = PlanarChain(**THREE)
    same = PlanarChain(**{name: np.array(value) for name, value in THREE.items()}, ly=[0, 0, 0])
    assert arm == same
    assert hash(arm) == hash(same)
    assert arm != PlanarChain(**THREE, g=1.62)
    assert arm.n == 3
    with pytest.raises(AttributeError):
        arm.m = (1, 1, 1)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"l": (1, 0, 1)}, r"^l\[1\] = 0: must be greater than 0 m"),
        ({"l": 1.0}, r"^l = 1\.0: needs a sequence of link lengths"),
        ({"l": ()}, r"^l = \(\): needs a sequence"),
        ({"l": "123"}, r"^l = '123': needs a sequence"),
        ({"l": np.array(2.0)}, r"^l = array\(2\.\): needs a sequence"),
        ({"lc": (0, np.nan, 0)}, r"^lc\[1\] = nan: needs one finite number, in m"),
        ({"lc": None}, r"^lc = None: needs 3 numbers, one per entry of l"),
        ({"m": (1, 2)}, r"^m = \(1, 2\): needs 3 numbers, one per entry of l, in kg"),
        ({"m": (1, 2, -3)}, r"^m\[2\] = -3: must not be negative"),
        ({"I": {1, 2, 3}}, r"^I = \{1, 2, 3\}: needs 3 numbers"),
        ({"I": (1, 2, True)}, r"^I\[2\] = True"),
        ({"ly": (0, np.inf, 0)}, r"^ly\[1\] = inf"),
        ({"g": None}, r"^g = None: needs one finite number"),
        ({"viscous": (0, 0, -1)}, r"^viscous\[2\] = -1: must not be negative"),
        ({"coulomb": (0, 0)}, r"^coulomb = \(0, 0\): needs 3 numbers"),
    ],
)
def test_a_bad_parameter_is_named(change, says):
    with pytest.raises(ValueError, match=says):
        PlanarChain(**(THREE | change))


def test_a_bad_state_is_named():
    arm = PlanarChain(**THREE)
    with pytest.raises(ValueError, match=r"^q: got shape \(2,\).*\(\.\.\., 3\)"):
        arm.M([0, 0])
    with pytest.raises(ValueError, match=r"^qd"):
        arm.C([0, 0, 0], [0, 0, np.nan])


def test_a_massless_tip_is_singular():
    arm = PlanarChain((1, 1, 1), (0.5, 0.5, 0.5), (1, 1, 0), (0.1, 0.1, 0))
    with pytest.raises(np.linalg.LinAlgError, match="singular"):
        arm.dynamics([0, 1, 2], [0, 0, 0], [0, 0, 0])


def test_the_elbow_of_the_2r_is_that_of_the_chain():
    arm = Planar2R(1, 1, 0.5, 0.5, 1, 1, 0.1, 0.1)
    up = PlanarChain((1, 1), (0.5, 0.5), (1, 1), (0.1, 0.1), ly=(0, 0.2))
    # Link 2 along x, its centre of mass raised by 0.2: gravity's lever of joint 1 is unchanged.
    assert_close(up.g_vec([0, 0]), arm.g_vec([0, 0]))
    # Turned up, the same centre of mass lies 0.2 to the left.
    assert_close(up.g_vec([np.pi / 2, 0]), [-0.2 * 9.81, -0.2 * 9.81])
