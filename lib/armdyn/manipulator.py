"""The base class: a model says M, C, g, f and P; dynamics, energy and state space follow from them.

The equation of motion, in the course's notation, is

    M(q) q̈ + C(q, q̇) q̇ + g(q) + f(q̇) = u.

Every method takes leading batch axes: arguments of shape (..., n) broadcast against each other, so
that one state and a million states are the same call.
"""

import reprlib
from abc import ABC, abstractmethod
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from armdyn.parameters import state_vector, state_vectors

# An eigenvalue of M below n times this, relative to the largest, is 0 but for rounding: the entries
# of M are sums of several products, each with its own.
ROUNDING = 8 * np.finfo(float).eps

# What a model says of its motion.
TERMS = frozenset({"M", "C", "g_vec", "f_vec", "bias"})


def own_term(model: "Manipulator", known: type, terms: Iterable[str]) -> str | None:
    """The first of `terms` that is another than the class `known` has: of a subclass, or set anew."""
    for term in terms:
        if term in vars(model) or getattr(type(model), term) is not getattr(known, term):
            return term
    return None


class Manipulator(ABC):
    """A robot with `n` generalised coordinates.

    A subclass gives `n`, `M`, `C`, `g_vec` and `potential_energy`, and `f_vec` where there is
    friction. Shapes below leave out the batch axes. All methods raise ValueError, naming the
    argument, for one that is not finite real numbers, whose last axis has not the size asked for,
    or whose batch axes do not broadcast with the others'.

    Source: R. M. Murray, Z. Li, S. S. Sastry (1994), A Mathematical Introduction to Robotic
    Manipulation, chapter 4, for the structure of the equation.
    """

    n: int

    @abstractmethod
    def M(self, q: ArrayLike) -> np.ndarray:
        """Joint-space inertia matrix, (n, n), kg·m²; q: (n,), rad."""

    @abstractmethod
    def C(self, q: ArrayLike, qd: ArrayLike) -> np.ndarray:
        """Coriolis and centrifugal matrix in Christoffel form, (n, n), kg·m²/s."""

    @abstractmethod
    def g_vec(self, q: ArrayLike) -> np.ndarray:
        """Gravity vector ∂P/∂q, (n,), N·m."""

    @abstractmethod
    def potential_energy(self, q: ArrayLike) -> np.ndarray:
        """Potential energy P, scalar, J."""

    def f_vec(self, qd: ArrayLike) -> np.ndarray:
        """Friction torque f(q̇), (n,), N·m; zero unless the model has friction."""
        return np.zeros_like(state_vector("qd", qd, self.n))

    def christoffel_symbols(self, q: ArrayLike) -> np.ndarray:
        """h_ijk = ½ (∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i), (n, n, n), kg·m²: C_ij = Σ_k h_ijk q̇_k.

        C is linear in q̇, so that its value at the k-th unit velocity is h_ijk, without a derivative.
        """
        q = state_vector("q", q, self.n)
        return np.moveaxis(self.C(q[..., np.newaxis, :], np.eye(self.n)), -3, -1)

    def inverse_dynamics(self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike) -> np.ndarray:
        """Input u = M q̈ + C q̇ + g + f that gives the acceleration qdd, (n,), N·m."""
        q, qd, qdd = state_vectors(self.n, q=q, qd=qd, qdd=qdd)
        return np.matvec(self.M(q), qdd) + self.bias(q, qd)

    def bias(self, q: ArrayLike, qd: ArrayLike) -> np.ndarray:
        """C q̇ + g + f, the input that keeps q̈ = 0, (n,), N·m."""
        q, qd = state_vectors(self.n, q=q, qd=qd)
        return np.matvec(self.C(q, qd), qd) + self.g_vec(q) + self.f_vec(qd)

    def dynamics(self, q: ArrayLike, qd: ArrayLike, u: ArrayLike) -> np.ndarray:
        """Acceleration q̈ = M⁻¹ (u − C q̇ − g − f), (n,), rad/s².

        Raises numpy.linalg.LinAlgError, saying where, if M(q) is singular to rounding: its smallest
        eigenvalue is below n·1.8e-15 of the largest. The model then has a motion that carries no
        kinetic energy, and its acceleration is not determined.
        """
        q, qd, u = state_vectors(self.n, q=q, qd=qd, u=u)
        M = self.M(q)
        _refuse_singular(M, q)
        return np.linalg.solve(M, (u - self.bias(q, qd))[..., np.newaxis])[..., 0]

    def kinetic_energy(self, q: ArrayLike, qd: ArrayLike) -> np.ndarray:
        """K = ½ q̇ᵀ M q̇, scalar, J."""
        q, qd = state_vectors(self.n, q=q, qd=qd)
        return 0.5 * np.vecdot(qd, np.matvec(self.M(q), qd))

    def energy(self, q: ArrayLike, qd: ArrayLike) -> np.ndarray:
        """Total energy E = K + P, scalar, J."""
        return self.kinetic_energy(q, qd) + self.potential_energy(q)

    def state_derivative(self, x: ArrayLike, u: ArrayLike) -> np.ndarray:
        """ẋ of the state x = [q; q̇], shape (2n,), in rad/s and rad/s².

        x: (2n,), the coordinates first, then the velocities. u: (n,), N·m.
        Raises numpy.linalg.LinAlgError where M(q) is singular, as `dynamics` does.
        """
        x = state_vector("x", x, 2 * self.n)
        q, qd = x[..., : self.n], x[..., self.n :]
        qdd = self.dynamics(q, qd, u)
        return np.concatenate([np.broadcast_to(qd, qdd.shape), qdd], axis=-1)


def model_given(name: str, value: Any) -> Manipulator:
    """The value; ValueError, naming the argument, if it is no model (a Derivation is none yet)."""
    if isinstance(value, Manipulator) or callable(getattr(value, "M", None)):
        return value
    raise ValueError(
        f"{name} = {reprlib.repr(value)}: needs a model, such as a Planar2R, a SerialChain, or "
        "codegen.numpy_model(derivation, values)"
    )


def _refuse_singular(M, q) -> None:
    n = M.shape[-1]
    size = np.sqrt(np.einsum("...ij,...ij", M, M))[..., np.newaxis, np.newaxis]
    # |det| ≤ smallest eigenvalue · largestⁿ⁻¹, and det is cheaper than eigenvalues: it clears
    # nearly every state, whose eigenvalues then need no look.
    suspect = np.abs(np.linalg.det(M / np.where(size > 0, size, 1))) <= 2 * n * ROUNDING
    if not np.any(suspect):
        return
    values, vectors = np.linalg.eigh(M[suspect])
    sizes = np.abs(values)
    singular = np.flatnonzero(sizes.min(axis=-1) <= n * ROUNDING * sizes.max(axis=-1))
    if len(singular):
        k = singular[0]
        at = tuple(int(i) for i in np.argwhere(suspect)[k])
        index = f" (state {', '.join(map(str, at))} of the batch)" if at else ""
        idle = vectors[k][:, np.argmin(sizes[k])]
        raise np.linalg.LinAlgError(
            f"M(q) is singular at q = {q[at]}{index}: a velocity along {idle} carries no kinetic "
            "energy, so q̈ is not determined"
        )
