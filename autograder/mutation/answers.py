"""The answers that are asked for, and how each follows from the energies: M, C, g and P.

Each is linear in the energies. So an answer is the sum of what its terms contribute, and a wrong
term changes it by the difference of two contributions; nothing else has to be derived again.
"""

from collections.abc import Callable
from dataclasses import dataclass

import sympy as sp

from armdyn.derive import christoffel_symbols
from autograder.mechanisms import Mechanism


@dataclass(frozen=True)
class Answer:
    """What a student's function returns. shape(n): of the array. of_kinetic, of_potential: what a term
    of K or of P contributes to its entries, in a row; None where it contributes nothing.
    """

    name: str
    arguments: tuple[str, ...]
    unit: str
    shape: Callable[[int], tuple[int, ...]]
    of_kinetic: Callable[[sp.Expr, Mechanism], list[sp.Expr]] | None = None
    of_potential: Callable[[sp.Expr, Mechanism], list[sp.Expr]] | None = None

    @property
    def signature(self) -> str:
        return f"{self.name}({', '.join(self.arguments)})"


def inertia(term: sp.Expr, mechanism: Mechanism) -> list[sp.Expr]:
    """∂²K/∂q̇_i∂q̇_j, row by row."""
    return [term.diff(a).diff(b) for a in mechanism.qd for b in mechanism.qd]


def coriolis(term: sp.Expr, mechanism: Mechanism) -> list[sp.Expr]:
    """Σ_k h_ijk q̇_k of a kinetic energy, row by row."""
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


ANSWERS = {
    answer.name: answer
    for answer in (
        Answer("M", ("q", "arm"), "kg·m²", lambda n: (n, n), of_kinetic=inertia),
        Answer("C", ("q", "qd", "arm"), "kg·m²/s", lambda n: (n, n), of_kinetic=coriolis),
        Answer("g_vec", ("q", "arm"), "N·m", lambda n: (n,), of_potential=gradient),
        Answer(
            "potential_energy", ("q", "arm"), "J", lambda n: (), of_potential=lambda term, _: [term]
        ),
    )
}
