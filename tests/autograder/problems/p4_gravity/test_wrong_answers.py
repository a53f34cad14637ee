"""Wrong answers about gravity that are no known mistake, and some of the equilibria for all."""

import itertools

import numpy as np
import pytest

from autograder.judging.criterion import TOLERANCE
from autograder.judging.verdict import State
from tests.autograder.problems.p4_gravity.table import HALF_PI, SUM, of_links, torque, with_lines
from tests.autograder.verdicts import judged, sentences


@pytest.mark.parametrize(
    ("check_id", "body", "said"),
    [
        (
            "p4-potential_energy",
            with_lines(of_links(), "lc2 = 1.1 * lc2"),
            "In your change of P as the elbow turns from 0 to q2, every value is 10 % too large. "
            "Which factor belongs to all terms?",
        ),
        (
            "p4-potential_energy",
            with_lines(of_links(), "lc1 = 0.8 * lc1"),
            "the weight of link 1 beyond the shoulder comes out 20 % too small.",
        ),
        (
            "p4-g_vec",
            with_lines(torque(), "l1 = 1.3 * l1"),
            "In your gravity torque g1 of joint 1, the weight of link 2 at the elbow comes out 30 % "
            "too large.",
        ),
        (
            "p4-gravity_from_jacobians",
            SUM.format("-m * Jv.T @ (g0 * [1, 1, 0.75])"),
            "In your gravity torque from the Jacobians, the pull along z comes out 25 % too small.",
        ),
    ],
)
def test_an_unknown_error_is_traced_to_its_term(check_id, body, said):
    (sentence,) = judged(check_id, body).diagnosis
    assert sentence.endswith(said)


@pytest.mark.parametrize(
    ("check_id", "body"),
    [
        ("p4-potential_energy", "q[0] ** 2 + q[1]"),
        ("p4-gravity_from_jacobians", "1e4 * np.ones(jacobians_v.shape[2])"),
    ],
)
def test_an_error_of_no_known_kind_is_not_explained(check_id, body):
    verdict = judged(check_id, body)
    assert verdict.state is State.INCORRECT
    assert verdict.diagnosis == ()
    assert verdict.witness is not None


def test_a_mistake_is_named_only_where_it_matches_to_rounding():
    for check_id, body in (
        ("p4-g_vec", torque("np.sin")),
        ("p4-potential_energy", of_links("np.cos")),
    ):
        named = judged(check_id, body).diagnosis
        close = with_lines(body, f"g = g * (1 + {20 * TOLERANCE})")
        assert named[0] not in judged(check_id, close).diagnosis
        single = body.replace("return ", "return np.float32(") + ")"
        assert judged(check_id, single).diagnosis == named


FOUR = [(s * np.pi / 2, e) for s in (-1, 1) for e in (0.0, np.pi)]


NAMES_OF_SUBSETS = {
    (0, 2): "stretched only",
    (0,): "stable only",
    (2,): "one value of the inverse cosine",
    (2, 3): "link 1 up only",
    (0, 1): "link 1 down only",
}


@pytest.mark.parametrize(
    "chosen", [chosen for k in (1, 2, 3) for chosen in itertools.combinations(range(4), k)]
)
def test_some_of_the_equilibria_are_half_of_the_answer(chosen):
    """Every choice of fewer than four: each is right, not all are there, and nothing false is said."""
    verdict = judged("p4-equilibria", repr([FOUR[k] for k in chosen]))
    assert verdict.credit == 0.5
    assert [row.met for row in verdict.rows] == [True, False]
    missing = (
        "At least one equilibrium is missing. Each of the two torques gives a condition: how many "
        "angles within one turn meet it?"
    )
    named = NAMES_OF_SUBSETS.get(chosen)
    assert verdict.diagnosis == (sentences("p4-equilibria", named) if named else (missing,))


def test_one_configuration_too_many_costs_the_other_half():
    verdict = judged("p4-equilibria", repr([*FOUR, (0.3, 0.0)]))
    assert [row.met for row in verdict.rows] == [False, True]
    assert verdict.diagnosis == (
        "At least one of your configurations still needs a torque against gravity. Put each of them "
        "into your g_vec.",
    )


def test_what_is_missing_is_told_apart_though_another_configuration_is_there():
    """The distances alone must not take absolute angles for angles from the vertical."""
    pairs = f"[(a, b) for a in (-{HALF_PI}, {HALF_PI}) for b in (-{HALF_PI}, {HALF_PI})]"
    said = judged("p4-equilibria", f"{pairs} + [(0, 0)]").diagnosis
    assert said[1:] == sentences("p4-equilibria", "absolute second angle")


@pytest.mark.parametrize(
    ("check_id", "body", "said"),
    [
        (
            "p4-g_vec",
            of_links(),
            "returned one number, as P is; it must return one entry for each joint.",
        ),
        ("p4-gravity_from_jacobians", SUM.format("-m * Jv @ g0"), "raised ValueError: matmul"),
        ("p4-equilibria", "[]", "it must return one row (q1, q2) for each configuration."),
        (
            "p4-equilibria",
            "np.zeros((2, 4))",
            "it must return one row (q1, q2) for each configuration.",
        ),
    ],
)
def test_numbers_of_another_shape_are_no_physics(check_id, body, said):
    verdict = judged(check_id, body)
    assert verdict.state is State.ERROR
    assert said in verdict.problem
