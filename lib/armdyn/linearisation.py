"""Linearises the equation of motion: how u and q̈ change with q, q̇, q̈ and u, and ẋ ≈ A δx + B δu.

Of u = M q̈ + C q̇ + g + f, the slopes in q̇ and q̈ are exact: C is linear in q̇, so that
∂u/∂q̇_k = C(q, q̇) e_k + C(q, e_k) q̇ + ∂f/∂q̇_k, and ∂u/∂q̈ = M. The slope in q is exact for the
models of `armdyn.codegen` with up to four coordinates. For others it is by central differences of order
8, with an error of about 1e-13 of the largest term. Two widths have to agree: where u changes much over
0.06 rad or m, or has a kink there, as where a contact begins, narrower ones are taken.
`Derivation.inverse_dynamics_slopes` gives the slopes in symbols.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from armdyn.manipulator import Manipulator, model_given, own_term
from armdyn.parameters import state_vector, state_vectors

# Order 8: truncation h⁸ and rounding EPS/h balance near here.
STEP = 0.015
WEIGHTS = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
HALVINGS = 10  # of STEP, until the slope of one step and of half of it agree
AGREE = 1e-9  # of the largest slope and torque
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
    jumps: Coulomb friction at rest has no slope. For slopes by differences, also where u has a kink at
    q or within 1e-4 rad or m of it: there is a slope on either side and none between.

    Source: J. Carpentier, N. Mansard (2018), Analytical Derivatives of Rigid Body Dynamics
    Algorithms, Robotics: Science and Systems, for what is asked for.
    """
    q, qd, qdd = np.broadcast_arrays(
        *state_vectors(model_given("model", model).n, q=q, qd=qd, qdd=qdd)
    )
    if own_term(model, Manipulator, ("bias",)):
        raise ValueError(
            f"model: this {type(model).__name__} has its own bias, and the slopes are those of C q̇, g "
            "and f; needs a model that says in C, g_vec and f_vec what acts on it"
        )
    M = model.M(q)
    h = model.christoffel_symbols(q)
    by_velocity = model.C(q, qd) + np.einsum("...ijk,...j->...ik", h, qd)

    def torque(q):
        held = np.matvec(model.M(q), _each(qdd)) + np.matvec(model.C(q, _each(qd)), _each(qd))
        return held + model.g_vec(q)

    exact = getattr(model, "slope_in_q", lambda *_: None)(q, qd, qdd)
    if exact is None:
        parts = np.matvec(abs(M), abs(qdd)) + np.matvec(abs(model.C(q, qd)), abs(qd))
        size = np.max(parts + abs(model.g_vec(q)), axis=-1, keepdims=True)
        by_q = _settled_slope(torque, q, size)
    else:
        by_q = exact
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


def _settled_slope(function, q, size) -> np.ndarray:
    """`_slope` by the widest step that agrees with half of it, each coordinate by its own.

    size: of the largest part of the function, (..., 1).
    """
    step = np.full(q.shape, STEP)
    slope, settled = _slope(function, q, step), np.zeros(q.shape, bool)
    for _ in range(HALVINGS):
        half = _slope(function, q, np.where(settled, step, step / 2))
        apart = np.max(np.abs(half - slope), axis=-2)
        largest = np.maximum(size, np.max(np.abs(half), axis=(-2, -1))[..., np.newaxis])
        settled |= apart <= AGREE * largest
        if np.all(settled):
            break
        step = np.where(settled, step, step / 2)
        slope = np.where(settled[..., np.newaxis, :], slope, half)
    # A kink at q itself is the same to both: there the slopes on the two sides stay apart.
    near, wider = (_bend(function, q, h) for h in (NARROW, 10 * NARROW))
    rounding = 8 * np.finfo(float).eps * np.abs(q) / NARROW
    bent = (near > (1e3 * AGREE + rounding) * largest) & (near > wider / 2)
    if np.any(bent | ~settled):
        at = np.argwhere(bent | ~settled)[0]
        place = q[(*at[:-1],)]
        raise ValueError(
            f"q: the torque has a kink near q = {place} along coordinate {int(at[-1]) + 1}, so that it "
            "has no slope there; needs a state away from it, as from where a contact begins"
        )
    return slope


def _bend(function, q, step) -> np.ndarray:
    """By how much the slopes forwards and backwards differ along each coordinate, (..., k)."""
    along = step * np.eye(q.shape[-1])
    ahead, here, behind = (function(_each(q) + s * along) for s in (1, 0, -1))
    return np.max(np.abs(ahead - 2 * here + behind), axis=(-3, -1)) / step


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
