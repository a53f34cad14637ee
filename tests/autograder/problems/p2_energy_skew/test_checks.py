"""What only p2-energy-skew asks: what each step of C earns, and another C."""

import numpy as np
import pytest
import sympy as sp

from autograder.judging.check import HIDDEN_CASES
from autograder.problems import CHECKS
from autograder.protocol import real
from tests.autograder.problems.p2_energy_skew.table import ARM, C
from tests.autograder.verdicts import judged, sentences

NEITHER = (
    "With your C the energy would change although nobody does work: q̇ᵀ(Ṁ − 2C)q̇ is not zero.",
    "With your C the matrix Ṁ − 2C is not skew-symmetric, as it is with the Christoffel form.",
)
VECTOR = "What is off in your vector C q̇ changes with qd[0] and qd[1] alone."
ENOUGH = "A right C q̇ is not enough"


@pytest.mark.parametrize("seed", range(20))
def test_the_other_c_is_one_and_not_skew(seed):
    """The reference, at the check's own cases."""
    for call in CHECKS["p2-C_other"].calls(np.random.default_rng(seed), 5):
        C, (_, qd, _) = CHECKS["p2-C"].reference(*call.args), call.args
        other = CHECKS["p2-C_other"].reference(*call.args)
        np.testing.assert_allclose(other @ qd, C @ qd, rtol=1e-12)
        assert not np.allclose(other + other.T, C + C.T, rtol=1e-2)


def test_symbolic_reference_agrees_with_the_definition():
    """The complex step against SymPy's own derivatives."""
    check = CHECKS["p2-christoffel"]
    for call in check.calls(np.random.default_rng(3), HIDDEN_CASES):
        M, q, qd = map(real, call.args)
        r, (point,) = range(len(q)), call.at
        D = [[[M[i, j].diff(q[k]) for k in r] for j in r] for i in r]
        C = [
            [sum((D[i][j][k] + D[i][k][j] - D[j][k][i]) / 2 * qd[k] for k in r) for j in r]
            for i in r
        ]
        at = {symbol: point[symbol.name] for symbol in (*q, *qd)}
        expected = np.array(sp.Matrix(C).subs(at), dtype=float)
        np.testing.assert_allclose(check.reference.of(call, point), expected, rtol=1e-12)


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
    of_properties = [said for said in verdict.diagnosis if VECTOR not in said]
    assert (of_properties != list(verdict.diagnosis)) is not met[0]
    assert all(sentence.startswith(NEITHER) for sentence in of_properties)
    for k in (1, 2):
        assert any(s.startswith(NEITHER[k - 1]) for s in verdict.diagnosis) is not met[k]
    assert (ENOUGH in " ".join(verdict.diagnosis)) is (met == (True, True, False))


def test_a_mistake_explains_what_it_breaks_and_no_more():
    """The right C q̇ of a known mistake, shared out in a new way: the skew step says so by itself."""
    verdict = judged("p2-C", ARM + "return [[-h * b, h * (2 * a + b)], [-h * a, 0]]")
    first, second = verdict.diagnosis
    assert (first,) == sentences("p2-C", "dropped / the coupling of the two links / C11")
    assert second.startswith(NEITHER[1])
    assert ENOUGH not in second


def test_another_c_must_differ_clearly():
    barely = f"return {C} + 1e-4 * h * np.outer([1, 2], [-b, a])"
    verdict = judged("p2-C_other", ARM + barely)
    assert verdict.credit == 0.5
    assert verdict.diagnosis[0].startswith("Your answer counts as not skew-symmetric only where")


def test_not_skew_counts_only_with_the_right_c_qd():
    verdict = judged("p2-C_other", ARM + f"return {C} + np.array([[3.0, 1.0], [2.0, 0.5]])")
    assert [row.met for row in verdict.rows] == [False, False]
    (said,) = verdict.diagnosis  # it is one mistake, and one in the report on the class
    assert said.startswith("Your C_other q̇ differs from C q̇.")
