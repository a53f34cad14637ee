"""All right numbers of a mechanism at once, for many states: M, its slopes, C, g and P."""

from collections.abc import Callable
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from autograder.mechanisms.outline import Outline
from autograder.mutation.derivatives import gradient, inertia
from autograder.mutation.formulas import formulas
from autograder.mutation.steps import Right

if TYPE_CHECKING:
    import sympy as sp

    from autograder.mechanisms import Mechanism

# No difference is formed, so no digits are lost.
STEP = 1e-30


@lru_cache(maxsize=64)
def whole(mechanism: Outline) -> Callable[..., Right]:
    """A function of q, q̇ (cases, n) and the arms, one a case."""
    numbers = formulas(mechanism, ("whole",), expressions, count(mechanism.n))

    def right(q, qd, arms) -> Right:
        return as_right(numbers(q, qd, arms), qd)

    return right


def expressions(mechanism: "Mechanism") -> "list[sp.Expr]":
    """M, its slopes, g and P, entry by entry."""
    M = inertia(mechanism.K, mechanism)
    slopes = [entry.diff(x) for entry in M for x in mechanism.q]
    return [*M, *slopes, *gradient(mechanism.P, mechanism), mechanism.P]


def count(n: int) -> int:
    """How many these are."""
    return n * n + n**3 + n + 1


def as_right(numbers: np.ndarray, qd: np.ndarray) -> Right:
    """The numbers of these expressions (expressions, cases) by their names."""
    n = np.shape(qd)[1]
    M, slopes, g, P = np.split(numbers.T, np.cumsum([n * n, n**3, n]), axis=-1)
    square = M.reshape(-1, n, n)
    return Right(square, slopes.reshape(-1, n, n, n), np.asarray(qd), g, P[:, 0])


def slopes(M: Callable[[np.ndarray], np.ndarray], q: np.ndarray) -> np.ndarray:
    """∂M_ij/∂q_k at q (cases, n), of all that M gives for it, (…, cases, n, n): (…, cases, n, n, n).

    By the complex step, Im M(q + i ε) / ε, exact for the analytic entries that energies give: J. N.
    Lyness, C. B. Moler (1967), Numerical Differentiation of Analytic Functions.
    """
    cases, n = q.shape
    steps = (q + 1j * STEP * np.eye(n)[:, np.newaxis]).reshape(n * cases, n)
    wrong = M(steps)
    apart = wrong.imag.reshape(*wrong.shape[:-3], n, cases, n, n) / STEP
    return np.moveaxis(apart, -4, -1)
