"""Turns a derivation into straight-line code: constants once per arm, angles, then numbered steps."""

from dataclasses import dataclass, field

import sympy as sp
from sympy.core.function import AppliedUndef

from armdyn.derive import Derivation, graph


@dataclass(frozen=True)
class StraightLine:
    """What to compute, in order. All symbols are fresh, whatever the derivation's are called.

    constants: expressions in the derivation's parameters; the code reads the k-th as `k_k`.
    angle_steps, angles: (sine, cosine, angle) for each angle of which sines and cosines are needed,
    in q_i, v_i, k_i and the steps before. steps: (symbol, expression) in q_i, v_i, u_i, k_i, the
    sines and cosines, and earlier steps. outputs: the results, in the same symbols.
    """

    constants: tuple[sp.Expr, ...]
    angle_steps: tuple[tuple[sp.Symbol, sp.Expr], ...]
    angles: tuple[tuple[sp.Symbol, sp.Symbol, sp.Expr], ...]
    steps: tuple[tuple[sp.Symbol, sp.Expr], ...]
    outputs: tuple[sp.Expr, ...]


def terms(derivation: Derivation, expressions) -> StraightLine:
    """Code that computes the given expressions of the derivation's symbols."""
    lifted = _Lifting(derivation)
    steps, outputs = lifted.shared([lifted(e) for e in expressions], "x_")
    return lifted.finish(steps, outputs)


def forward_dynamics(derivation: Derivation) -> StraightLine:
    """Code that computes q̈ from q, q̇, u: n outputs, then two numbers of a positive quotient.

    M = L D Lᵀ written out, without square roots and without pivoting, which a symmetric positive
    definite M does not need (G. H. Golub, C. F. Van Loan (1996), Matrix Computations, chapter 4).
    The quotient is the smallest pivot of D over the trace of M: tiny where M is close to singular.
    """
    n = derivation.n
    lifted = _Lifting(derivation)
    lower = [(i, j) for i in range(n) for j in range(i + 1)]
    velocity = [lifted(v) for v in derivation.qd]
    torques = []
    for i in range(n):
        if derivation.bias is None:
            products = [lifted(derivation.C[i, j]) * velocity[j] for j in range(n)]
            bias = [_fewest(_sum(products), n), lifted(derivation.g_vec[i])]
        else:
            bias = [lifted(derivation.bias[i])]
        bias.append(lifted(derivation.f_vec[i]))
        torques.append(_sum([sp.Symbol(f"u_{i}"), *map(lifted.negative, bias)]))
    entries = [lifted(derivation.M[i, j]) for i, j in lower]
    steps, found = lifted.shared([*entries, *torques], "x_")
    M = dict(zip(lower, found, strict=False))
    rest = found[len(lower) :]

    def keep(name, expression):
        if expression.is_Atom:
            return expression
        symbol = sp.Symbol(name)
        steps.append((symbol, expression))
        return symbol

    # Column by column: W = L D as it comes, before its division by the pivot.
    L: dict = {}
    W: dict = {}
    inverse, pivots = [], []
    M = {at: keep("M_{}_{}".format(*at), entry) for at, entry in M.items()}
    block = max(n - 2, 0)

    def left(i, j):
        return M[i, j] - _sum([L[i, k] * W[j, k] for k in range(min(j, block))])

    for j in range(block):
        pivots.append(keep(f"D_{j}", left(j, j)))
        inverse.append(keep(f"i_{j}", 1 / pivots[j]))
        for i in range(j + 1, n):
            W[i, j] = keep(f"W_{i}_{j}", left(i, j))
            L[i, j] = keep(f"L_{i}_{j}", W[i, j] * inverse[j])
    for i in range(n):
        rest[i] = keep(f"y_{i}", rest[i] - _sum([L[i, j] * rest[j] for j in range(min(i, block))]))
    solution = [None] * n
    trace = _sum([M[i, i] for i in range(n)])
    if n == 1:
        return lifted.finish(steps, [keep("a_0", rest[0] / M[0, 0]), M[0, 0], trace])
    # The last two by Cramer's rule: a division takes as long as a dozen multiplications, and here
    # is one in place of two.
    i, j = n - 2, n - 1
    first, both, second = (
        keep(f"{name}_{j}", left(*at)) for name, at in (("A", (i, i)), ("B", (j, i)), ("C", (j, j)))
    )
    det = keep("det", first * second - both**2)
    whole = keep(f"i_{j}", 1 / det)
    solution[j] = keep(f"a_{j}", (first * rest[j] - both * rest[i]) * whole)
    solution[i] = keep(f"a_{i}", (second * rest[i] - both * rest[j]) * whole)
    for i in reversed(range(block)):
        later = _sum([L[j, i] * solution[j] for j in range(i + 1, n)])
        solution[i] = keep(f"a_{i}", rest[i] * inverse[i] - later)
    # The last pivot is det/first: all are compared with the trace as products with first.
    size = keep("size", sp.Abs(first, evaluate=False))
    smallest = sp.Min(*pivots, first, evaluate=False) if pivots else first
    pivot = sp.Min(smallest * size, det, evaluate=False)
    return lifted.finish(steps, [*solution, pivot, trace * size])


@dataclass
class _Lifting:
    """Rewrites expressions in fresh symbols; what holds parameters only becomes a constant."""

    derivation: Derivation
    constants: dict = field(default_factory=dict)
    angles: dict = field(default_factory=dict)
    known: dict = field(default_factory=dict)

    def __post_init__(self):
        for name, symbols in (("q", self.derivation.q), ("v", self.derivation.qd)):
            self.known.update({s: sp.Symbol(f"{name}_{i}") for i, s in enumerate(symbols)})
        self.fixed = dict.fromkeys(self.known, False)
        # Then the parts are as they should be, and SymPy would flatten them.
        self.by_recursion = self.derivation.bias is not None

    def __call__(self, expression):
        """The expression in fresh symbols."""
        return self._constant(expression) if self._fixed(expression) else self._walk(expression)

    def finish(self, steps, outputs):
        """The program of these steps, with the constants and angles met on the way."""
        pairs, added = _angle_sums({angle: _pair(i) for angle, i in self.angles.items()})
        steps = [*_used(added, [*(e for _, e in steps), *outputs]), *steps]
        angle_steps, arguments = self.shared([angle for _, angle in pairs], "t_")
        angles = [(*pair, angle) for (pair, _), angle in zip(pairs, arguments, strict=True)]
        return StraightLine(
            tuple(self.constants), tuple(angle_steps), tuple(angles), tuple(steps), tuple(outputs)
        )

    def shared(self, expressions, name):
        """(steps, expressions) with common subexpressions as steps."""
        symbols = sp.numbered_symbols(name, cls=sp.Symbol)
        if self.by_recursion:
            return graph.shared(expressions, symbols)
        steps, reduced = sp.cse(expressions, symbols=symbols, order="none")
        return list(steps), list(reduced)

    def negative(self, e):
        """−e."""
        return sp.Mul(sp.S.NegativeOne, e, evaluate=not self.by_recursion)

    def _fixed(self, e):
        if e not in self.fixed:
            self.fixed[e] = all(map(self._fixed, e.args))
        return self.fixed[e]

    def _constant(self, e):
        if not e.free_symbols:
            return e
        if not isinstance(e, sp.Expr):  # the condition of a Piecewise
            return e.func(*(self(a) for a in e.args))
        if e not in self.constants:
            self.constants[e] = sp.Symbol(f"k_{len(self.constants)}")
        return self.constants[e]

    def _walk(self, e):
        if e not in self.known:
            self.known[e] = self._rewritten(e)
        return self.known[e]

    def _rewritten(self, e):
        if isinstance(e, AppliedUndef | sp.Derivative | sp.Integral):
            raise ValueError(f"derivation: contains {e}, which code cannot compute")
        moving = [self._walk(a) for a in e.args if not self._fixed(a)]
        if isinstance(e, sp.Add | sp.Mul):
            fixed = [a for a in e.args if self._fixed(a)]
            # A sign is cheaper than a second constant.
            sign = sp.S.NegativeOne if e.is_Mul and sp.S.NegativeOne in fixed else None
            if sign is not None:
                fixed.remove(sign)
            lead = [self._constant(e.func(*fixed))] if fixed else []
            if e.is_Add:
                return _sum([*lead, *moving])
            factors = [*([sign] if sign is not None else []), *lead, *moving]
            return sp.Mul(*factors, evaluate=not self.by_recursion)
        if isinstance(e, sp.sin | sp.cos) and not self._has_turned(moving[0]):
            # One angle, however the sum was written.
            place = self.angles.setdefault(
                sp.Add(*moving[0].args) if moving[0].is_Add else moving[0], len(self.angles)
            )
            return _pair(place)[isinstance(e, sp.cos)]
        return e.func(*(self(a) for a in e.args))

    def _has_turned(self, e):
        return any(s.name.startswith(("s_", "c_")) for s in e.free_symbols)


def _fewest(expression, n):
    """C q̇ collected where that is shorter, as −h (2 q̇1 + q̇2) q̇2 in the 2R; slow for a large n."""
    if n > 3:
        return expression
    collected = sp.factor_terms(expression.expand())
    return min(expression, collected, key=sp.count_ops)


def _pair(place):
    return sp.symbols(f"s_{place} c_{place}")


def _angle_sums(angles):
    """Sines and cosines that must be computed, and those that follow from them as products.

    Where an angle is the sum of two others, as q1 + q2 beside q1 and q2, the addition formulas
    take six operations; a sine and a cosine take many more.
    """
    computed: dict = {}
    added = []
    for angle in sorted(angles, key=lambda a: (a.count_ops(), angles[a][0].name)):
        first = next((a for a in computed if angle - a in computed), None)
        if first is None:
            computed[angle] = angles[angle]
            continue
        (s, c), (sa, ca), (sb, cb) = angles[angle], computed[first], computed[angle - first]
        added += [(s, sa * cb + ca * sb), (c, ca * cb - sa * sb)]
    return [(pair, angle) for angle, pair in computed.items()], added


def _used(steps, readers):
    read = set().union(*(e.free_symbols for e in readers))
    return [(symbol, e) for symbol, e in steps if symbol in read]


def _sum(addends):
    # Kept as one node, as the derivation keeps it: flattened, sums would no longer share.
    addends = [a for a in addends if a != 0]
    return sp.Add(*addends, evaluate=False) if len(addends) > 1 else sum(addends, sp.S.Zero)
