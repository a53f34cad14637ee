"""Wrong answers that no mistake explains: what is said of them, and that no mistake is."""

import numpy as np
import pytest

from autograder.judging.check import HIDDEN_CASES, VISIBLE_CASES
from autograder.judging.criterion import TOLERANCE
from autograder.judging.verdict import State
from autograder.problems import CHECKS
from tests.autograder.problems.row import Row, names_in, naming
from tests.autograder.problems.tables import PROBLEMS, ROWS, gathered
from tests.autograder.verdicts import (
    assert_told_apart,
    judged,
    judged_in,
    namespace_of,
    verdict_of,
)

OF_SYMBOLS = ("p2-christoffel", "p3-lagrangian")
OF_PARTS = ("c7-terms",)  # several arrays at once
# A matrix of zeros; and level links, where a torque is largest and does not change with the angle.
UNMOVED = ("zero", "from the vertical", "from the vertical, stretched only")
MEASURED = [
    row
    for row in ROWS
    if len(row.names) == 1
    and not (row.names[0] in UNMOVED and row.check in (*OF_SYMBOLS, "p4-equilibria"))
    and not CHECKS[row.check].criteria[0].is_truth
]
# Steps of RK4 that differ by less than the tolerance: they are told apart to the rounding of numbers.
CLOSE = ("p5-rk4_step", "p5-simulate")


def listed(table):
    """The entries of a table of all problems."""
    found = gathered("unknown", table)
    return [(check_id, entry) for check_id, entries in found.items() for entry in entries]


def otherwise(check_id):
    """What may be said of each criterion where nothing is known."""
    return [{own.text for own in criterion.said} for criterion in CHECKS[check_id].criteria]


@pytest.mark.parametrize("count", [VISIBLE_CASES, HIDDEN_CASES])
@pytest.mark.parametrize(("check_id", "entry"), listed("TRACED"))
def test_an_unknown_error_is_traced(check_id, entry, count):
    """To its term, to what it depends on, to a factor of all."""
    body, *said = entry
    verdict = judged(check_id, body, count=count)
    general = set().union(*otherwise(check_id))
    assert [found for found in verdict.diagnosis if found not in general] == said
    assert verdict.state is not State.CORRECT
    assert verdict.witness is not None


@pytest.mark.parametrize(("check_id", "body"), listed("UNEXPLAINED"))
def test_an_error_of_no_known_kind_is_not_explained(check_id, body):
    for seed in range(5):
        verdict = judged(check_id, body, seed, VISIBLE_CASES)
        general = otherwise(check_id)
        assert set(verdict.diagnosis) <= set().union(*general)
        for row, texts in zip(verdict.rows, general, strict=True):
            assert len(texts & set(row.said)) == (any(texts) and not row.met)
        assert verdict.state is not State.CORRECT
        assert verdict.witness is not None


@pytest.mark.parametrize(("check_id", "body"), listed("NEARLY"))
def test_nearly_right_is_wrong(check_id, body):
    namespace = namespace_of(check_id, body)
    for seed in range(5 if check_id in OF_SYMBOLS else 20):
        verdict = judged_in(namespace, check_id, seed, VISIBLE_CASES)
        assert verdict.state is not State.CORRECT


@pytest.mark.parametrize(("check_id", "entry"), listed("UNFIT"))
def test_a_card_says_what_was_given_and_what_is_needed(check_id, entry):
    body, said = entry
    verdict = judged(check_id, body)
    assert verdict.state is State.ERROR
    assert said in verdict.problem


def test_only_symbols_call_for_sympys_functions():
    """The same error of NumPy, where the arguments are numbers and the symbol is the student's own."""
    verdict = judged("p3-g_vec", "np.cos(sp.Symbol('q'))")
    assert verdict.state is State.ERROR
    assert "SymPy's own" not in verdict.problem
    assert "The arguments are numbers" in verdict.problem


def test_sympys_own_truth_is_one():
    A = "sp.Matrix(A.round(8))"
    body = f"return sp.true if {A}.is_symmetric() and {A}.is_positive_definite else sp.false"
    assert judged("p1-is_spd", body).rows[0].met


def test_each_problem_has_some():
    for table in ("TRACED", "UNFIT"):
        assert {id.partition("-")[0] for id, _ in listed(table)} == {p[:2] for p in PROBLEMS}, (
            f"each problem's unknown.py needs some in {table}"
        )


def moved(row: Row, wrong, *args):
    """What the mistaken function returns, off by some 20 times the tolerance, also where it is 0."""
    value, by = wrong(*args), 20 * TOLERANCE
    if row.check in OF_SYMBOLS:
        return value * (1 + by)
    right = CHECKS[row.check].reference(*args)
    if row.check in OF_PARTS:
        return [moved_from(row, *both) for both in zip(value, right, strict=True)]
    return moved_from(row, value, right)


def moved_from(row: Row, value, right):
    by, right, value = 20 * TOLERANCE, np.asarray(right, dtype=float), np.asarray(value)
    # Of another shape, or of equilibria in their free order: the right ones do not belong to it.
    alike = value.shape == right.shape and row.check != "p4-equilibria"
    return value * (1 + by) + (1.7 * by * right if alike else by)


def in_single_precision(row: Row, value):
    return list(map(np.float32, value)) if row.check in OF_PARTS else np.float32(value)


def assert_named_only_where_it_matches(row: Row):
    check = naming(row.check)
    namespace = namespace_of(row.check, row.body)
    wrong = namespace[check.name]

    def named(given):
        return names_in(verdict_of(check, namespace | {check.name: given}, count=VISIBLE_CASES))

    assert row.names[0] not in named(lambda *args: moved(row, wrong, *args))
    if row.check not in OF_SYMBOLS and row.names != (
        "C itself",
    ):  # which a hair tells from another
        assert named(lambda *args: in_single_precision(row, wrong(*args)))[:1] == row.names


@pytest.mark.parametrize("row", MEASURED[::4], ids=str)
def test_some_mistakes_are_named_only_where_they_match_to_rounding(row):
    assert_named_only_where_it_matches(row)


@pytest.mark.long
@pytest.mark.parametrize("row", MEASURED, ids=str)
def test_a_mistake_is_named_only_where_it_matches_to_rounding(row):
    assert_named_only_where_it_matches(row)


@pytest.mark.parametrize("check_id", [id for id in CHECKS if id not in CLOSE])
def test_no_wrong_model_looks_like_another(check_id):
    for seed in range(3):
        assert_told_apart(CHECKS[check_id], seed)
