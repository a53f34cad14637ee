"""The answers of each mechanism agree with each other, and with the library's arm."""

from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sp

from armdyn import Planar2R
from autograder.judging.verdict import State
from autograder.mechanisms import MECHANISMS
from autograder.mutation.answers import ANSWERS
from autograder.mutation.checks import check_of
from autograder.mutation.composed import catalogue_of
from autograder.mutation.inertial_parameters import inertial_parameters
from autograder.mutation.mistakes import numbers_of
from autograder.mutation.references import reference
from autograder.mutation.sentences import sentence
from autograder.problems import CHECKS, check_for
from tests.autograder.mutation.test_mistakes import judged

EVERY = pytest.mark.parametrize("mechanism", MECHANISMS.values(), ids=list(MECHANISMS))
PLANAR = MECHANISMS["planar-2r"]


def drawn(mechanism, seed=0, friction=False):
    rng = np.random.default_rng(seed)
    arm = mechanism.drawn(rng, friction)
    return mechanism.placed(rng), mechanism.moving(rng), mechanism.moving(rng), arm


@EVERY
def test_the_rate_of_M_is_its_derivative_along_the_motion(mechanism):
    q, qd, _, arm = drawn(mechanism)
    M = reference(mechanism, "M")
    step = 1e-6
    slope = (M(q + step * qd, arm) - M(q - step * qd, arm)) / (2 * step)
    rate = reference(mechanism, "M_dot")(q, qd, arm)
    np.testing.assert_allclose(rate, slope, rtol=1e-7, atol=1e-7)
    C = reference(mechanism, "C")(q, qd, arm)
    np.testing.assert_allclose(rate, C + C.T, rtol=1e-10, atol=1e-10)


@EVERY
def test_f_solves_the_equation_of_motion(mechanism):
    q, qd, u, arm = drawn(mechanism, 1, friction=True)
    n = mechanism.n
    x_dot = reference(mechanism, "f")(np.concatenate([q, qd]), u, arm)
    np.testing.assert_array_equal(x_dot[:n], qd)
    resisted = np.zeros(n)
    if mechanism.friction:
        resisted = arm.viscous * qd + arm.coulomb * np.sign(qd)
    left = reference(mechanism, "M")(q, arm) @ x_dot[n:]
    left += reference(mechanism, "C")(q, qd, arm) @ qd + reference(mechanism, "g_vec")(q, arm)
    np.testing.assert_allclose(left + resisted, u, rtol=1e-9, atol=1e-9)


@EVERY
def test_the_drift_is_the_energy_that_was_gained(mechanism):
    """Of two states the second has gained what K and P say of it; L and E differ by twice P."""
    q, qd, u, arm = drawn(mechanism, 2)
    rows = np.array([np.concatenate([q, qd]), np.concatenate([qd, u])])
    K = [x[mechanism.n :] @ reference(mechanism, "M")(x[: mechanism.n], arm) @ x[mechanism.n :] / 2
         for x in rows]  # fmt: skip
    P = [reference(mechanism, "potential_energy")(x[: mechanism.n], arm) for x in rows]
    L = [reference(mechanism, "lagrangian")(*np.split(x, 2), arm) for x in rows]
    drift = reference(mechanism, "energy_drift")(rows, arm)
    assert drift[0] == 0
    assert drift[1] == pytest.approx(K[1] + P[1] - K[0] - P[0])
    np.testing.assert_allclose(L, np.subtract(K, P), rtol=1e-10, atol=1e-10)


@EVERY
def test_the_regressor_times_its_parameters_is_the_torque(mechanism):
    q, qd, qdd, arm = drawn(mechanism, 3)
    numbers = {p.symbol: getattr(arm, p.name) for p in mechanism.parameters}
    pi = [float(sp.sympify(p.value).subs(numbers)) for p in inertial_parameters(mechanism)]
    torque = reference(mechanism, "M")(q, arm) @ qdd + reference(mechanism, "g_vec")(q, arm)
    torque += reference(mechanism, "C")(q, qd, arm) @ qd
    Y = reference(mechanism, "regressor")(q, qd, qdd, arm)
    np.testing.assert_allclose(Y @ pi, torque, rtol=1e-10, atol=1e-10)
    # It is made of what is known.
    other = SimpleNamespace(
        **{p.name: getattr(arm, p.name) * (1 if p.known else 2) for p in mechanism.parameters}
    )
    np.testing.assert_array_equal(Y, reference(mechanism, "regressor")(q, qd, qdd, other))


def test_the_planar_arm_is_the_librarys_with_friction():
    q, qd, u, arm = drawn(PLANAR, 4, friction=True)
    model = Planar2R(**vars(arm))
    x = np.concatenate([q, qd])
    np.testing.assert_allclose(
        reference(PLANAR, "f")(x, u, arm), model.state_derivative(x, u), rtol=1e-11
    )


def test_the_parameters_of_a_regressor_are_named():
    words = [pi.words for pi in inertial_parameters(PLANAR)]
    assert words == ["m1·lc1", "I1 + m1·lc1²", "m2", "m2·lc2", "I2 + m2·lc2²"]
    assert [pi.unit for pi in inertial_parameters(PLANAR)] == [
        "kg·m", "kg·m²", "kg", "kg·m", "kg·m²",
    ]  # fmt: skip


def test_an_answer_without_friction_draws_none():
    calls = ANSWERS["M"].calls(PLANAR, np.random.default_rng(0), 1)
    assert not hasattr(calls[0].args[1], "viscous")
    (_, _, arm) = ANSWERS["f"].calls(PLANAR, np.random.default_rng(0), 1)[0].args
    assert arm.viscous.shape == arm.coulomb.shape == (2,)


@EVERY
def test_every_answer_has_its_check_by_name(mechanism):
    for answer in ANSWERS:
        check = check_for(f"{mechanism.name}-{answer}")
        assert check is not None
        assert check.signature == ANSWERS[answer].signature
        assert len(check.hints) == 3


@pytest.mark.parametrize(
    ("of", "said"),
    [
        (lambda q, qd, u, M, c, g, f: (qd, np.linalg.solve(M, u - c - g)), "lacks the friction."),
        (lambda q, qd, u, M, c, g, f: (qd, M @ (u - c - g - f)), "You multiply by M."),
        (lambda q, qd, u, M, c, g, f: (qd, np.linalg.solve(M, u - g - f)), "lacks C q̇."),
        (
            lambda q, qd, u, M, c, g, f: (qd, np.linalg.solve(M, u - c - g) - f),
            "You do not divide the friction by M",
        ),
        (
            lambda q, qd, u, M, c, g, f: (
                qd,
                np.linalg.solve(np.diag(np.diag(M)), u - c - g - f),
            ),
            "You divide by the diagonal of M",
        ),
    ],
)
def test_what_is_said_of_a_wrong_f(of, said):
    M, C, g = (reference(PLANAR, name) for name in ("M", "C", "g_vec"))

    def wrong(x, u, arm):
        q, qd = np.split(x, 2)
        friction = arm.viscous * qd + arm.coulomb * np.sign(qd)
        return np.concatenate(of(q, qd, u, M(q, arm), C(q, qd, arm) @ qd, g(q, arm), friction))

    (first, *_) = judged(check_of(PLANAR, "f"), wrong).diagnosis
    assert said in first


def test_a_wrong_M_is_said_where_f_or_C_follows_from_it():
    """Half of the coupling in M11, as if (a + b)² had no mixed term twice."""
    M, g = reference(PLANAR, "M"), reference(PLANAR, "g_vec")

    def wrong_C(q, qd, arm):
        h = -arm.m2 * arm.l1 * arm.lc2 * np.sin(q[1])
        D = np.zeros((2, 2, 2))
        D[:, :, 1] = h * np.array([[1.0, 1.0], [1.0, 0.0]])
        christoffel = (D + np.swapaxes(D, 1, 2) - np.moveaxis(D, -1, 0)) / 2
        return christoffel @ qd

    def wrong_f(x, u, arm):
        q, qd = np.split(x, 2)
        inertia = M(q, arm)
        inertia[0, 0] -= arm.m2 * arm.l1 * arm.lc2 * np.cos(q[1])
        friction = arm.viscous * qd + arm.coulomb * np.sign(qd)
        rest = u - wrong_C(q, qd, arm) @ qd - g(q, arm) - friction
        return np.concatenate([qd, np.linalg.solve(inertia, rest)])

    for answer, wrong in (("C", wrong_C), ("f", wrong_f)):
        verdict = judged(check_of(PLANAR, answer), wrong)
        assert verdict.state is not State.CORRECT
        (said,) = verdict.diagnosis
        assert "In this M11, the coupling of the two links is half" in said, said


def test_an_arm_whose_second_angle_is_absolute_is_told_from_ours():
    absolute = check_of(MECHANISMS["planar-2r-absolute"], "f").reference
    (said,) = judged(
        check_of(PLANAR, "f"), lambda x, u, arm: _absolute(absolute, x, u, arm)
    ).diagnosis
    assert "measured from the same line as q1" in said


def _absolute(absolute, x, u, arm):
    """The motion of an arm whose q2 is absolute, with the friction that ours would have."""
    qd = np.split(x, 2)[1]
    friction = arm.viscous * qd + arm.coulomb * np.sign(qd)
    loose = SimpleNamespace(**vars(arm) | {"viscous": np.zeros(2), "coulomb": np.zeros(2)})
    return absolute(x, u - friction, loose)


@pytest.mark.parametrize(
    ("id", "mechanism", "answer", "operator", "times"),
    [
        ("p5-energy_drift", "planar-2r", "energy_drift", "sign of the whole", -1),  # 5 to 8 rows
        ("p5-f", "planar-2r", "f", "halves of ẋ swapped", np.eye(4)[[2, 3, 0, 1]]),
        ("p2-M_dot", "planar-2r", "M_dot", "half of the whole", 0.5),
        ("p3-lagrangian", "pendulum", "lagrangian", "twice the whole", 2),  # symbols, at points
    ],
)
def test_the_mistakes_are_tried_on_the_calls_of_problems(id, mechanism, answer, operator, times):
    check, known = CHECKS[id], catalogue_of(MECHANISMS[mechanism], answer).mutants
    calls = check.calls(np.random.default_rng(7), 6)
    (place,) = (k for k, mutant in enumerate(known) if mutant.operator == operator)
    wrong = numbers_of(MECHANISMS[mechanism], answer, calls)[place]
    assert len(wrong) == len(calls)
    for call, given in zip(calls, wrong, strict=True):
        if call.at:
            right = np.array([check.reference(*point.values()) for point in call.at])
            # A constant in P is free.
            assert np.ptp(given - times * right) < 1e-9
        else:
            right = check.reference(*call.args)
            expected = times @ right if np.ndim(times) else times * right
            np.testing.assert_allclose(given, expected, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("answer", ANSWERS)
def test_what_is_said_of_a_part_names_the_part(answer):
    """ "This M", not "Your M": the student sees the answer alone."""
    for mutant in catalogue_of(PLANAR, answer).mutants:
        said = sentence(mutant, PLANAR, ANSWERS[answer])
        if mutant.source:
            head, _, rest = said.partition(". ")
            assert head.startswith("Your ")
            assert not rest.startswith(("Your ", "In your "))
