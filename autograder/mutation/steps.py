"""What people do wrong on the way from the terms to the answer: with derivatives, indices and order.

Each step is a function of the mechanism's right numbers: M (…, n, n), its slopes ∂M_ij/∂q_k
(…, n, n, n), q̇, C, g and P. It gives what the answer then is.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Right:
    """The right numbers of a mechanism in some cases; leading axes run over the cases."""

    M: np.ndarray
    slopes: np.ndarray
    qd: np.ndarray
    C: np.ndarray
    g_vec: np.ndarray
    P: np.ndarray

    @property
    def M_dot(self) -> np.ndarray:
        return np.einsum("...ijk,...k->...ij", self.slopes, self.qd)

    def christoffel(self, first=0.5, second=0.5, third=0.5) -> np.ndarray:
        """h_ijk with these weights on ∂M_ij/∂q_k, ∂M_ik/∂q_j and −∂M_jk/∂q_i."""
        D = self.slopes
        return first * D + second * np.swapaxes(D, -1, -2) - third * np.moveaxis(D, -1, -3)


Step = Callable[[Right], np.ndarray]


def _weighted(**weights) -> Step:
    return lambda right: np.einsum("...ijk,...k->...ij", right.christoffel(**weights), right.qd)


def _transposed(array: np.ndarray) -> np.ndarray:
    return np.swapaxes(array, -1, -2)


STEPS: dict[str, dict[str, Step]] = {
    "M": {
        "half of the whole": lambda right: right.M / 2,
        "twice the whole": lambda right: 2 * right.M,
        "sign of the whole": lambda right: -right.M,
        "inverse": lambda right: np.linalg.inv(right.M),
        "diagonal alone": lambda right: right.M * np.eye(right.M.shape[-1]),
        "upper triangle alone": lambda right: np.triu(right.M),
    },
    "C": {
        "sign of the whole": lambda right: -right.C,
        "twice the whole": lambda right: 2 * right.C,
        "transposed": lambda right: _transposed(right.C),
        "rate of M": lambda right: right.M_dot,
        "half the rate of M": lambda right: right.M_dot / 2,
        "rate of M less 2C": lambda right: right.M_dot - 2 * right.C,
        "M": lambda right: right.M,
        "zero": lambda right: np.zeros_like(right.C),
        "last derivative missing": _weighted(third=0),
        "sign of the last derivative": _weighted(third=-0.5),
        "last derivative not halved": _weighted(third=1),
        "second derivative missing": _weighted(second=0),
        "first derivative missing": _weighted(first=0),
        "not symmetrised": _weighted(first=1, second=0),
        "summed over the first index": lambda right: np.einsum(
            "...kij,...k->...ij", right.christoffel(), right.qd
        ),
        "no velocity": lambda right: np.sum(right.christoffel(), axis=-1),
        "velocity of the column": lambda right: (
            np.sum(right.christoffel(), axis=-1) * right.qd[..., np.newaxis, :]
        ),
        "velocity of the row": lambda right: (
            np.sum(right.christoffel(), axis=-1) * right.qd[..., :, np.newaxis]
        ),
    },
    "g_vec": {
        "sign of the whole": lambda right: -right.g_vec,
        "half of the whole": lambda right: right.g_vec / 2,
        "twice the whole": lambda right: 2 * right.g_vec,
        "joints exchanged": lambda right: right.g_vec[..., ::-1],
        "zero": lambda right: np.zeros_like(right.g_vec),
    },
    "potential_energy": {
        "sign of the whole": lambda right: -right.P,
        "half of the whole": lambda right: right.P / 2,
        "twice the whole": lambda right: 2 * right.P,
    },
}
