"""What cannot be written in a language is refused when its source is made, by name."""

import pytest
import sympy as sp

from armdyn.codegen import c_model, cpp, java, matlab, numpy_model, wolfram
from armdyn.codegen.vocabulary import writable
from armdyn.derive import Derivation, from_energies
from tests.armdyn.expressions import IN_SOME, A, B, V, X, holding

LANGUAGES = ("NumPy", "C++", "Java", "MATLAB", "Wolfram")
WRITERS = {
    "NumPy": lambda d: numpy_model(d, {"a": 1.0, "b": 1.0}),
    "C": lambda d: c_model(d, {"a": 1.0, "b": 1.0}),
    "C++": cpp,
    "Java": java,
    "MATLAB": matlab,
    "Wolfram": wolfram,
}
h = sp.Function("h")
NOWHERE = {
    "ImaginaryUnit": sp.I * X,
    "ComplexInfinity": sp.Mul(X, sp.zoo, evaluate=False),
    "finite real numbers": sp.Mul(X, sp.oo, evaluate=False),
    "finite real numbers, ": sp.Add(X, sp.nan, evaluate=False),
    "within the range of doubles": X + sp.Integer(10) ** 400,
    r"h\(x\)": h(X),
    r"h\(x\), which": sp.Derivative(h(X), X),
    r"Derivative\(floor": sp.floor(X).diff(X),
    "Integral": sp.Integral(sp.exp(X * A**2), (A, 0, B)),
    "no Sum": sp.Sum(X**A, (A, 1, B)),
    "DiracDelta": sp.DiracDelta(X),
    "LambertW": sp.LambertW(X),
    "polylog": sp.polylog(2, X),
    "binomial": sp.binomial(X, A),
    "KroneckerDelta": sp.KroneckerDelta(X, A),
    "Trace": sp.Trace(sp.MatrixSymbol("m", 2, 2)),
    "MatrixElement": sp.MatrixSymbol("m", 2, 2)[0, 1],
    "Indexed": sp.IndexedBase("m")[0],
    "Limit": sp.Limit(sp.sin(A) / A, A, B),
    "Order": sp.Order(X),
    "exp_polar": sp.exp_polar(X),
    "last case": sp.Piecewise((X, X > A)),
    "Contains": sp.Piecewise((X, sp.Contains(X, sp.Interval(A, B))), (A, True)),
    "depends on y": X * sp.Symbol("y"),
    "depends on v": X * V,
}


@pytest.mark.parametrize("language", WRITERS)
@pytest.mark.parametrize("named", NOWHERE)
def test_what_no_language_has_is_refused(language, named):
    with pytest.raises(ValueError, match=f"^g .*{named}"):
        WRITERS[language](holding(A * NOWHERE[named] + B))


@pytest.mark.filterwarnings("ignore:(?s).*non-Expr objects:DeprecationWarning")
@pytest.mark.parametrize("language", WRITERS)
def test_a_condition_is_no_number(language):
    with pytest.raises(ValueError, match=r"^P contains .*a condition is no number"):
        WRITERS[language](with_part("P", X > A))


@pytest.mark.parametrize("language", WRITERS)
@pytest.mark.parametrize("expression", IN_SOME, ids=str)
def test_what_a_language_lacks_is_refused(language, expression):
    name = type(expression).__name__
    if language in IN_SOME[expression]:
        WRITERS[language](holding(A * expression + B))
        return
    wanted = rf"^g contains {name}\(.*, which cannot be written in \S+: it has no {name}$"
    with pytest.raises(ValueError, match=wanted):
        WRITERS[language](holding(A * expression + B))


def with_part(part, entry):
    """holding(1) with another entry in one of its parts."""
    parts = {"M": 1, "C": 0, "g_vec": 0, "f_vec": 0, "P": sp.S.Zero} | {part: entry}
    matrices = {p: sp.ImmutableMatrix([[e]]) for p, e in parts.items() if p != "P"}
    return Derivation((X,), (V,), (A, B), P=parts["P"], **matrices)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(
    ("part", "entry", "complaint"),
    [
        ("M", 1 + V**2, "M depends on v: needs q and parameters only"),
        ("g_vec", V, "g depends on v: needs q and parameters only"),
        ("P", V, "P depends on v: needs q and parameters only"),
        ("C", V * sp.Symbol("y"), "C depends on y: needs q, qd and parameters only"),
        ("M", sp.I, "M contains I, which cannot be written in"),
        ("C", sp.I, "C contains I, which cannot be written in"),
        ("f_vec", sp.I * V, "f contains I, which cannot be written in"),
        ("P", sp.I, "P contains I, which cannot be written in"),
    ],
)
def test_the_part_is_named(language, part, entry, complaint):
    with pytest.raises(ValueError, match=f"^{complaint}"):
        writable(with_part(part, entry), language)


@pytest.mark.parametrize("language", LANGUAGES)
def test_symbols_are_real(language):
    """SymPy's derivative of |x| is one of re(x) as long as x might be complex."""
    x, v = sp.symbols("x v")
    g = writable(from_energies(v**2 / 2, sp.Abs(x) + sp.Max(x, 1), [x], [v]), language).g_vec
    assert g[0].equals(sp.sign(x) + (1 + sp.sign(x - 1)) / 2)


def test_shared_nodes_are_looked_at_once():
    """Doubled sixty times over, a sum has more terms than anybody could look at, in 60 nodes."""
    e = X
    for _ in range(60):
        e = sp.Add(e, sp.Mul(A, e, evaluate=False), evaluate=False)
    assert writable(holding(e), "NumPy").g_vec[0] is e
