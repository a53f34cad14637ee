"""Mistakes as people make them, in a mechanism's numbers: each is named by its own sentence."""

from types import SimpleNamespace

import numpy as np
import pytest

from autograder.mechanisms import MECHANISMS
from autograder.mutation.checks import check_of
from autograder.mutation.composed import catalogue_of
from autograder.mutation.references import reference
from autograder.mutation.whole import whole
from tests.autograder.mutation.test_mistakes import judged

PLANAR, ABSOLUTE = MECHANISMS["planar-2r"], MECHANISMS["planar-2r-absolute"]


def said(mechanism, answer, wrong) -> tuple[str, ...]:
    return judged(check_of(MECHANISMS[mechanism], answer), wrong).diagnosis


def christoffel(name, q, qd, arm):
    return whole(MECHANISMS[name])(q[None], qd[None], [arm]).christoffel()[0]


@pytest.mark.parametrize("name", ["planar-2r", "furuta"])
@pytest.mark.parametrize(
    ("sum_over_k", "words"),
    [
        ("ijk,k,k->ij", "Your C has each velocity squared."),
        ("ijk,k,j->ij", "The entries of your C hold products of two velocities, as C q̇ does."),
        ("ijk,k,i->ij", "The entries of your C hold products of two velocities. C multiplies"),
    ],
)
def test_a_velocity_too_many_in_all_of_C(name, sum_over_k, words):
    (one,) = said(
        name, "C", lambda q, qd, arm: np.einsum(sum_over_k, christoffel(name, q, qd, arm), qd, qd)
    )
    assert one.startswith(words)


@pytest.mark.parametrize(
    ("entries", "words"),
    [
        (lambda h, a, b: [[h * b**2, h * (a + b)], [-h * a, 0]], "In your C11, the velocity q̇2"),
        (lambda h, a, b: [[h * b, h * (a + b)], [-h * a**2, 0]], "In your C21, the velocity q̇1"),
        (lambda h, a, b: [[h * b, h * (a + b) ** 2], [-h * a, 0]], "Your C12 has one velocity"),
        (lambda h, a, b: [[h * b, h * (a**2 + b)], [-h * a, 0]], "In your C12, the velocity q̇1"),
        (lambda h, a, b: [[h * a * b, h * (a + b)], [-h * a, 0]], "Your C11 has one velocity"),
    ],
)
def test_a_velocity_too_many_in_one_entry(entries, words):
    def wrong(q, qd, arm):
        return entries(-arm.m2 * arm.l1 * arm.lc2 * np.sin(q[1]), *qd)

    (one,) = said("planar-2r", "C", wrong)
    assert one.startswith(words)


@pytest.mark.parametrize(
    ("of_q", "words"),
    [
        (lambda q, lc: lc**2 * np.sin(q), "the weight of the body do not come out as N·m. Look"),
        (lambda q, lc: lc * abs(np.sin(q)), "has the size of a sine or cosine, without its sign"),
        (lambda q, lc: lc * np.sin(2 * q), "takes twice q for its angle"),
        (lambda q, lc: lc * np.sin(q) ** 2, "has a sine or cosine to the wrong power"),
    ],
)
def test_a_weight_of_the_wrong_shape(of_q, words):
    (one,) = said("pendulum", "g_vec", lambda q, arm: [arm.m * arm.g * of_q(q[0], arm.lc)])
    assert words in one


def gravity(q, arm, wave):
    beyond = arm.m2 * arm.g * arm.lc2 * wave(q[0] + q[1])
    return [(arm.m1 * arm.lc1 + arm.m2 * arm.l1) * arm.g * wave(q[0]) + beyond, beyond]


def test_a_wrong_shape_in_all_terms_alike():
    (one,) = said("planar-2r", "g_vec", lambda q, arm: gravity(q, arm, lambda a: abs(np.cos(a))))
    assert one.startswith("Your g has the sizes of sines and cosines, without their signs.")
    twice = said("planar-2r", "g_vec", lambda q, arm: gravity(q, arm, lambda a: np.cos(2 * a)))
    assert all("takes twice q" in one for one in twice)
    assert len(twice) == 2

    def squared(q, arm):
        return gravity(q, SimpleNamespace(**vars(arm) | {"m2": arm.m2**2}), np.cos)

    assert said("planar-2r", "g_vec", squared) == (
        "The units of your g do not come out as N·m. Look at the power of m2.",
    )


def test_the_slope_of_a_size_is_that_of_what_is_within():
    """|cos q2| in M: the C that follows from it turns with the sign of the cosine, as M does."""
    known = [
        k
        for k, mutant in enumerate(catalogue_of(PLANAR, "C").mutants)
        if mutant.operator == "wave without its sign" and mutant.source == "M" and not mutant.entry
    ]
    q, qd = np.array([0.3, 2.0]), np.array([1.0, -0.7])  # where the cosine is negative
    arm = PLANAR.drawn(np.random.default_rng(0))
    right = reference(PLANAR, "C")(q, qd, arm)
    wrong = catalogue_of(PLANAR, "C").numbers(q[None], qd[None], [arm])[known, 0]
    assert any(np.allclose(one, -right) for one in wrong)


@pytest.mark.parametrize(
    ("energy", "words"),
    [
        (
            lambda M, arm, q, a, b: M[0, 0] * a / 2 + M[0, 1] * a * b + M[1, 1] * b / 2,
            "Your kinetic energy has velocities alone",
        ),
        (
            lambda M, arm, q, a, b: _energy(M, a, b) - arm.I2 * ((a + b) ** 2 - (a + b)) / 2,
            "In your L, the rotation of link 2 grows with the speed itself.",
        ),
        (
            lambda M, arm, q, a, b: (
                _energy(M, a, b) - arm.m2 * arm.l1 * arm.lc2 * np.cos(q[1]) * (a + b) * (a - 1)
            ),
            "the coupling of the two links has one velocity, without q̇1 beside it.",
        ),
    ],
)
def test_a_velocity_that_is_not_squared_in_K(energy, words):
    def wrong(q, qd, arm):
        L = reference(PLANAR, "lagrangian")(q, 0 * qd, arm)
        return L + energy(reference(PLANAR, "M")(q, arm), arm, q, *qd)

    (one,) = said("planar-2r", "lagrangian", wrong)
    assert words in one


def _energy(M, a, b):
    return M[0, 0] * a**2 / 2 + M[0, 1] * a * b + M[1, 1] * b**2 / 2


@pytest.mark.parametrize("name", ["planar-2r", "cart-pole"])
def test_a_rate_that_is_written_joint_by_joint(name):
    right = reference(MECHANISMS[name], "f")
    (one,) = said(name, "f", lambda x, u, arm: right(x, u, arm).reshape(2, -1).T.ravel())
    assert one.startswith("You write ẋ as if each acceleration stood beside its velocity.")


@pytest.mark.parametrize(
    ("rate", "words"),
    [
        (lambda a, b: a + b, "In your Ṁ, the part with the velocity q̇1 has the wrong sign."),
        (lambda a, b: b, "In your Ṁ, the part with the velocity q̇1 is missing."),
        (lambda a, b: b - a**2, "In your Ṁ, the velocity q̇1 is squared."),
    ],
)
def test_the_rate_of_a_difference_of_angles(rate, words):
    right = reference(ABSOLUTE, "M_dot")
    (one,) = said(
        "planar-2r-absolute",
        "M_dot",
        lambda q, qd, arm: right(q, qd, arm) * rate(*qd) / (qd[1] - qd[0]),
    )
    assert one.startswith(words)


def test_a_column_that_holds_what_belongs_in_another():
    right = reference(PLANAR, "regressor")

    def wrong(*given):
        Y = right(*given)
        Y[:, 2] = Y[:, 4]
        return Y

    assert said("planar-2r", "regressor", wrong) == (
        "In your Y, the column of m2 holds what belongs in that of I2 + m2·ℓc2². Which entry of π "
        "multiplies it?",
    )


def test_an_order_is_named_only_where_it_explains_the_whole():
    """One column that holds another's is no order, though in some columns it looks like one."""
    right = reference(PLANAR, "regressor")

    def swapped(*given):
        return right(*given)[:, [1, 0, 2, 3, 4]]

    def doubled(*given):
        return swapped(*given) * [1, 1, 1, 1, 2]

    (one,) = said("planar-2r", "regressor", swapped)
    assert one.startswith("Your columns are right, but they stand in another order")
    assert not any("in another order" in one for one in said("planar-2r", "regressor", doubled))
