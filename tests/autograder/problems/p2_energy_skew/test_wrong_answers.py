"""Wrong answers about Ṁ and C that are no known mistake, and what each step of C earns."""

import pytest

from autograder.judging.criterion import TOLERANCE
from autograder.judging.verdict import State
from autograder.problems import CHECKS
from tests.autograder.problems.p2_energy_skew.table import ARM, HEADS, C
from tests.autograder.verdicts import judged, sentences


@pytest.mark.parametrize(
    ("check_id", "body", "said"),
    [
        (
            "p2-C",
            "return [[h * b, h * (a + 1.3 * b)], [-h * a, 0]]",
            "In your vector C q̇, the centrifugal term of row 1 (q̇2²) comes out 30 % too large.",
        ),
        (
            "p2-C",
            "return [[h * b, h * (a + b)], [-0.6 * h * a, 0]]",
            "In your vector C q̇, the centrifugal term of row 2 (q̇1²) comes out 40 % too small.",
        ),
        (
            "p2-M_dot",
            "return 1.1 * M_dot",
            "In your entry Ṁ11, every value is 10 % too large. Which factor belongs to all terms?",
        ),
        (
            "p2-C_other",
            "return [[0, h * (a + 1.3 * b)], [-h * a, 0]]",
            "In your vector C_other q̇, the Coriolis term of row 1 (q̇1 q̇2) is half of what it "
            "should be, and the centrifugal term of row 1 (q̇2²) comes out 30 % too large.",
        ),
        (
            "p2-christoffel",
            "return matrix(lambda i, j, k: (d(i, j, k) + d(i, k, j) - 1.4 * d(j, k, i)) / 2 * qd[k])",
            "In your vector C q̇, the part from −∂K/∂q comes out 40 % too large.",
        ),
    ],
)
def test_an_unknown_error_is_put_in_its_term(check_id, body, said):
    verdict = judged(check_id, HEADS[check_id] + body)
    assert verdict.diagnosis[0] == said


NEITHER = (
    "With your C the energy would change although nobody does work: q̇ᵀ(Ṁ − 2C)q̇ is not zero.",
    "With your C the matrix Ṁ − 2C is not skew-symmetric, as it is with the Christoffel form.",
)
ALONE = (
    f"{NEITHER[1]} A right C q̇ is not enough: how does that form share the product q̇1 q̇2 between the "
    "entries of a row?"
)


@pytest.mark.parametrize(
    ("body", "met"),
    [
        (f"return {C} + 0.3 * np.outer([1, 2], [-b, a])", (True, True, False)),
        (f"return {C} + 0.3 * np.array([[0, 1], [-1, 0]])", (False, True, True)),
        (f"return {C} + 0.3 * np.array([[b * b, 0], [0, -a * a]])", (False, True, False)),
        (f"return {C} + 0.3 * np.outer([1, 2], [b, 2 * a])", (False, False, False)),
    ],
)
def test_each_step_of_c_has_its_own_credit(body, met):
    verdict = judged("p2-C", ARM + body)
    assert tuple(row.met for row in verdict.rows) == met
    assert verdict.credit == pytest.approx(sum((0.5, 0.2, 0.3)[k] for k in range(3) if met[k]))
    said = {1: NEITHER[0], 2: ALONE if met == (True, True, False) else NEITHER[1]}
    assert set(verdict.diagnosis) == {said[k] for k in (1, 2) if not met[k]}


def test_a_mistake_explains_what_it_breaks_and_no_more():
    """The right C q̇ of a known mistake, shared out in a new way: the skew step says so by itself."""
    verdict = judged("p2-C", ARM + "return [[-h * b, h * (2 * a + b)], [-h * a, 0]]")
    assert verdict.diagnosis == (
        "In row 1 of your C q̇, the product of velocities q̇1 q̇2 is half of what it should be. In how "
        "many places of the sum over j and k does it appear?",
        NEITHER[1],
    )


def test_another_c_must_differ_clearly():
    barely = f"return {C} + 1e-4 * h * np.outer([1, 2], [-b, a])"
    verdict = judged("p2-C_other", ARM + barely)
    assert verdict.credit == 0.5
    assert verdict.diagnosis[0].startswith("Your answer counts as not skew-symmetric only where")


def test_not_skew_counts_only_with_the_right_c_qd():
    verdict = judged("p2-C_other", ARM + f"return {C} + np.array([[3.0, 1.0], [2.0, 0.5]])")
    assert [row.met for row in verdict.rows] == [False, False]


@pytest.mark.parametrize(
    ("check_id", "body"),
    [
        ("p2-M_dot", "return M_dot * 1.0001"),
        ("p2-C", f"return {C} * 1.0001"),
        ("p2-C_other", "return [[0, h * (2 * a + b) * 1.0001], [-h * a, 0]]"),
        ("p2-christoffel", "return sp.zeros(n) + sp.eye(n)"),
    ],
)
def test_unknown_error_names_no_mistake(check_id, body):
    verdict = judged(check_id, HEADS[check_id] + body)
    known = {mistake.sentence for mistake in CHECKS[check_id].mistakes}
    assert verdict.state is not State.CORRECT
    assert not set(verdict.diagnosis) & known


def test_mistake_is_named_only_where_it_matches_to_rounding():
    transposed = f"return {C}.T * (1 + {20 * TOLERANCE})"
    (sentence,) = sentences("p2-C", "transposed")
    assert sentence not in judged("p2-C", ARM + transposed).diagnosis
    assert judged("p2-C", ARM + f"return np.float32({C}.T)").diagnosis == (sentence,)


@pytest.mark.parametrize(
    ("check_id", "body", "said"),
    [
        ("p2-M_dot", "return h * b", "an array of shape (); it must return shape (2, 2)"),
        ("p2-C", "return [h, b]", "an array of shape (2,); it must return shape (2, 2)"),
        ("p2-C_other", "return np.eye(3)", "an array of shape (3, 3); it must return shape (2, 2)"),
        ("p2-christoffel", "return sp.zeros(n, 1)", "shape (2, 1); it must return shape (2, 2)"),
    ],
)
def test_other_shapes_are_named(check_id, body, said):
    verdict = judged(check_id, HEADS[check_id] + body)
    assert verdict.state is State.ERROR
    assert said in verdict.problem
