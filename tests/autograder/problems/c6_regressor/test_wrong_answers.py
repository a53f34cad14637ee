"""Wrong answers about the regressor that are no known mistake, and mistakes that look alike."""

import numpy as np
import pytest

from autograder.judging.check import VISIBLE_CASES
from autograder.judging.criterion import TOLERANCE
from autograder.judging.diagnosis import Known, mistakes_shown
from autograder.judging.verdict import State
from autograder.problems import CHECKS
from autograder.protocol import Reply, real
from tests.autograder.problems.c6_regressor.table import (
    ALL_V,
    LIST,
    TABLE,
    WEIGHTS,
    Y,
    but,
    count,
    fit,
)
from tests.autograder.verdicts import assert_told_apart, judged, sentences


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (
            ("mc2[1] = l1 * c2 * a1", "mc2[1] = 1.2 * l1 * c2 * a1"),
            "In your column of m2 ℓc2, joint 2, its acceleration part comes out 20 % too large.",
        ),
        (
            ("mc1[0] = g * c1", "mc1[0] = 0.7 * g * c1", "l1 * mc1[0]", "l1 * g * c1"),
            "In your column of m1 ℓc1, every value is 30 % too small. Which factor belongs to all "
            "terms?",
        ),
        (
            (ALL_V, f"- 2.5{ALL_V[1:].replace('l1', '* l1', 1)}"),
            "In your column of m2 ℓc2, joint 1, its velocity part is 2.5 times as large as it "
            "should be.",
        ),
    ],
)
def test_an_unknown_error_is_traced_to_its_term(changes, said):
    assert judged("c6-regressor", Y(*changes)).diagnosis == (said,)


@pytest.mark.parametrize(
    ("check_id", "body"),
    [
        ("c6-regressor", Y("return Y", "return Y + np.cos(np.arange(12)).reshape(2, 6)")),
        ("c6-identify", fit("return b", "return b + 0.1")),
        ("c6-rank_of_excitation", "1.5 * len(q)"),
    ],
)
def test_an_error_of_no_known_kind_is_not_explained(check_id, body):
    verdict = judged(check_id, body)
    known = {mistake.sentence for mistake in CHECKS[check_id].mistakes}
    assert verdict.state is State.INCORRECT
    assert not known & set(verdict.diagnosis)
    assert verdict.witness is not None


def test_singular_values_of_rounding_are_called_so():
    for seed in range(5):
        body = count("np.linalg.matrix_rank(W)", "np.sum(np.linalg.svd(W)[1] > 0)")
        said = judged("c6-rank_of_excitation", body, seed, VISIBLE_CASES).diagnosis
        (counts,) = sentences("c6-rank_of_excitation", "tolerance zero")
        assert counts in said or any("singular values" in sentence for sentence in said)


def test_a_weighted_fit_is_told_what_least_squares_means():
    verdict = judged(
        "c6-identify", fit("lstsq(W, t)", "lstsq(W * w[:, None], w * t)", "b =", WEIGHTS)
    )
    assert verdict.credit == pytest.approx(0.6)
    assert verdict.diagnosis == (
        "With noise, your estimate is not the one of least squares: you can still make the sum of the "
        "squares of all 2K residuals smaller.",
    )


def test_a_mistake_is_named_only_where_it_matches_to_rounding():
    for check_id, name, result in (
        ("c6-regressor", "sine for cosine / in g_vec", "return Y"),
        ("c6-identify", "joint 2 only", "return b"),
    ):
        (sentence,) = sentences(check_id, name)
        body = next(body for names, body, _ in TABLE[check_id] if names == name)
        close = but(body, result, f"{result} * {1 + 20 * TOLERANCE}")
        single = but(body, result, f"return np.float32({result.removeprefix('return ')})")
        assert judged(check_id, single).diagnosis == (sentence,)
        assert sentence not in judged(check_id, close).diagnosis


def test_a_doubled_error_is_not_two_mistakes():
    """Two orders of the columns leave a column empty; taken twice, that would make it −1 times it."""
    right = [np.array([2.0]), np.array([3.0])]
    empty = [np.zeros(1), np.zeros(1)]
    known = [Known(mistake, empty) for mistake in CHECKS["c6-regressor"].mistakes[:2]]
    assert mistakes_shown(right, [-value for value in right], known) == ()


@pytest.mark.parametrize(
    ("check_id", "body", "said"),
    [
        (
            "c6-regressor",
            Y(LIST, "[m1, mc1, J1, m2, mc2, J2])"),
            "shape (6, 2); it must return one row for each joint, (2, 6).",
        ),
        (
            "c6-regressor",
            Y(LIST, "[mc1, J1, mc2, J2]).T"),
            "shape (2, 4); it must return one row for each joint and one column for each of the six ",
        ),
        (
            "c6-identify",
            fit("[1, 2, 4, 5]", "[0, 1, 2, 3, 4, 5]", "(-1, 4)", "(-1, 6)"),
            "6 numbers; it must return the four base parameters, since no motion shows all six of π.",
        ),
        ("c6-identify", "return arm.m1, 0, 0, 0", "has no attribute 'm1'"),
        (
            "c6-rank_of_excitation",
            count("matrix_rank(W)", "svd(W)[1]"),
            "it must return one number.",
        ),
    ],
)
def test_what_is_no_answer_is_an_error(check_id, body, said):
    verdict = judged(check_id, body)
    assert verdict.state is State.ERROR
    assert said in verdict.problem


@pytest.mark.parametrize("check_id", TABLE)
def test_no_wrong_model_looks_like_another(check_id):
    for seed in range(2):
        assert_told_apart(CHECKS[check_id], seed)


@pytest.mark.parametrize(
    ("spoilt", "said"),
    [
        (lambda Y: np.multiply(Y, [1, 1, 1, 1, -1, 1]), "Every entry"),
        (lambda Y: np.where(np.arange(6) == 4, Y[0], Y), "swapped the rows"),
        (lambda Y: Y * [[1, 0, 1, 1, 1, 1], [1] * 6], "the column of m1,"),
    ],
)
def test_what_is_said_of_all_of_Y_is_true_of_all_of_it(spoilt, said):
    check = CHECKS["c6-regressor"]

    def ask(calls):
        right = [np.array(check.reference(*map(real, call.args)), float) for call in calls]
        return [Reply(value=spoilt(Y)) for Y in right]

    verdict = check.run(ask, np.random.default_rng(5))
    assert verdict.state is State.PARTLY_CORRECT
    assert said not in " ".join(verdict.diagnosis)
