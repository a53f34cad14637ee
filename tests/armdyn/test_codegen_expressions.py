"""Whatever is asked for, the code that is made computes it: brackets, powers, conditions, extremes."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import assume, given
from hypothesis import strategies as st

from armdyn.codegen import c_model, numpy_model
from tests.armdyn.expressions import A, B, X, expressions, holding, value

AT = st.tuples(*[st.floats(-3, 3).map(lambda v: round(v, 3)).filter(lambda v: abs(v) > 0.05)] * 3)
ISSUES = [
    -(X**-2) * A,
    A / (2 * (1 + X / B) ** 2),
    A / (B - X) ** 2,
    (A + 1 / (1 + X**2)) * B / 2,
    A / (X**2 * B**3),
    sp.sin(X) / X,
    sp.sqrt(sp.Integer(10) ** 21 * sp.Abs(X) + 1) / sp.sqrt(sp.Integer(10) ** 21 + 1),
    sp.Max(X, A, B) + sp.Min(X, A, B),
]


def assert_computes(model, expression, x, a, b):
    """As g, and as the acceleration that it gives a coordinate with M = 1."""
    right, spread = value(expression, {X: x, A: a, B: b})
    with np.errstate(all="ignore"):
        made = model(holding(expression), {"a": a, "b": b})
        found = [*made.g_vec([x]), *-made.dynamics([x], [0.0], [0.0])]
        found += [*made.g_vec([[x]] * 2).ravel()]  # arrays have code of their own
        found += [*-made.dynamics([[x]] * 2, [0.0], [0.0]).ravel()]
    np.testing.assert_allclose(found, [right] * 6, rtol=1e-11, atol=1e-12 + 10 * spread)


def is_well_conditioned(expression, x, a, b):
    right, spread = value(expression, {X: x, A: a, B: b})
    return np.isfinite(right) and spread < 1e-6 * (1 + abs(right))


@pytest.mark.parametrize("make", [numpy_model, c_model])
@pytest.mark.parametrize("expression", ISSUES, ids=str)
def test_brackets_stay(make, expression, request):
    if make is c_model:
        request.getfixturevalue("compiler")
    assert_computes(make, expression, 2.0, 3.0, 5.0)


@given(expressions(), AT)
def test_numpy_computes_any_expression(expression, at):
    assume(is_well_conditioned(expression, *at))
    assert_computes(numpy_model, expression, *at)


@given(expressions(), AT)
def test_c_computes_any_expression(compiler, expression, at):
    assume(is_well_conditioned(expression, *at))
    assert_computes(c_model, expression, *at)


@pytest.mark.parametrize("make", [numpy_model, c_model])
@pytest.mark.parametrize("node", [sp.zeta(X), sp.Function("h")(X)], ids=str)
def test_what_code_cannot_compute_is_refused_when_it_is_made(make, node, request):
    if make is c_model:
        request.getfixturevalue("compiler")
    with pytest.raises(ValueError, match="derivation: contains"):
        make(holding(A * node + B), {"a": 1.0, "b": 1.0})
