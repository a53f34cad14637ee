"""The derivatives of the energies that answers are made of, entry by entry.

SymPy is imported where they are made: most often their numbers are kept.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import sympy as sp

    from autograder.mechanisms import Mechanism


def inertia(term: sp.Expr, mechanism: Mechanism) -> list[sp.Expr]:
    """∂²K/∂q̇_i∂q̇_j, row by row."""
    return [term.diff(a).diff(b) for a in mechanism.qd for b in mechanism.qd]


def inertia_rate(term: sp.Expr, mechanism: Mechanism) -> list[sp.Expr]:
    """Σ_k ∂M_ij/∂q_k q̇_k of a kinetic energy, row by row."""
    import sympy as sp

    rates = list(zip(mechanism.q, mechanism.qd, strict=True))
    return [sp.Add(*(entry.diff(x) * xd for x, xd in rates)) for entry in inertia(term, mechanism)]


def coriolis(term: sp.Expr, mechanism: Mechanism) -> list[sp.Expr]:
    """Σ_k h_ijk q̇_k of a kinetic energy, row by row."""
    import sympy as sp

    from armdyn.derive import christoffel_symbols

    n = mechanism.n
    M = sp.Matrix(n, n, inertia(term, mechanism))
    h = christoffel_symbols(M, mechanism.q)
    return [
        sum((h[i, j, k] * mechanism.qd[k] for k in range(n)), sp.S.Zero)
        for i in range(n)
        for j in range(n)
    ]


def gradient(term: sp.Expr, mechanism: Mechanism) -> list[sp.Expr]:
    """∂P/∂q."""
    return [term.diff(x) for x in mechanism.q]


def energy(term: sp.Expr, mechanism: Mechanism) -> list[sp.Expr]:
    """The energy itself."""
    return [term]
