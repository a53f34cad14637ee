"""Equilibria: all of them, in rest, and of the kind that a push shows."""

from functools import cache

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from armdyn import Link, Manipulator, Pendulum, Planar2R, PlanarChain, SerialChain
from armdyn.codegen import numpy_model
from armdyn.derive import from_energies
from armdyn.equilibria import equilibria
from tests.armdyn.arms import between


def places(model):
    """Each equilibrium's kind and angles, in degrees; −180° is 180°."""
    found = [(point.kind, *np.degrees(point.q).round(4)) for point in equilibria(model)]
    return {(kind, *(180.0 if a == -180 else a + 0.0 for a in angles)) for kind, *angles in found}


def test_the_pendulum_hangs_or_stands():
    found = equilibria(Pendulum(m=2.0, lc=0.5, I=0.6))
    assert [point.kind for point in found] == ["minimum", "maximum"]
    assert found[0].q == pytest.approx([0], abs=1e-9)
    assert abs(found[1].q[0]) == pytest.approx(np.pi)
    assert found[0].stiffness == pytest.approx([2.0 * 9.81 * 0.5])


@settings(max_examples=10)
@given(*[between(0.2, 2)] * 4, between(0.2, 20))
def test_the_2r_has_four(l1, lc1, lc2, m1, g):
    arm = Planar2R(l1, 1.0, lc1, lc2, m1, 1.5, 0.2, 0.1, g=g)
    assert places(arm) == {
        ("minimum", -90, 0),
        ("saddle", -90, 180),
        ("saddle", 90, 180),
        ("maximum", 90, 0),
    }


def test_a_heavy_counterweight_turns_the_first_link_over():
    """With m1 lc1 + m2 l1 < 0 link 1 rests upwards, and then link 2 hangs where q2 = 180°."""
    arm = Planar2R(0.5, 0.4, -1.0, 0.2, 4.0, 1.0, 0.2, 0.1)
    assert ("minimum", 90, 180) in places(arm)
    assert ("maximum", -90, 180) in places(arm)


@settings(max_examples=10)
@given(st.integers(1, 3), st.integers(0, 2**32 - 1))
def test_chains_with_centres_off_the_links(n, seed):
    rng = np.random.default_rng(seed)
    l, lc, m, I = rng.uniform(0.3, 1, (4, n))
    chain = PlanarChain(
        tuple(l), tuple(lc), tuple(m), tuple(I), ly=tuple(rng.uniform(-0.3, 0.3, n))
    )
    found = equilibria(chain)
    # Each absolute angle is a pendulum of its own: up or down.
    assert len(found) == 2**n
    assert [point.kind for point in found][:: len(found) - 1] == ["minimum", "maximum"]
    for point in found:
        assert chain.g_vec(point.q) == pytest.approx(0, abs=1e-8)
        rates = chain.state_derivative(np.concatenate([point.q, np.zeros(n)]), np.zeros(n))
        assert rates == pytest.approx(0, abs=1e-6)
        higher = [
            chain.potential_energy(point.q + push) > chain.potential_energy(point.q)
            for push in 1e-3 * np.concatenate([np.eye(n), -np.eye(n), rng.normal(size=(20, n))])
        ]
        if point.kind == "minimum":
            assert all(higher)
        elif point.kind == "maximum":
            assert not any(higher)


def test_without_gravity_or_off_centre_mass_none_is_isolated():
    for arm in (
        Pendulum(m=1.0, lc=0.5, I=0.3, g=0.0),
        Planar2R(1, 1, 0.5, 0.0, 1, 1, 0.1, 0.1),
        Planar2R(1, 1, 0.5, 0.5, 1, 0, 0.1, 0.1),
    ):
        with pytest.raises(ValueError, match=r"^model = .*not isolated"):
            equilibria(arm)


def test_more_than_three_joints_are_too_many():
    with pytest.raises(ValueError, match="needs up to 3 joints, has 4"):
        equilibria(PlanarChain((1.0,) * 4, (0.5,) * 4, (1.0,) * 4, (0.1,) * 4))


class Potential(Manipulator):
    """One coordinate, of which only g and P are asked for."""

    n = 1
    M = C = None

    def __init__(self, g, P):
        self.g, self.P = g, P

    def g_vec(self, q):
        return self.g(np.asarray(q, float))

    def potential_energy(self, q):
        return self.P(np.asarray(q, float)[..., 0])


def test_a_count_that_never_agrees_is_an_error():
    def sawtooth(q):
        """It jumps at ±π, so that one zero stands alone on the circle."""
        return (q + np.pi) % (2 * np.pi) - np.pi

    with pytest.raises(RuntimeError, match=r"not all equilibria of .* were found"):
        equilibria(Potential(sawtooth, lambda q: sawtooth(q) ** 2 / 2))


x, angle = q = sp.symbols("x theta", real=True)
xd, angled = qd = sp.symbols("xd thetad", real=True)


@cache
def cart_pole_on_a_spring():
    cart, m, l, g, k, rest = sp.symbols("M m l g k rest", positive=True)
    K = cart * xd**2 / 2 + m * (xd**2 + l**2 * angled**2 + 2 * l * xd * angled * sp.cos(angle)) / 2
    return from_energies(K, k * (x - rest) ** 2 / 2 - m * g * l * sp.cos(angle), q, qd)


@settings(max_examples=15)
@given(between(-60, 60), st.floats(-3, 4), between(0.2, 5))
def test_a_length_is_not_an_angle(rest, magnitude, m):
    """A cart on a spring that rests at 5 m once came back at −1.283 m, with g = −62.8 N."""
    values = {"M": 1.0, "m": m, "l": 0.5, "g": 9.81, "k": 10**magnitude, "rest": rest}
    model = numpy_model(cart_pole_on_a_spring(), values)
    found = equilibria(model)
    assert [point.kind for point in found] == ["minimum", "saddle"]
    for point, expected in zip(found, (0, np.pi), strict=True):
        assert point.q[0] == pytest.approx(rest, abs=1e-6)
        assert abs(point.q[1]) == pytest.approx(expected, abs=1e-6)
        force, torque = model.g_vec(point.q)
        assert abs(force) < 1e-6 * values["k"]
        assert abs(torque) < 1e-6 * m


@pytest.mark.parametrize("pull", [0.3, 5.0])
def test_a_slide_on_a_turning_beam_balances_where_its_weight_does(pull):
    """No spring and no turn bounds the slide: two saddles, and not the even count of a torus."""
    beam = Link("revolute", 2.0 * pull, com=(1.0, 0, 0), inertia=0.2 * np.eye(3))
    slide = Link("prismatic", 0.5, axis=(1, 0, 0), inertia=0.1 * np.eye(3))
    found = equilibria(SerialChain((beam, slide), gravity=(0, -9.81, 0)), [(-9, 9), (-30, 30)])
    assert [point.kind for point in found] == ["saddle", "saddle"]
    assert sorted(abs(point.q[0]) for point in found) == pytest.approx([0, np.pi], abs=1e-8)
    assert [point.q[1] for point in found] == pytest.approx([-2.0 * pull / 0.5] * 2)


def test_only_angles_are_repeated_in_a_wider_picture():
    arm = Planar2R(1.0, 0.8, 0.5, 0.4, 2.0, 1.5, 0.2, 0.1)
    down = equilibria(arm)[0]
    wide = down.between(-2 * np.pi, 2 * np.pi)
    assert {tuple(place) for place in wide.round(6)} == {
        (round(a, 6), b)
        for a in (-np.pi / 2, 3 * np.pi / 2)
        for b in (round(-2 * np.pi, 6), 0, round(2 * np.pi, 6))
    }
    np.testing.assert_allclose(arm.g_vec(wide), 0, atol=1e-7)
    rest = equilibria(Potential(lambda q: q - 1, lambda q: (q - 1) ** 2 / 2))[0]
    np.testing.assert_allclose(rest.between(-20, 20), [[1.0]])
    assert rest.between(2, 20).shape == (0, 1)


def test_what_falls_has_no_equilibrium():
    lift = Link("prismatic", 3.0, axis=(0, 0, 1), inertia=np.eye(3))
    assert equilibria(SerialChain((lift,))) == ()
    assert equilibria(Potential(lambda q: np.exp(-q), lambda q: -np.exp(-q))) == ()


def test_a_joint_with_a_spring_is_not_wrapped():
    """Weak gravity, a stiff spring that rests after two turns: only there is it at rest."""
    rest = 4 * np.pi + 0.5
    found = equilibria(
        Potential(
            lambda q: 50 * (q - rest) + np.sin(q),
            lambda q: 25 * (q - rest) ** 2 - np.cos(q),
        )
    )
    assert [point.kind for point in found] == ["minimum"]
    assert abs(found[0].q[0] - rest) < 0.05


def test_a_motor_that_turns_it_over_leaves_a_pendulum_two_equilibria():
    """g is the same after a turn, P is not: no theorem counts them, but they can be wrapped."""
    bias = 0.5
    model = Potential(lambda q: np.sin(q) - bias, lambda q: -np.cos(q) - bias * q)
    found = equilibria(model)
    assert [point.q[0] for point in found] == pytest.approx(
        [np.arcsin(bias), np.pi - np.arcsin(bias)]
    )
    assert equilibria(Potential(lambda q: np.sin(q) - 2, lambda q: -np.cos(q) - 2 * q)) == ()


def test_the_range_of_a_slide_may_be_given():
    model = Potential(lambda q: q - 4000, lambda q: (q - 4000) ** 2 / 2)
    assert equilibria(model, [(3000, 5000)])[0].q == pytest.approx([4000])


@pytest.mark.parametrize(
    ("within", "says"),
    [
        ((0, 1), r"^within: got shape \(2,\), needs a lowest and a highest .*\(1, 2\)"),
        ([(1, 1)], r"^within\[0\] = \(1.0, 1.0\): needs the lower value first"),
        ([(0, np.inf)], r"^within\[0, 1\] = inf"),
        ("all", r"^within = 'all'"),
    ],
)
def test_a_range_that_is_none_is_named(within, says):
    with pytest.raises(ValueError, match=says):
        equilibria(Pendulum(m=1.0, lc=0.5, I=0.3), within)


def along_a_slide(P):
    x, xd = sp.symbols("x xd", real=True)
    return numpy_model(from_energies(xd**2, P(x), [x], [xd]), {})


@pytest.mark.parametrize("rest", [-5000.0, -40.0, 3.0, 95.0, 300.0, 1000.0, 5000.0])
def test_a_spring_far_away_is_found(rest):
    (found,) = equilibria(along_a_slide(lambda x: 5 * (x - rest) ** 2))
    assert found.q == pytest.approx([rest], rel=1e-9)
    assert found.kind == "minimum"


@pytest.mark.parametrize("at", [0.0, 2.0, -30.0])
def test_a_flat_bottom_is_one_equilibrium(at):
    (found,) = equilibria(along_a_slide(lambda x: (x - at) ** 4))
    assert found.q == pytest.approx([at], abs=1e-4)


@pytest.mark.parametrize(
    ("P", "many"),
    [(lambda x: sp.exp(-x), 0), (lambda x: -sp.exp(-(x**2)), 1), (lambda x: 1 / (1 + x**2), 1)],
)
def test_where_a_force_only_fades_away_there_is_none(P, many):
    assert len(equilibria(along_a_slide(P))) == many
