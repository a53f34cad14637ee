"""Linearises the equation of motion: how u and q̈ change with q, q̇, q̈ and u, and ẋ ≈ A δx + B δu.

Of u = M q̈ + C q̇ + g + f, the slopes in q̇ and q̈ are exact: C is linear in q̇, so that
∂u/∂q̇_k = C(q, q̇) e_k + C(q, e_k) q̇ + ∂f/∂q̇_k, and ∂u/∂q̈ = M. The slope in q is exact for the
models of `armdyn.codegen` with up to four coordinates. For others it is by central differences of order
8, with an error of about 1e-13 of the largest term (more where u changes much over 0.06 rad or m).
`Derivation.inverse_dynamics_slopes` gives the slopes in symbols.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from armdyn.manipulator import Manipulator, model_given
from armdyn.parameters import state_vector, state_vectors

# Order 8: truncation h⁸ and rounding EPS/h balance near here.
STEP = 0.015
WEIGHTS = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
NARROW = 1e-6  # rad/s or m/s, for the friction of a joint at rest


@dataclass(frozen=True, eq=False)
class InverseSlopes:
    """Of the torque u that gives q̈: ∂u/∂q, ∂u/∂q̇ and ∂u/∂q̈ = M, (..., n, n) each."""

    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray


@dataclass(frozen=True, eq=False)
class ForwardSlopes:
    """Of the acceleration q̈ that u gives: ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂u = M⁻¹, (..., n, n) each."""

    q: np.ndarray
    qd: np.ndarray
    u: np.ndarray


@dataclass(frozen=True, eq=False)
class Linearisation:
    """ẋ ≈ ẋ₀ + A δx + B δu about a state and an input: A (..., 2n, 2n), B (..., 2n, n).

    x_dot: ẋ₀, (..., 2n), which is 0 at an equilibrium.
    """

    A: np.ndarray
    B: np.ndarray
    x_dot: np.ndarray


def inverse_dynamics_slopes(
    model: Manipulator, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike
) -> InverseSlopes:
    """∂u/∂q, ∂u/∂q̇, ∂u/∂q̈ of u = M q̈ + C q̇ + g + f; entry (i, k) is by how much u_i changes with q_k.

    q, qd, qdd: (..., n). Raises ValueError as the model does, and, naming the joint, where friction
    jumps: Coulomb friction at rest has no slope.

    Source: J. Carpentier, N. Mansard (2018), Analytical Derivatives of Rigid Body Dynamics
    Algorithms, Robotics: Science and Systems, for what is asked for.
    """
    q, qd, qdd = np.broadcast_arrays(
        *state_vectors(model_given("model", model).n, q=q, qd=qd, qdd=qdd)
    )
    M = model.M(q)
    h = model.christoffel_symbols(q)
    by_velocity = model.C(q, qd) + np.einsum("...ijk,...j->...ik", h, qd)

    def torque(q):
        held = np.matvec(model.M(q), _each(qdd)) + np.matvec(model.C(q, _each(qd)), _each(qd))
        return held + model.g_vec(q)

    exact = getattr(model, "slope_in_q", lambda *_: None)(q, qd, qdd)
    by_q = _slope(torque, q, np.full(q.shape, STEP)) if exact is None else exact
    return InverseSlopes(by_q, by_velocity + _friction_slope(model, qd), M)


def forward_dynamics_slopes(
    model: Manipulator, q: ArrayLike, qd: ArrayLike, u: ArrayLike
) -> ForwardSlopes:
    """∂q̈/∂q = −M⁻¹ ∂u/∂q, ∂q̈/∂q̇ = −M⁻¹ ∂u/∂q̇ at the q̈ that u gives, and ∂q̈/∂u = M⁻¹.

    q, qd, u: (..., n). Raises as `inverse_dynamics_slopes`, and numpy.linalg.LinAlgError where M is
    singular.
    """
    q, qd, u = np.broadcast_arrays(*state_vectors(model_given("model", model).n, q=q, qd=qd, u=u))
    slopes = inverse_dynamics_slopes(model, q, qd, model.dynamics(q, qd, u))
    inverse = np.linalg.inv(slopes.qdd)
    return ForwardSlopes(-inverse @ slopes.q, -inverse @ slopes.qd, inverse)


def linearise(model: Manipulator, x: ArrayLike, u: ArrayLike) -> Linearisation:
    """A = ∂ẋ/∂x and B = ∂ẋ/∂u at any state x = [q; q̇], (..., 2n), and input u, (..., n).

    Raises as `forward_dynamics_slopes`.
    """
    n = model_given("model", model).n
    x = state_vector("x", x, 2 * n)
    slopes = forward_dynamics_slopes(model, x[..., :n], x[..., n:], u)
    batch = slopes.u.shape[:-2]
    A, B = np.zeros((*batch, 2 * n, 2 * n)), np.zeros((*batch, 2 * n, n))
    A[..., :n, n:] = np.eye(n)
    A[..., n:, :n], A[..., n:, n:], B[..., n:, :] = slopes.q, slopes.qd, slopes.u
    return Linearisation(A, B, model.state_derivative(x, u))


def _slope(function, x, step) -> np.ndarray:
    """∂function_i/∂x_k, (..., i, k), all of its values in one call; step: (..., n)."""
    reach = np.array([s * k for k in WEIGHTS for s in (1, -1)], dtype=float)
    weights = np.array([s * w for w in WEIGHTS.values() for s in (1, -1)])
    along = step[..., np.newaxis, :, np.newaxis] * np.eye(x.shape[-1])
    values = function(_each(x) + reach[:, np.newaxis, np.newaxis] * along)  # (..., step, k, i)
    return np.einsum("s,...ski->...ik", weights, values) / step[..., np.newaxis, :]


def _each(vectors) -> np.ndarray:
    """With axes for the steps and the coordinates before the last."""
    return vectors[..., np.newaxis, np.newaxis, :]


def _friction_slope(model, qd) -> np.ndarray:
    """∂f/∂q̇ by differences over steps that do not pass zero, where Coulomb friction jumps."""
    moves = np.minimum(STEP, np.abs(qd) / 8)
    step = np.where(qd != 0, moves, NARROW)
    slope = _slope(model.f_vec, qd, step)
    finer = _slope(model.f_vec, qd, np.where(qd != 0, moves, NARROW / 1e6))
    # Of a jump, the quotient grows as the step shrinks.
    jumps = np.max(np.abs(finer), axis=-2) > 1e3 * np.max(np.abs(slope), axis=-2) + 1e-6
    if np.any(jumps):
        joint = int(np.argwhere(jumps)[0][-1]) + 1
        raise ValueError(
            f"qd: friction jumps where joint {joint} is at rest, so that the motion has no slope "
            "there; needs a joint that moves, or a model without Coulomb friction"
        )
    return slope
