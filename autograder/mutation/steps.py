"""What people do wrong on the way from the terms to the answer: with derivatives, indices and order.

Each step is a function of the mechanism's right numbers: M (…, n, n), its slopes ∂M_ij/∂q_k
(…, n, n, n), q̇, g and P. It gives what the answer then is.
"""

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np


@dataclass(frozen=True)
class Right:
    """The right numbers of a mechanism in some cases; leading axes run over the cases."""

    M: np.ndarray
    slopes: np.ndarray
    qd: np.ndarray
    g_vec: np.ndarray
    P: np.ndarray

    @cached_property
    def C(self) -> np.ndarray:
        return np.einsum("...ijk,...k->...ij", self.christoffel(), self.qd)

    def named(self) -> dict[str, np.ndarray]:
        """All of them by their names."""
        return {own.name: getattr(self, own.name) for own in fields(self)}

    @property
    def M_dot(self) -> np.ndarray:
        return np.einsum("...ijk,...k->...ij", self.slopes, self.qd)

    @property
    def K(self) -> np.ndarray:
        return np.einsum("...i,...ij,...j->...", self.qd, self.M, self.qd) / 2

    @property
    def K_of_single_velocities(self) -> np.ndarray:
        """K with q̇_i where its square belongs."""
        single = self.qd - self.qd**2
        return self.K + np.einsum("...ii,...i->...", self.M, single) / 2

    @property
    def K_of_squares(self) -> np.ndarray:
        """Half the sum of M times the squares of the velocities."""
        return np.einsum("...ij,...j->...", self.M, self.qd**2) / 2

    @property
    def momentum(self) -> np.ndarray:
        """The sum of the entries of M q̇."""
        return np.einsum("...ij,...j->...", self.M, self.qd)

    def christoffel(self, first=0.5, second=0.5, third=0.5) -> np.ndarray:
        """h_ijk with these weights on ∂M_ij/∂q_k, ∂M_ik/∂q_j and −∂M_jk/∂q_i."""
        D = self.slopes
        return first * D + second * np.swapaxes(D, -1, -2) - third * np.moveaxis(D, -1, -3)


@dataclass(frozen=True)
class Driven(Right):
    """What also makes a motion: q, the input u and the friction, (…, n) each."""

    q: np.ndarray
    u: np.ndarray
    friction: np.ndarray

    @cached_property
    def torques(self) -> dict[str, np.ndarray]:
        """What adds up to M q̈, by name."""
        return {
            "the input u": self.u,
            "C q̇": -times(self.C, self.qd),
            "g(q)": -self.g_vec,
            "the friction": -self.friction,
        }

    @cached_property
    def rest(self) -> np.ndarray:
        """u − C q̇ − g − f."""
        return sum(self.torques.values(), np.zeros_like(self.u))

    def left_side(self, factor: float) -> np.ndarray:
        """q̈ with C q̇ + g + f times this factor beside u."""
        return solved(self.M, self.u + factor * (self.u - self.rest))

    @property
    def acceleration(self) -> np.ndarray:
        return solved(self.M, self.rest)


@dataclass(frozen=True)
class Run(Right):
    """The numbers along motions: the rows are the last of the leading axes. q: (…, rows, n)."""

    q: np.ndarray

    @property
    def E(self) -> np.ndarray:
        return self.K + self.P


def drift(energy: np.ndarray) -> np.ndarray:
    """What an energy has gained since the first row, (…, rows)."""
    return energy - energy[..., :1]


# Of any answer; those of f take what drives the motion, those of energy_drift a motion.
Step = Callable[..., np.ndarray]


def _weighted(**weights) -> Step:
    return lambda right: np.einsum("...ijk,...k->...ij", right.christoffel(**weights), right.qd)


def _transposed(array: np.ndarray) -> np.ndarray:
    return np.swapaxes(array, -1, -2)


def _diagonal(vector: np.ndarray) -> np.ndarray:
    """A vector in the place of a matrix; read so where a check asks for C."""
    return vector[..., np.newaxis] * np.eye(vector.shape[-1])


def times(matrix: np.ndarray, vector: np.ndarray) -> np.ndarray:
    return np.einsum("...ij,...j->...i", matrix, vector)


def _in_one_column(later: bool) -> Step:
    """Each product q̇_j q̇_k of C q̇ whole in the column of one of its two velocities."""

    def step(right: Right) -> np.ndarray:
        n = right.M.shape[-1]
        apart = 2 * (np.tril(np.ones((n, n)), -1) if later else np.triu(np.ones((n, n)), 1))
        shared = right.christoffel() * (apart + np.eye(n))
        return np.einsum("...ijk,...k->...ij", shared, right.qd)

    return step


def _terms_of_sum(chosen: slice) -> Step:
    """These terms alone of the sum over k."""
    return lambda right: np.einsum(
        "...ijk,...k->...ij", right.christoffel()[..., chosen], right.qd[..., chosen]
    )


def _never_begun_anew(right: Right) -> np.ndarray:
    """Each entry with all entries before it, row by row."""
    entries = np.reshape(right.C, (*right.C.shape[:-2], -1))
    return np.reshape(np.cumsum(entries, axis=-1), right.C.shape)


# With less, a wrong M is singular but for rounding.
LEAST_VOLUME = 1e-9


def solved(M: np.ndarray, rest: np.ndarray) -> np.ndarray:
    """M⁻¹ times vectors, (…, n); not a number where a wrong M has no inverse."""
    good = _invertible(M)
    some = np.where(good[..., np.newaxis], M, np.eye(M.shape[-1]))
    if M.ndim == 3 and rest.ndim == 3:  # many vectors for each M, which is then taken apart once
        found = np.moveaxis(np.linalg.solve(some, np.moveaxis(rest, 0, -1)), -1, 0)
    else:
        found = np.linalg.solve(some, rest[..., np.newaxis])[..., 0]
    return np.where(good, found, np.nan)


def _inverse(M: np.ndarray) -> np.ndarray:
    good = _invertible(M)[..., np.newaxis]
    return np.where(good, np.linalg.inv(np.where(good, M, np.eye(M.shape[-1]))), np.nan)


def _invertible(M: np.ndarray) -> np.ndarray:
    """Whether rows do not all but lie in fewer dimensions: their volume beside that of a box, (…, 1)."""
    volume = np.abs(np.linalg.det(M))
    box = np.prod(np.linalg.norm(M, axis=-1), axis=-1)
    return (np.isfinite(volume) & (volume > LEAST_VOLUME * box))[..., np.newaxis]


def rate(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """ẋ of its two halves, (…, 2n)."""
    return np.concatenate(np.broadcast_arrays(first, second), axis=-1)


def _accelerating(acceleration: Callable[[Driven], np.ndarray]) -> Step:
    return lambda driven: rate(driven.qd, acceleration(driven))


STEPS: dict[str, dict[str, Step]] = {
    "M": {
        "half of the whole": lambda right: right.M / 2,
        "twice the whole": lambda right: 2 * right.M,
        "sign of the whole": lambda right: -right.M,
        "inverse": lambda right: _inverse(right.M),
        "diagonal alone": lambda right: right.M * np.eye(right.M.shape[-1]),
        "upper triangle alone": lambda right: np.triu(right.M),
        "lower triangle alone": lambda right: np.tril(right.M),
        "sign below the diagonal": lambda right: np.triu(right.M) - np.tril(right.M, -1),
        "mixed terms not shared": lambda right: 2 * right.M - right.M * np.eye(right.M.shape[-1]),
        "mixed terms in one triangle": lambda right: np.triu(right.M) + np.triu(right.M, 1),
        "joints exchanged": lambda right: right.M[..., ::-1, ::-1],
    },
    "M_dot": {
        "sign of the whole": lambda right: -right.M_dot,
        "half of the whole": lambda right: right.M_dot / 2,
        "twice the whole": lambda right: 2 * right.M_dot,
        "velocities exchanged": lambda right: np.einsum(
            "...ijk,...k->...ij", right.slopes, right.qd[..., ::-1]
        ),
        "sum of the velocities": lambda right: (
            np.sum(right.slopes, axis=-1) * np.sum(right.qd, axis=-1)[..., None, None]
        ),
        "velocities squared": lambda right: np.einsum(
            "...ijk,...k->...ij", right.slopes, right.qd**2
        ),
        "chain rule forgotten": lambda right: np.sum(right.slopes, axis=-1),
        "zero": lambda right: np.zeros_like(right.M),
        "C": lambda right: right.C,
        "twice C": lambda right: 2 * right.C,
        "M": lambda right: right.M,
        "constants differentiated": lambda right: right.M * right.qd[..., -1, None, None],
        "product with the velocities": lambda right: right.M * right.qd[..., None, :],
        "diagonal alone": lambda right: right.M_dot * np.eye(right.M.shape[-1]),
        "upper triangle alone": lambda right: np.triu(right.M_dot),
    },
    "C": {
        "sign of the whole": lambda right: -right.C,
        "half of the whole": lambda right: right.C / 2,
        "twice the whole": lambda right: 2 * right.C,
        "transposed": lambda right: _transposed(right.C),
        "rate of M": lambda right: right.M_dot,
        "half the rate of M": lambda right: right.M_dot / 2,
        "rate of M less 2C": lambda right: right.M_dot - 2 * right.C,
        "M": lambda right: right.M,
        "zero": lambda right: np.zeros_like(right.C),
        "torque for C": lambda right: _diagonal(times(right.C, right.qd)),
        "C times ones": lambda right: _diagonal(np.sum(right.C, axis=-1)),
        "last derivative missing": _weighted(third=0),
        "sign of the last derivative": _weighted(third=-0.5),
        "last derivative not halved": _weighted(third=1),
        "second derivative missing": _weighted(second=0),
        "first derivative missing": _weighted(first=0),
        "not symmetrised": _weighted(first=1, second=0),
        "second derivative twice": _weighted(first=0, second=1),
        "first derivative alone halved": _weighted(second=1, third=1),
        "second derivative alone halved": _weighted(first=1, third=1),
        "last derivative alone halved": _weighted(first=1, second=1),
        "last term alone": _terms_of_sum(slice(-1, None)),
        "first term alone": _terms_of_sum(slice(1)),
        "last term left out": _terms_of_sum(slice(-1)),
        "first term left out": _terms_of_sum(slice(1, None)),
        "sum never begun anew": _never_begun_anew,
        "upper triangle mirrored": lambda right: (
            np.triu(right.C) + _transposed(np.triu(right.C, 1))
        ),
        "products in the later column": _in_one_column(later=True),
        "products in the earlier column": _in_one_column(later=False),
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
        "velocities exchanged": lambda right: np.einsum(
            "...ijk,...k->...ij", right.christoffel(), right.qd[..., ::-1]
        ),
        "velocities squared": lambda right: np.einsum(
            "...ijk,...k->...ij", right.christoffel(), right.qd**2
        ),
        "products of velocities": lambda right: right.C * right.qd[..., np.newaxis, :],
        "products with the row": lambda right: right.C * right.qd[..., :, np.newaxis],
        "2C less the rate of M": lambda right: 2 * right.C - right.M_dot,
        "second kind": lambda right: _inverse(right.M) @ right.C,
        "gravity for C": lambda right: _diagonal(right.g_vec),
        "momentum for C": lambda right: _diagonal(times(right.M, right.qd)),
    },
    "g_vec": {
        "sign of the whole": lambda right: -right.g_vec,
        "half of the whole": lambda right: right.g_vec / 2,
        "twice the whole": lambda right: 2 * right.g_vec,
        "joints exchanged": lambda right: right.g_vec[..., ::-1],
        "zero": lambda right: np.zeros_like(right.g_vec),
        "energy for its derivative": lambda right: np.broadcast_to(
            right.P[..., np.newaxis], right.g_vec.shape
        ),
        "divided by M": lambda right: solved(right.M, right.g_vec),
    },
    "potential_energy": {
        "sign of the whole": lambda right: -right.P,
        "half of the whole": lambda right: right.P / 2,
        "twice the whole": lambda right: 2 * right.P,
    },
    "lagrangian": {
        "energy for L": lambda right: right.K + right.P,
        "sign of the whole": lambda right: right.P - right.K,
        "half of the whole": lambda right: (right.K - right.P) / 2,
        "twice the whole": lambda right: 2 * (right.K - right.P),
        "½ of K missing": lambda right: 2 * right.K - right.P,
        "½ of K twice": lambda right: right.K / 2 - right.P,
        "K missing": lambda right: -right.P,
        "P missing": lambda right: right.K,
        "diagonal of M alone": lambda right: (
            np.einsum("...ii,...i->...", right.M, right.qd**2) / 2 - right.P
        ),
        "velocities of K not squared": lambda right: right.K_of_single_velocities - right.P,
        "M times squares": lambda right: right.K_of_squares - right.P,
        "M left out of K": lambda right: np.sum(right.qd**2, axis=-1) / 2 - right.P,
        "momentum for K": lambda right: right.momentum / 2 - right.P,
    },
    "energy_drift": {
        "sign of the whole": lambda run: -drift(run.E),
        "half of the whole": lambda run: drift(run.E) / 2,
        "twice the whole": lambda run: 2 * drift(run.E),
        "½ of K missing": lambda run: drift(2 * run.K + run.P),
        "½ of K twice": lambda run: drift(run.K / 2 + run.P),
        "K missing": lambda run: drift(run.P),
        "P missing": lambda run: drift(run.K),
        "L for the energy": lambda run: drift(run.K - run.P),
        "diagonal of M alone": lambda run: drift(
            np.einsum("...ii,...i->...", run.M, run.qd**2) / 2 + run.P
        ),
        "velocities of K not squared": lambda run: drift(run.K_of_single_velocities + run.P),
        "M times squares": lambda run: drift(run.K_of_squares + run.P),
        "M of the start": lambda run: drift(replace(run, M=run.M[..., :1, :, :]).K + run.P),
        "C in the energy": lambda run: drift(run.E + replace(run, M=run.C).K),
        "C for M": lambda run: drift(replace(run, M=run.C).K + run.P),
        "torque times coordinate": lambda run: drift(
            run.K + np.einsum("...i,...i->...", run.g_vec, run.q)
        ),
        "from the row before": lambda run: np.diff(run.E, axis=-1, prepend=run.E[..., :1]),
        "size of the drift": lambda run: np.abs(drift(run.E)),
        "energy for its drift": lambda run: run.E,
        "from the mean": lambda run: run.E - np.mean(run.E, axis=-1, keepdims=True),
        "from the end": lambda run: run.E - run.E[..., -1:],
        "share for the drift": lambda run: drift(run.E) / run.E[..., :1],
        "share in percent": lambda run: 100 * drift(run.E) / run.E[..., :1],
        "size of the share": lambda run: np.abs(drift(run.E) / run.E[..., :1]),
        "ratio for the drift": lambda run: run.E / run.E[..., :1],
        "range for the drift": lambda run: np.ptp(run.E, axis=-1, keepdims=True) + 0 * run.E,
        "difference of sizes": lambda run: drift(np.abs(run.E)),
        "slope for the drift": lambda run: np.gradient(run.E, axis=-1),
        "M left out of K": lambda run: drift(np.sum(run.qd**2, axis=-1) / 2 + run.P),
        "momentum for K": lambda run: drift(run.momentum / 2 + run.P),
    },
    "f": {
        "sign of the whole": _accelerating(lambda driven: -driven.acceleration),
        "half of the whole": _accelerating(lambda driven: driven.acceleration / 2),
        "twice the whole": _accelerating(lambda driven: 2 * driven.acceleration),
        "state for its rate": lambda driven: rate(driven.q, driven.qd),
        "velocity for acceleration": _accelerating(lambda driven: driven.qd),
        "signs of the left side": _accelerating(lambda driven: driven.left_side(1)),
        "left side missing": _accelerating(lambda driven: driven.left_side(0)),
        "halves of ẋ swapped": lambda driven: rate(driven.acceleration, driven.qd),
        "q for its rate": lambda driven: rate(driven.q, driven.acceleration),
        "M not inverted": _accelerating(lambda driven: times(driven.M, driven.rest)),
        "torque for acceleration": _accelerating(lambda driven: driven.rest),
        "divided by the diagonal of M": _accelerating(
            lambda driven: driven.rest / np.einsum("...ii->...i", driven.M)
        ),
        "entries of M inverted": _accelerating(lambda driven: times(1 / driven.M, driven.rest)),
        "divided by M entry by entry": _accelerating(
            lambda driven: np.sum(driven.rest[..., np.newaxis, :] / driven.M, axis=-2)
        ),
        "C times ones in the torque": _accelerating(
            lambda driven: solved(driven.M, driven.rest + times(driven.C, driven.qd - 1))
        ),
    },
}
