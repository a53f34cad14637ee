"""Holds the result of a derivation: the terms of M q̈ + C q̇ + g = u as SymPy expressions."""

import re
from dataclasses import dataclass

import sympy as sp


@dataclass(frozen=True)
class Derivation:
    """The equation of motion M(q) q̈ + C(q, q̇) q̇ + g(q) = u in symbols.

    q, qd: the coordinates and velocities, n symbols each. parameters: all other symbols, those too
    that dropped out on the way (the length of the last link). M, C: (n, n), C in Christoffel form.
    g_vec: (n, 1), the gradient of P. Units are whatever the parameters bring.

    Nothing is simplified: the expressions keep the structure in which subexpressions are shared,
    so that `sympy.cse` finds them. Where sums are nested to that end, `.doit()` flattens them.
    """

    q: tuple[sp.Symbol, ...]
    qd: tuple[sp.Symbol, ...]
    parameters: tuple[sp.Symbol, ...]
    M: sp.ImmutableMatrix
    C: sp.ImmutableMatrix
    g_vec: sp.ImmutableMatrix
    P: sp.Expr

    @property
    def n(self) -> int:
        """The number of coordinates."""
        return len(self.q)

    def christoffel(self) -> sp.ImmutableDenseNDimArray:
        """h[i, j, k], (n, n, n), the Christoffel symbols of the first kind of M."""
        return christoffel_symbols(self.M, self.q)

    def equations(self, qdd, u) -> tuple[sp.Eq, ...]:
        """The n equations of motion (M q̈ + C q̇ + g)_i = u_i.

        qdd, u: n symbols or expressions each. Raises ValueError for another number of them.
        """
        qdd, u = (_listed(name, value, self.n) for name, value in (("qdd", qdd), ("u", u)))
        left = self.M * sp.Matrix(qdd) + self.C * sp.Matrix(self.qd) + self.g_vec
        return tuple(sp.Eq(a, b, evaluate=False) for a, b in zip(left, u, strict=True))


def christoffel_symbols(M, q) -> sp.ImmutableDenseNDimArray:
    """h_ijk = ½ (∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i), (n, n, n): the first index is the free one.

    M: symmetric SymPy matrix, (n, n), whose upper triangle is read. q: n symbols.
    Source: R. M. Murray, Z. Li, S. S. Sastry (1994), A Mathematical Introduction to Robotic
    Manipulation, chapter 4.
    """
    n = len(q)
    upper = {(i, j): [M[i, j].diff(x) for x in q] for i in range(n) for j in range(i, n)}

    def slope(i, j, k):
        return upper[min(i, j), max(i, j)][k]

    def symbol(i, j, k):
        return (slope(i, j, k) + slope(i, k, j) - slope(j, k, i)) / 2

    h = [[[symbol(i, j, k) for k in range(n)] for j in range(n)] for i in range(n)]
    return sp.ImmutableDenseNDimArray(h, (n, n, n))


def from_inertia(M, P, q, qd, parameters) -> Derivation:
    """The derivation of K = ½ q̇ᵀ M q̇ and P: C_ij = Σ_k h_ijk q̇_k and g = ∂P/∂q."""
    n = len(q)
    h = christoffel_symbols(M, q)
    C = sp.ImmutableMatrix(n, n, lambda i, j: sum(h[i, j, k] * qd[k] for k in range(n)))
    gradient = sp.ImmutableMatrix(n, 1, [P.diff(x) for x in q])
    return Derivation(tuple(q), tuple(qd), tuple(parameters), sp.ImmutableMatrix(M), C, gradient, P)


def parameters_of(expressions, q, qd) -> tuple[sp.Symbol, ...]:
    """The symbols that are neither coordinates nor velocities, by name, m2 before m10."""
    found = set().union(*(e.free_symbols for e in expressions)) - set(q) - set(qd)
    return tuple(sorted(found, key=_by_name))


def _by_name(symbol):
    parts = re.split(r"(\d+)", symbol.name)
    return [(int(p), "") if p.isdigit() else (-1, p) for p in parts]


def _listed(name, value, n):
    listed = list(value)
    if len(listed) != n:
        raise ValueError(f"{name}: got {len(listed)} entries, needs {n}, one per coordinate")
    return [sp.sympify(entry) for entry in listed]
