"""Random expressions over every node that code can compute, and derivations that hold them."""

from itertools import count, cycle, islice

import numpy as np
import sympy as sp
from hypothesis import strategies as st

from armdyn.derive import Derivation

X, V, A, B = sp.symbols("x v a b", real=True)
UNARY = (
    lambda e: sp.Mul(-1, e, evaluate=False),
    lambda e: e**2,
    lambda e: e**3,
    lambda e: 1 / e,
    lambda e: 1 / e**2,
    lambda e: sp.Pow(sp.Pow(e, 2, evaluate=False), 3, evaluate=False),
    lambda e: sp.Abs(e) ** sp.Rational(2, 3),
    lambda e: sp.Abs(e) ** sp.Rational(-1, 3),
    lambda e: 1 / sp.sqrt(e**2 + 1),
    lambda e: sp.sqrt(sp.Abs(e)),
    lambda e: sp.exp(-(e**2)),
    lambda e: 2 ** sp.tanh(e),
    lambda e: sp.log(e**2 + 1),
    lambda e: sp.asin(sp.sin(e) / 2) + sp.acos(sp.cos(e) / 2) + sp.atanh(sp.tanh(e) / 2),
    lambda e: sp.asinh(e) + sp.acosh(1 + e**2),
    lambda e: sp.sinh(sp.sin(e)) * sp.cosh(sp.cos(e)),
    lambda e: sp.Max(e, 0).diff(X),
    lambda e: sp.Piecewise((sp.sin(e) / e, sp.Ne(e, 0)), (1, True)),
    sp.sin, sp.cos, sp.tan, sp.tanh, sp.atan, sp.Abs, sp.sign, sp.floor, sp.ceiling, sp.sinc,
    sp.Heaviside, sp.frac, sp.sech,
)  # fmt: skip
BINARY = (
    lambda e, f: e + f,
    lambda e, f: e - f,
    lambda e, f: sp.Add(e, sp.Mul(-1, f, evaluate=False), evaluate=False),
    lambda e, f: e * f,
    lambda e, f: e / f,
    lambda e, f: e / f**2,
    lambda e, f: e / (f + 1) ** 2,
    lambda e, f: sp.Mul(e, sp.Pow(f, -1, evaluate=False), evaluate=False),
    lambda e, f: (e / f) ** 2,
    lambda e, f: sp.Min(e, f),
    lambda e, f: sp.Max(e, f),
    lambda e, f: sp.Mod(e, f),
    lambda e, f: sp.atan2(e, f),
    lambda e, f: sp.Piecewise((e, X > A), (f, True)),
    lambda e, f: sp.Piecewise((1, e >= f), (2, True)) / sp.Piecewise((3, X < B), (2, True)),
    lambda e, f: sp.Piecewise((e, sp.Or(sp.And(X > A, X > B), B < A)), (2, e > f), (f, True)),
)
LEAVES = (
    *(X, A, B, sp.pi, sp.E, sp.GoldenRatio, sp.Float("0.25"), sp.Float("1e-7")),
    *(sp.Integer(n) for n in (-1, 2, 3)),
    *(sp.Rational(p, q) for p, q in ((1, 3), (-5, 7), (10**20 + 1, 3 * 10**20))),
)


# What not all languages have.
IN_SOME = {
    **{f(X**2): {"C++", "MATLAB", "Wolfram"} for f in (sp.erf, sp.erfc, sp.gamma, sp.loggamma)},
    sp.besselj(1, X): {"MATLAB", "Wolfram"},
    sp.bessely(0, X**2): {"MATLAB", "Wolfram"},
    sp.besseli(1, X): {"MATLAB", "Wolfram"},
    sp.besselk(0, X**2): {"MATLAB", "Wolfram"},
    sp.zeta(X**2 + 1): {"Wolfram"},
}


def expressions(depth: int = 3):
    """Of x, a and b."""
    inner = st.sampled_from(LEAVES)
    for _ in range(depth):
        one = st.builds(applied, st.sampled_from(UNARY), inner)
        two = st.builds(applied, st.sampled_from(BINARY), inner, inner)
        inner = st.one_of(st.sampled_from(LEAVES), one, two)
    return inner


def applied(function, *arguments):
    """The function of them, or the first where that is no number, as 1/0."""
    try:
        found = function(*arguments)
    except (ArithmeticError, AttributeError, TypeError, ValueError):  # the last three: SymPy's own
        return arguments[0]
    return arguments[0] if found.has(sp.oo, -sp.oo, sp.zoo, sp.nan, sp.I) else found


def holding(*expressions: sp.Expr) -> Derivation:
    """As many coordinates, x the first, with M = 1 and this gravity."""
    n = len(expressions)
    gravity = sp.ImmutableMatrix(n, 1, expressions)
    zero = sp.ImmutableMatrix(sp.zeros(n, n))
    return Derivation(*_states(n), (A, B), sp.ImmutableMatrix(sp.eye(n)), zero, gravity, sp.S.Zero)


def _states(n):
    return (X, *sp.symbols(f"y1:{n}", real=True)), (V, *sp.symbols(f"w1:{n}", real=True))


def holding_all(expressions) -> Derivation:
    """Coordinates, x the first, with M = 1 and the expressions as the entries of C and g, and P."""
    n = next(n for n in count(1) if n * n + n + 1 >= len(expressions))
    entries = list(islice(cycle(expressions), n * n + n + 1))
    C = sp.ImmutableMatrix(n, n, entries[: n * n])
    g = sp.ImmutableMatrix(n, 1, entries[n * n : -1])
    return Derivation(*_states(n), (A, B), sp.ImmutableMatrix(sp.eye(n)), C, g, entries[-1])


def values_held(terms, number: int) -> np.ndarray:
    """(..., number): what a program that was made of `holding_all` says of the expressions."""
    C = terms.C.reshape(*terms.C.shape[:-2], -1)
    found = np.concatenate([C, terms.g_vec, terms.potential_energy[..., np.newaxis]], axis=-1)
    return found[..., :number]


def value(expression: sp.Expr, at: dict) -> tuple[float, float]:
    """SymPy's value with 30 digits, and how much rounding in double precision may move it.

    The second is NaN where there is no finite real value, or where it hangs on a digit too far.
    """
    exact = {s: sp.Float(v, 50) for s, v in at.items()}
    found = _evaluated(expression, exact)
    moved = [
        _evaluated(expression, exact | {s: exact[s] * (1 + sp.Float(d, 50))})
        for s in at
        for d in ("1e-13", "-1e-13")
    ]
    # So are fractions, and what is added to a large number; 2, 3 and the like are exact.
    rounded = {c for c in expression.atoms(sp.Rational) if c.q != 1 or abs(c) > 1000}
    rounded |= expression.atoms(sp.NumberSymbol, sp.Float)
    # And sums of numbers, the innermost: acosh(1 + 1e-15) hangs on the last digit.
    rounded |= {c for c in expression.atoms(sp.Add) if c.is_number and c.atoms(sp.Add) == {c}}
    nudged = {c: c.evalf(50) * (1 + sp.Float("1e-15", 50)) for c in rounded}
    moved.append(_evaluated(expression, nudged, exact))
    # With every step rounded to 53 bits: 1 + x loses a small x, whatever becomes of it.
    moved.append(_evaluated(expression, {s: sp.Float(v, 15) for s, v in at.items()}))
    if not all(e.is_Float or e.is_Rational for e in (found, *moved)):
        return float("nan"), float("nan")
    if not all(abs(e) < 1e12 for e in (found, *moved)):
        return float("nan"), float("nan")
    spread = max(abs(float(e - found)) for e in moved)
    return float(found), spread


def _evaluated(expression, *at):
    """Its value with these in place, one mapping after the other; nan where SymPy finds none."""
    try:
        for mapping in at:
            expression = expression.xreplace(mapping)
        return expression.evalf(30)
    except (ArithmeticError, AttributeError, TypeError, ValueError):  # a condition on 1/0, say
        return sp.nan


def is_well_conditioned(expression: sp.Expr, at: dict) -> bool:
    right, spread = value(expression, at)
    return np.isfinite(right) and spread < 1e-6 * (1 + abs(right))
