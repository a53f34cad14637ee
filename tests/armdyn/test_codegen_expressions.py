"""Whatever is asked for, the code that is made computes it: brackets, powers, conditions, extremes."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import HealthCheck, Phase, assume, given, settings
from hypothesis import strategies as st

from armdyn import ports
from armdyn.codegen import c_model, numpy_model
from tests.armdyn.expressions import (
    BINARY,
    IN_SOME,
    LEAVES,
    UNARY,
    A,
    B,
    X,
    expressions,
    holding,
    holding_all,
    is_well_conditioned,
    value,
    values_held,
)

PACKAGES = {
    "cpp": ("g++", "libeigen3-dev"),
    "java": ("default-jdk-headless", "libejml-java"),
    "matlab": ("octave",),
    "wolfram": (),
}
coordinate = st.floats(-3, 3).map(lambda v: round(v, 3)).filter(lambda v: abs(v) > 0.05)
AT = st.tuples(coordinate, coordinate, coordinate)
ISSUES = [
    -(X**-2) * A,
    A / (2 * (1 + X / B) ** 2),
    A / (B - X) ** 2,
    (A + 1 / (1 + X**2)) * B / 2,
    A / (X**2 * B**3),
    sp.sin(X) / X,
    sp.sqrt(sp.Integer(10) ** 21 * sp.Abs(X) + 1) / sp.sqrt(sp.Integer(10) ** 21 + 1),
    sp.Max(X, A, B) + sp.Min(X, A, B),
    # Integers by themselves: C, C++ and Java would drop the remainder, or run over.
    sp.Add(X, sp.Mul(2, sp.Pow(3, -1, evaluate=False), evaluate=False), evaluate=False),
    sp.sign(X) / (2 + sp.sign(A - X)),
    (2 + sp.Piecewise((1, X > A), (2, True))) / (3 + sp.Piecewise((3, X > B), (4, True))),
    sp.Mul(2 * 10**9, sp.Integer(2), X, evaluate=False),
    3 * 10**9 + X * 10**9,
    sp.zeta(3) * X,
    # A condition on a Piecewise becomes an ITE of conditions.
    sp.Piecewise((A, sp.sinc(X) > sp.sinc(B) * X), (2, sp.sinc(X - A) < X), (B, True)),
]
# One of each kind, of x, a and b, by itself.
EACH = [f(X - A) for f in UNARY] + [f(X - A, B) for f in BINARY] + [e * X for e in LEAVES] + ISSUES


@pytest.fixture(scope="module", params=PACKAGES)
def language(request, needs):
    for package in PACKAGES[request.param]:
        needs(package)
    if line := ports.missing(request.param):
        pytest.skip(line)
    return request.param


def assert_computes(model, expression, x, a, b):
    """As g, and as the acceleration that it gives a coordinate with M = 1."""
    right, spread = value(expression, {X: x, A: a, B: b})
    with np.errstate(all="ignore"):
        made = model(holding(expression), {"a": a, "b": b})
        found = [*made.g_vec([x]), *-made.dynamics([x], [0.0], [0.0])]
        found += [*made.g_vec([[x]] * 2).ravel()]  # arrays have code of their own
        found += [*-made.dynamics([[x]] * 2, [0.0], [0.0]).ravel()]
    np.testing.assert_allclose(found, [right] * 6, rtol=1e-11, atol=1e-12 + 10 * spread)


def programs_values(language, asked, rows):
    """(rows, expressions): what a program that holds the expressions says at each (x, a, b)."""
    derivation = holding_all(asked)
    states = np.zeros((len(rows), 2 * derivation.n))
    states[:, 0] = [x for x, _, _ in rows]
    with ports.start(language, derivation, seconds=300) as program:
        terms = program.terms([numbers for _, *numbers in rows], states)
    return values_held(terms, len(asked))


def assert_program_computes(language, asked, rows):
    """Those of the expressions that are well conditioned at all the rows."""
    places = [dict(zip((X, A, B), row, strict=True)) for row in rows]
    asked = [e for e in asked if all(is_well_conditioned(e, place) for place in places)]
    found = programs_values(language, asked, rows)
    for place, numbers in zip(places, found, strict=True):
        for expression, number in zip(asked, numbers, strict=True):
            right, spread = value(expression, place)
            error = abs(number - right)
            assert error <= 1e-12 + 1e-11 * abs(right) + 10 * spread, (expression, place)


@pytest.mark.parametrize("make", [numpy_model, c_model])
@pytest.mark.parametrize("expression", ISSUES, ids=str)
def test_brackets_stay(make, expression, request):
    if make is c_model:
        request.getfixturevalue("compiler")
    assert_computes(make, expression, 2.0, 3.0, 5.0)


@given(expressions(), AT)
def test_numpy_computes_any_expression(expression, at):
    assume(is_well_conditioned(expression, dict(zip((X, A, B), at, strict=True))))
    assert_computes(numpy_model, expression, *at)


# Each example is compiled: so many expressions in one.
@settings(deadline=None, max_examples=8)
@given(st.lists(expressions(), min_size=8, max_size=8), AT)
def test_c_computes_any_expression(compiler, asked, at):
    place = dict(zip((X, A, B), at, strict=True))
    asked = [e for e in asked if is_well_conditioned(e, place)]
    assume(asked)
    model = c_model(holding(*asked), {"a": at[1], "b": at[2]})
    state = np.zeros((2, model.n))
    state[:, 0] = at[0]
    rest = np.zeros(model.n)
    found = -np.array([model.dynamics(state[0], rest, rest), *model.dynamics(state, rest, rest)])
    for expression, numbers in zip(asked, found.T, strict=True):
        right, spread = value(expression, place)
        bound = 1e-12 + 1e-11 * abs(right) + 10 * spread
        assert np.all(np.abs(numbers - right) <= bound), expression


def test_each_kind_by_itself(language):
    name = {"cpp": "C++", "java": "Java", "matlab": "MATLAB", "wolfram": "Wolfram"}[language]
    more = [expression for expression, names in IN_SOME.items() if name in names]
    assert_program_computes(language, EACH + more, [(2.0, 3.0, 5.0), (-1.0, 0.3, -2.0)])


# Where x = a: what is not defined there is in a case that does not hold.
SINC = sp.Piecewise((sp.sin(X - A) / (X - A), sp.Ne(X, A)), (1, True))
EDGES = {
    sp.sign(X - A): 0,
    sp.Heaviside(X - A): 0.5,
    sp.Heaviside(X - A, 1): 1,
    sp.Max(X, A).diff(X): 0.5,
    sp.Abs(X - A).diff(X): 0,
    sp.sinc(X - A): 1,
    SINC: 1,
    SINC**2 + 1: 2,
    SINC.diff(X): 0,
    sp.Piecewise((sp.log(X - A) / (X - A), X > A), (A * SINC, True)): 0.25,
    sp.Abs(X - A) ** sp.Rational(2, 3): 0,
    sp.floor(X / A) + sp.ceiling(X / A) + sp.Mod(X, A): 2,
    sp.atan2(X - A, A): 0,
}


def test_edges(language):
    (found,) = programs_values(language, list(EDGES), [(0.25, 0.25, 0.7)])
    np.testing.assert_allclose(found, list(map(float, EDGES.values())), atol=1e-15)


@pytest.mark.parametrize("make", [numpy_model, c_model])
def test_edges_in_python(make, request):
    if make is c_model:
        request.getfixturevalue("compiler")
    for expression, right in EDGES.items():
        made = make(holding(expression), {"a": 0.25, "b": 0.7})
        found = [*made.g_vec([0.25]), *made.g_vec([[0.25]] * 2).ravel()]
        found += [*-made.dynamics([0.25], [0.0], [0.0]), *-made.dynamics([[0.25]], [0.0], [0.0])[0]]
        np.testing.assert_allclose(found, [float(right)] * 5, atol=1e-15)


# An example is a program of its own, which is built and started; Mathics takes seconds for that.
@pytest.mark.parametrize(
    "language",
    [pytest.param(name, marks=pytest.mark.long if name == "wolfram" else ()) for name in PACKAGES],
    indirect=True,
)
@settings(
    deadline=None,
    max_examples=1,
    phases=[Phase.reuse, Phase.generate],
    suppress_health_check=list(HealthCheck),
)
@given(
    asked=st.lists(expressions(), min_size=40, max_size=40),
    rows=st.lists(AT, min_size=2, max_size=2),
)
def test_a_program_computes_any_expressions(language, asked, rows):
    assume(len(set(asked)) > 20)  # the first that Hypothesis tries are all alike
    assert_program_computes(language, asked, rows)
