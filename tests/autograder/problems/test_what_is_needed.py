"""A card says in plain words what an answer gave that is no answer, and what is needed."""

import pytest

from autograder.judging.verdict import State
from tests.autograder.verdicts import judged

NUMBERS = "it must return numbers."
CALL_IT = "Call it: write its arguments behind it, in round brackets."
EXPRESSION = "it must return a SymPy expression of its arguments."
EXPRESSIONS = "it must return SymPy expressions of its arguments."
TRUTH = "it must return True or False."
USE_SYMPY = "takes only numbers, and this is a SymPy expression: SymPy's own is sp.cos."


@pytest.mark.parametrize(
    ("check_id", "body", "said"),
    [
        (
            "p3-g_vec",
            "'m g lc sin q'",
            f"returned the text 'm g lc sin q'; {NUMBERS} Without the quotes, Python would compute it.",
        ),
        ("p3-g_vec", "(-pend.m) ** 0.5", f"{NUMBERS} Is it a root of something negative?"),
        ("p3-g_vec", "np.array([1j])", f"{NUMBERS} Is there a root of something negative?"),
        ("p3-g_vec", "np.array([True])", f"returned an array of True and False; {NUMBERS}"),
        ("p3-g_vec", "bool(abs(q[0]) < 9)", f"returned True; {NUMBERS}"),
        ("p3-g_vec", "np.sin", f"returned the function sin itself; {NUMBERS} {CALL_IT}"),
        ("p3-g_vec", "sp.Eq(sp.Symbol('u'), 1)", f"returned the equation Eq(u, 1); {NUMBERS}"),
        ("p3-lagrangian", "'K - P'", f"returned the text 'K - P'; {EXPRESSION}"),
        ("p3-lagrangian", "sp.Eq(q, 1)", f"returned the equation Eq(q, 1); {EXPRESSION}"),
        ("p3-lagrangian", "np.array([True])", f"returned True; {EXPRESSION}"),
        (
            "p3-lagrangian",
            "sp.Symbol('x') * q",
            f"returned an expression that still contains x; {EXPRESSION}",
        ),
        ("p3-lagrangian", "m * np.cos(q)", USE_SYMPY),
        ("p3-lagrangian", "import math\nreturn m * math.cos(q)", USE_SYMPY),
        ("p2-christoffel", "'C'", f"returned the text 'C'; {EXPRESSIONS}"),
        ("p1-is_spd", "'yes'", f"returned the text 'yes'; {TRUTH}"),
        ("p1-is_spd", "sp.Symbol('x') > 0", f"returned the inequality x > 0; {TRUTH}"),
    ],
)
def test_a_card_says_what_was_given_and_what_is_needed(check_id, body, said):
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
    matrix = "sp.Matrix(A.round(8))"
    body = (
        f"return sp.true if {matrix}.is_symmetric() and {matrix}.is_positive_definite else sp.false"
    )
    assert judged("p1-is_spd", body).rows[0].met
