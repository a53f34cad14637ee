"""Equilibria: all of them, in rest, and of the kind that a push shows."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from armdyn import Manipulator, Pendulum, Planar2R, PlanarChain
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


def test_a_count_that_never_agrees_is_an_error():
    class Slide(Manipulator):
        """On a spring, not on a circle: one equilibrium, which the theorem does not allow there."""

        n = 1
        M = C = potential_energy = None

        def g_vec(self, q):
            return np.asarray(q, float)

    with pytest.raises(RuntimeError, match="are its joints revolute"):
        equilibria(Slide())
