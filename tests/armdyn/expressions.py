"""Random expressions over every node that code can compute, and derivations that hold them."""

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
    lambda e: 1 / sp.sqrt(e**2 + 1),
    lambda e: sp.sqrt(sp.Abs(e)),
    lambda e: sp.exp(-(e**2)),
    lambda e: sp.log(e**2 + 1),
    sp.sin, sp.cos, sp.tanh, sp.atan, sp.Abs, sp.sign,
)  # fmt: skip
BINARY = (
    lambda e, f: e + f,
    lambda e, f: e - f,
    lambda e, f: sp.Add(e, sp.Mul(-1, f, evaluate=False), evaluate=False),
    lambda e, f: e * f,
    lambda e, f: e / f,
    lambda e, f: e / f**2,
    lambda e, f: sp.Mul(e, sp.Pow(f, -1, evaluate=False), evaluate=False),
    lambda e, f: (e / f) ** 2,
    lambda e, f: sp.Min(e, f),
    lambda e, f: sp.Max(e, f),
    lambda e, f: sp.atan2(e, f),
    lambda e, f: sp.Piecewise((e, X > A), (f, True)),
)
LEAVES = (X, A, B, sp.Integer(2), sp.Rational(1, 3), sp.Rational(-5, 7), sp.Float("0.25"), sp.pi)


def expressions(depth: int = 3):
    """Of x, a and b."""
    inner = st.sampled_from(LEAVES)
    for _ in range(depth):
        one = st.builds(lambda f, e: f(e), st.sampled_from(UNARY), inner)
        two = st.builds(lambda f, e, g: f(e, g), st.sampled_from(BINARY), inner, inner)
        inner = st.one_of(st.sampled_from(LEAVES), one, two)
    return inner


def holding(expression: sp.Expr) -> Derivation:
    """One coordinate x with M = 1 and this gravity."""
    return Derivation(
        (X,), (V,), (A, B),
        sp.ImmutableMatrix([[1]]), sp.ImmutableMatrix([[0]]), sp.ImmutableMatrix([expression]),
        sp.S.Zero,
    )  # fmt: skip


def value(expression: sp.Expr, at: dict) -> tuple[float, float]:
    """SymPy's value with 30 digits, and how much rounding in double precision may move it.

    The second is NaN where there is no finite real value, or where it hangs on a digit too far.
    """
    exact = {s: sp.Float(v, 50) for s, v in at.items()}
    found = expression.xreplace(exact).evalf(30)
    moved = [
        expression.xreplace(exact | {s: exact[s] * (1 + sp.Float(d, 50))}).evalf(30)
        for s in at
        for d in ("1e-13", "-1e-13")
    ]
    if not all(e.is_Number and e.is_finite and abs(e) < 1e12 for e in (found, *moved)):
        return float("nan"), float("nan")
    spread = max(abs(float(e - found)) for e in moved)
    return float(found), spread
