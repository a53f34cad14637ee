"""Turns a derivation into straight-line code: constants once per arm, angles, then numbered steps."""

from dataclasses import dataclass, field

import sympy as sp
from sympy.core.function import AppliedUndef

from armdyn.derive import Derivation


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
    steps, outputs = _shared([lifted(e) for e in expressions], "x_")
    return lifted.finish(steps, outputs)


def forward_dynamics(derivation: Derivation) -> StraightLine:
    """Code that computes q̈ from q, q̇, u: n outputs, then the smallest pivot and the trace of M.

    M = L D Lᵀ written out, without square roots and without pivoting, which a symmetric positive
    definite M does not need (G. H. Golub, C. F. Van Loan (1996), Matrix Computations, chapter 4).
    A pivot of D that is tiny beside the trace tells of an M close to singular.
    """
    n = derivation.n
    lifted = _Lifting(derivation)
    lower = [(i, j) for i in range(n) for j in range(i + 1)]
    velocity = [lifted(v) for v in derivation.qd]
    torques = []
    for i in range(n):
        products = [lifted(derivation.C[i, j]) * velocity[j] for j in range(n)]
        bias = [
            _fewest(_sum(products), n),
            lifted(derivation.g_vec[i]),
            lifted(derivation.f_vec[i]),
        ]
        torques.append(_sum([sp.Symbol(f"u_{i}"), *(-b for b in bias)]))
    entries = [lifted(derivation.M[i, j]) for i, j in lower]
    steps, found = _shared([*entries, *torques], "x_")
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
    for j in range(n):
        pivots.append(keep(f"D_{j}", M[j, j] - _sum([L[j, k] * W[j, k] for k in range(j)])))
        # The last is divided by once only.
        inverse.append(keep(f"i_{j}", 1 / pivots[j]) if j < n - 1 else 1 / pivots[j])
        for i in range(j + 1, n):
            W[i, j] = keep(f"W_{i}_{j}", M[i, j] - _sum([L[i, k] * W[j, k] for k in range(j)]))
            L[i, j] = keep(f"L_{i}_{j}", W[i, j] * inverse[j])
    for i in range(n):
        rest[i] = keep(f"y_{i}", rest[i] - _sum([L[i, j] * rest[j] for j in range(i)]))
    solution = [None] * n
    for i in reversed(range(n)):
        later = _sum([L[j, i] * solution[j] for j in range(i + 1, n)])
        solution[i] = keep(f"a_{i}", rest[i] * inverse[i] - later)
    trace = _sum([M[i, i] for i in range(n)])
    return lifted.finish(steps, [*solution, sp.Min(*pivots, evaluate=False), trace])


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
        self.state = set(self.known)

    def __call__(self, expression):
        """The expression in fresh symbols."""
        return self._constant(expression) if self._fixed(expression) else self._walk(expression)

    def finish(self, steps, outputs):
        """The program of these steps, with the constants and angles met on the way."""
        pairs, added = _angle_sums({angle: _pair(i) for angle, i in self.angles.items()})
        steps = [*_used(added, [*(e for _, e in steps), *outputs]), *steps]
        angle_steps, arguments = _shared([angle for _, angle in pairs], "t_")
        angles = [(*pair, angle) for (pair, _), angle in zip(pairs, arguments, strict=True)]
        return StraightLine(
            tuple(self.constants), tuple(angle_steps), tuple(angles), tuple(steps), tuple(outputs)
        )

    def _fixed(self, e):
        return not (e.free_symbols & self.state)

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
            return sp.Mul(*([sign] if sign is not None else []), *lead, *moving)
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


def _shared(expressions, name):
    """(steps, expressions) with common subexpressions as steps."""
    symbols = sp.numbered_symbols(name, cls=sp.Symbol)
    steps, reduced = sp.cse(expressions, symbols=symbols, order="none")
    return list(steps), list(reduced)


def _sum(addends):
    # Kept as one node, as the derivation keeps it: flattened, sums would no longer share.
    addends = [a for a in addends if a != 0]
    return sp.Add(*addends, evaluate=False) if len(addends) > 1 else sum(addends, sp.S.Zero)
