from functools import cache, partial, partialmethod
from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from armdyn import Manipulator, Pendulum, Planar2R
from armdyn.linearisation import linearise
from armdyn.properties import positive_definiteness
from tests.armdyn.arms import (
    a_few,
    arms_and_states,
    assert_close,
    between,
    lengths,
    masses,
    planar_arms,
    vectors,
)

NAMES = "l1 l2 lc1 lc2 m1 m2 I1 I2 g"


@cache
def from_the_lagrangian():
    """M, C, g, P and u of the 2R, from where its links are: nothing of the closed form enters."""
    t = sp.Symbol("t")
    p = sp.symbols(NAMES, real=True)
    l1, _, lc1, lc2, m1, m2, I1, I2, g = p
    q1, q2 = sp.Function("q1")(t), sp.Function("q2")(t)
    along1 = sp.Matrix([sp.cos(q1), sp.sin(q1)])
    along2 = sp.Matrix([sp.cos(q1 + q2), sp.sin(q1 + q2)])
    com1, com2 = lc1 * along1, l1 * along1 + lc2 * along2
    v1, v2 = com1.diff(t), com2.diff(t)
    K = (m1 * v1.dot(v1) + m2 * v2.dot(v2)) / 2
    K += (I1 * q1.diff(t) ** 2 + I2 * (q1 + q2).diff(t) ** 2) / 2
    P = g * (m1 * com1[1] + m2 * com2[1])
    q = sp.Matrix([q1, q2])
    qd, qdd = q.diff(t), q.diff(t, 2)
    L = K - P
    u = sp.Matrix([L.diff(v).diff(t) - L.diff(x) for x, v in zip(q, qd, strict=True)])
    M = sp.hessian(K, list(qd))
    C = sp.Matrix(
        2,
        2,
        lambda i, j: sum(
            (M[i, j].diff(q[k]) + M[i, k].diff(q[j]) - M[j, k].diff(q[i])) * qd[k] / 2
            for k in range(2)
        ),
    )
    numbers = sp.symbols("a1 a2 v1 v2 x1 x2")
    to_numbers = dict(zip([*qdd, *qd, *q], numbers, strict=True))
    terms = {"M": M, "C": C, "g": sp.Matrix([P.diff(x) for x in q]), "P": P, "u": u}
    return {
        name: sp.lambdify((*p, *numbers), term.subs(to_numbers), "numpy")
        for name, term in terms.items()
    }


@a_few
@given(planar_arms(viscous=st.just(0.0), coulomb=st.just(0.0)), st.data())
def test_closed_form_is_what_the_lagrangian_gives(arm, data):
    q, qd, qdd = (data.draw(st.tuples(between(-6, 6), between(-6, 6))) for _ in range(3))
    derived = from_the_lagrangian()
    arguments = (*(getattr(arm, name) for name in NAMES.split()), *qdd, *qd, *q)
    M, C = arm.M(q), arm.C(q, qd)
    size = np.max(np.abs(derived["M"](*arguments))) * 36 + arm.g * (arm.m1 + arm.m2) * 6
    assert_close(M, derived["M"](*arguments), size / 36)
    assert_close(C, derived["C"](*arguments), size)
    assert_close(arm.g_vec(q), derived["g"](*arguments)[:, 0], size)
    assert_close(arm.potential_energy(q), derived["P"](*arguments), size)
    assert_close(arm.inverse_dynamics(q, qd, qdd), derived["u"](*arguments)[:, 0], size)


@a_few
@given(arms_and_states(planar_arms(), parts=1))
def test_determinant(case):
    arm, q = case
    coupling = arm.m2 * arm.l1 * arm.lc2
    first = arm.I1 + arm.m1 * arm.lc1**2 + arm.m2 * arm.l1**2
    second = arm.I2 + arm.m2 * arm.lc2**2
    expected = first * second - (coupling * np.cos(q[..., 1])) ** 2
    M = arm.M(q)
    assert_close(np.linalg.det(M), expected, np.max(np.abs(M)) ** 2)


@a_few
@given(arms_and_states(planar_arms(), parts=2))
def test_only_the_elbow_angle_enters_m_and_c(case):
    arm, q, qd = case
    turned = q + np.array([1.7, 0.0])
    np.testing.assert_array_equal(arm.M(turned), arm.M(q))
    np.testing.assert_array_equal(arm.C(turned, qd), arm.C(q, qd))


@a_few
@given(l1=lengths, lc1=lengths, lc2=lengths, m1=masses, m2=masses, q2=between(-7, 7))
def test_point_masses_with_both_offsets_stay_definite(l1, lc1, lc2, m1, m2, q2):
    arm = Planar2R(l1, 1.0, lc1, lc2, m1, m2, I1=0, I2=0)
    # det M = m1 m2 lc1² lc2² + (m2 l1 lc2 sin q2)² > 0
    expected = m1 * m2 * (lc1 * lc2) ** 2 + (m2 * l1 * lc2 * np.sin(q2)) ** 2
    M = arm.M([0.3, q2])
    assert_close(np.linalg.det(M), expected, np.max(np.abs(M)) ** 2)
    assert expected > 0


@a_few
@given(l1=lengths, lc1=lengths, m1=masses, m2=masses, q=st.tuples(between(-7, 7), between(-7, 7)))
def test_a_point_mass_on_joint_two_is_singular_everywhere(l1, lc1, m1, m2, q):
    arm = Planar2R(l1, 1.0, lc1, lc2=0, m1=m1, m2=m2, I1=0, I2=0)
    assert_singular(arm, q)


@a_few
@given(l1=lengths, lc2=lengths, m1=masses, m2=masses, q1=between(-7, 7), turns=st.integers(-3, 3))
def test_a_point_mass_on_joint_one_is_singular_when_straight(l1, lc2, m1, m2, q1, turns):
    arm = Planar2R(l1, 1.0, lc1=0, lc2=lc2, m1=m1, m2=m2, I1=0, I2=0)
    assert_singular(arm, (q1, turns * np.pi))
    assert positive_definiteness(arm, (q1, turns * np.pi + 0.1)).holds
    assert np.isfinite(arm.dynamics((q1, turns * np.pi + 0.1), [0, 0], [1, 1])).all()


def test_no_mass_and_no_inertia_is_singular():
    arm = Planar2R(1, 1, 0.5, 0.5, m1=0, m2=0, I1=0, I2=0)
    np.testing.assert_array_equal(arm.M([0.1, 0.2]), np.zeros((2, 2)))
    assert_singular(arm, (0.1, 0.2))


def assert_singular(arm, q):
    assert not positive_definiteness(arm, q).holds
    with pytest.raises(np.linalg.LinAlgError, match=r"M\(q\) is singular at q = \["):
        arm.dynamics(q, [0.1, -0.2], [1.0, 2.0])
    with pytest.raises(np.linalg.LinAlgError, match="not determined"):
        arm.state_derivative([*q, 0.1, -0.2], [1.0, 2.0])


def test_a_singular_state_is_found_in_its_batch():
    arm = Planar2R(1, 1, lc1=0, lc2=0.5, m1=1, m2=1, I1=0, I2=0)
    q = np.full((2, 3, 2), 0.5)
    q[1, 2] = [0.3, np.pi]
    # There the velocity with l1 q̇1 + lc2 (−1)(q̇1 + q̇2) = 0 leaves the point mass where it is.
    with pytest.raises(np.linalg.LinAlgError, match=r"q = \[0\.3 .*\(state 1, 2 of the batch\)"):
        arm.dynamics(q, [0, 0], [0, 0])
    witness = positive_definiteness(arm, q).witness
    np.testing.assert_array_equal(witness["q"], q[1, 2])
    idle = witness["eigenvector"]
    assert abs(arm.l1 * idle[0] - arm.lc2 * idle.sum()) < 1e-12


def test_a_very_light_second_link_is_not_singular():
    arm = Planar2R(1, 1, 0.5, 0.5, m1=1, m2=1e-9, I1=0.1, I2=1e-10)
    assert np.isfinite(arm.dynamics([0.1, 0.2], [0, 0], [0, 0])).all()


@a_few
@given(planar_arms(), between(-6, 6), between(-6, 6), between(-6, 6), between(-6, 6))
def test_with_the_elbow_locked_it_is_a_pendulum(arm, q1, q2, qd1, qdd1):
    both = arm.m1 * arm.lc1 + arm.m2 * (arm.l1 + arm.lc2 * np.exp(1j * q2))
    com = both / (arm.m1 + arm.m2)
    link2 = abs(arm.l1 + arm.lc2 * np.exp(1j * q2))
    pivot = arm.I1 + arm.m1 * arm.lc1**2 + arm.I2 + arm.m2 * link2**2
    pendulum = Pendulum(arm.m1 + arm.m2, abs(com), pivot, arm.g)
    q, qd, qdd = [q1, q2], [qd1, 0.0], [qdd1, 0.0]
    # The pendulum's angle is from hanging down, the arm's from the x axis.
    hanging = [q1 + np.angle(com) + np.pi / 2]
    size = pivot * 36 + pendulum.m * abs(com) * arm.g
    dry = arm.f_vec(qd)[0]
    u1 = arm.inverse_dynamics(q, qd, qdd)[0]
    assert_close(u1 - dry, pendulum.inverse_dynamics(hanging, [qd1], [qdd1])[0], size + dry)
    assert_close(arm.kinetic_energy(q, qd), pendulum.kinetic_energy(hanging, [qd1]), size)
    offset = pendulum.m * arm.g * abs(com)
    P = pendulum.potential_energy(hanging) - offset
    assert_close(arm.potential_energy(q), P, size)


def test_gravity_pulls_down_where_the_conventions_say():
    arm = Planar2R(1, 1, 0.5, 0.5, 1, 1, 0.1, 0.1)
    # Held out along +x, both joints must push counter-clockwise; hanging, nothing.
    np.testing.assert_allclose(arm.g_vec([0, 0]), [9.81 * (0.5 + 1.5), 9.81 * 0.5])
    np.testing.assert_allclose(arm.g_vec([-np.pi / 2, 0]), [0, 0], atol=1e-12)
    assert arm.dynamics([0, 0], [0, 0], [0, 0])[0] < 0
    assert arm.potential_energy([np.pi / 2, 0]) > arm.potential_energy([-np.pi / 2, 0])


class Weightless(Planar2R):
    def g_vec(self, q):
        return 0 * super().g_vec(q)


def test_subclass_with_another_term_moves_by_it():
    arm = Weightless(1.0, 0.8, 0.5, 0.4, 3.0, 2.0, 0.25, 0.11)
    floating = Planar2R(1.0, 0.8, 0.5, 0.4, 3.0, 2.0, 0.25, 0.11, g=0.0)
    state = np.array([0.3, 0.4]), np.array([1.0, 2.0]), np.array([0.1, 0.2])
    np.testing.assert_allclose(arm.dynamics(*state), floating.dynamics(*state), rtol=1e-13)


@given(planar_arms(st.just(0.0), st.just(0.0)), vectors(2), vectors(2), vectors(2))
def test_one_state_in_floats_and_the_general_way_agree(arm, q, qd, u):
    """The closed form in floats against the general way."""
    one = arm.dynamics(q, qd, u)
    general = Manipulator.dynamics(arm, q, qd, u)
    assert_close(one, general, np.max(np.abs(general)), tolerance=1e-9)


class NoGravity:
    """A mixin: it knows nothing of the arm it stands before."""

    def g_vec(self, q):
        return np.zeros_like(np.asarray(q, dtype=float))


class Rubbing:
    def f_vec(self, qd):
        return 3.0 * np.asarray(qd)


class Blown:
    """Wind on top of what the arm says; `inverse_dynamics` asks for it, too."""

    def bias(self, q, qd):
        return super().bias(q, qd) + 5.0


class Windy(Blown, Planar2R):
    pass


class Before(NoGravity, Planar2R):
    pass


class Behind(Planar2R, NoGravity):
    """Planar2R's own gravity comes first here."""


class Grandchild(Before):
    pass


class Late(Planar2R):
    pass


Late.M = lambda self, q: 2 * Planar2R.M(self, q)


class Partial(Planar2R):
    C = partialmethod(lambda self, half, q, qd: half * Planar2R.C(self, q, qd), 0.5)


class Pushed(Rubbing, Planar2R):
    """Its own `dynamics` hands on to the closed form's, which is not the way here."""

    def dynamics(self, q, qd, u):
        return super().dynamics(q, qd, u)


class Changeable(Planar2R):
    def __init__(self, *arguments, **keywords):
        super().__init__(*arguments, **keywords)
        self.g_vec = lambda q: np.array([1.0, -2.0])


class Tipper(Planar2R):
    """A load that is computed anew each time."""

    load = 0.0

    @property
    def m2(self):
        return self.__dict__["m2"] + self.load

    @m2.setter
    def m2(self, value):
        self.__dict__["m2"] = value


def general(arm, q, qd, u):
    """q̈ from what the model says of its motion, and nothing else."""
    return np.linalg.solve(arm.M(q), u - arm.C(q, qd) @ qd - arm.g_vec(q) - arm.f_vec(qd))


def test_another_bias_counts_both_ways():
    arm = Windy(*PARAMETERS)
    q, qd, u = STATE
    found = arm.dynamics(q, qd, u)
    np.testing.assert_allclose(arm.inverse_dynamics(q, qd, found), u, atol=1e-12)
    plain = Planar2R(*PARAMETERS)
    np.testing.assert_allclose(found, plain.dynamics(q, qd, u - 5.0), rtol=1e-12)
    with pytest.raises(ValueError, match=r"^model: this Windy has its own bias"):
        linearise(arm, np.concatenate([q, qd]), u)


PARAMETERS = (1.0, 0.8, 0.5, 0.4, 3.0, 2.0, 0.25, 0.11)
STATE = np.array([0.3, 0.4]), np.array([1.0, 2.0]), np.array([0.1, 0.2])


@pytest.mark.parametrize(
    "kind", [Before, Behind, Grandchild, Late, Partial, Pushed, Changeable, Weightless]
)
def test_the_arm_moves_as_its_terms_say_wherever_they_come_from(kind):
    arm = kind(*PARAMETERS)
    q, qd, u = STATE
    np.testing.assert_allclose(arm.dynamics(q, qd, u), general(arm, q, qd, u), rtol=1e-12)
    slope = arm.state_derivative(np.concatenate([q, qd]), u)
    np.testing.assert_allclose(slope[2:], general(arm, q, qd, u), rtol=1e-12)
    same = np.allclose(arm.dynamics(q, qd, u), Planar2R(*PARAMETERS).dynamics(q, qd, u))
    assert same == (kind is Behind)


@pytest.mark.parametrize("term", ["M", "C", "g_vec", "f_vec"])
def test_a_term_replaced_after_the_arm_has_moved_counts_too(term, monkeypatch):
    def other(*arguments):
        return 2 * getattr(base, term)(*arguments[-(1 if term != "C" else 2) :]) + 0.1

    q, qd, u = STATE
    base, arm, single = (Planar2R(*PARAMETERS) for _ in range(3))
    before = arm.dynamics(q, qd, u)
    single.dynamics(q, qd, u)
    object.__setattr__(single, term, other)
    np.testing.assert_allclose(single.dynamics(q, qd, u), general(single, q, qd, u), rtol=1e-12)
    original = getattr(Planar2R, term)
    base = SimpleNamespace(**{term: partial(original, base)})
    monkeypatch.setattr(Planar2R, term, lambda self, *arguments: other(*arguments))
    np.testing.assert_allclose(arm.dynamics(q, qd, u), general(arm, q, qd, u), rtol=1e-12)
    assert not np.allclose(arm.dynamics(q, qd, u), before)


def test_a_parameter_that_is_computed_anew_is_not_remembered():
    arm = Tipper(*PARAMETERS)
    arm.dynamics(*STATE)
    type(arm).load = 1.5
    try:
        np.testing.assert_allclose(arm.dynamics(*STATE), general(arm, *STATE), rtol=1e-12)
    finally:
        type(arm).load = 0.0


def test_the_plain_arm_takes_the_quick_way(monkeypatch):
    """Else the tests above would compare the general way with itself."""
    monkeypatch.setattr(Manipulator, "dynamics", None)
    Planar2R(*PARAMETERS).dynamics(*STATE)
    Behind(*PARAMETERS).dynamics(*STATE)
