"""The recursive algorithms for a chain of bodies: what `SerialChain.rnea`, `crba` and `aba` compute."""

from dataclasses import dataclass

import numpy as np

from armdyn.manipulator import ROUNDING
from armdyn.spatial import force_cross, motion_cross


@dataclass(frozen=True, eq=False)
class Bodies:
    """A chain in one configuration, or in many.

    transforms: X_k, (..., 6, 6), from the coordinates of the link before to those of link k. inertias:
    (n, 6, 6). screws: (n, 6), the velocity of each link for q̇ = 1. armature: (n,). gravity: (3,), in
    the base's frame. turning: whether each joint is revolute.
    """

    transforms: list[np.ndarray]
    inertias: np.ndarray
    screws: np.ndarray
    armature: np.ndarray
    gravity: np.ndarray
    turning: tuple[bool, ...]

    @property
    def n(self) -> int:
        return len(self.screws)

    @property
    def base_acceleration(self) -> np.ndarray:
        """A base that accelerates upwards stands for gravity, (6,)."""
        return np.array([0.0, 0.0, 0.0, *(-self.gravity)])


def newton_euler(bodies: Bodies, qd, qdd, u) -> np.ndarray:
    """`u` with M q̈ + C q̇ + g added, (..., n)."""
    v, a, forces = np.zeros(6), bodies.base_acceleration, []
    for k, (X, I) in enumerate(zip(bodies.transforms, bodies.inertias, strict=True)):
        moved = bodies.screws[k] * qd[..., k : k + 1]
        v = np.matvec(X, v) + moved
        a = np.matvec(X, a) + bodies.screws[k] * qdd[..., k : k + 1]
        a = a + np.matvec(motion_cross(v), moved)
        forces.append(np.matvec(I, a) + np.matvec(force_cross(v), np.matvec(I, v)))
    u = u + bodies.armature * qdd
    force = np.zeros(6)
    for k in reversed(range(bodies.n)):
        force = force + forces[k]
        u[..., k] += force @ bodies.screws[k]
        force = np.vecmat(force, bodies.transforms[k])
    return u


def composite_inertia(bodies: Bodies, batch: tuple[int, ...]) -> np.ndarray:
    """M, (..., n, n), from the links from k outwards taken as one body. batch: its leading axes."""
    n = bodies.n
    M = np.empty((*batch, n, n))
    composite = np.zeros((6, 6))
    for k in reversed(range(n)):
        composite = composite + bodies.inertias[k]
        force = composite @ bodies.screws[k]
        M[..., k, k] = force @ bodies.screws[k] + bodies.armature[k]
        for j in reversed(range(k)):
            force = np.vecmat(force, bodies.transforms[j + 1])
            M[..., j, k] = M[..., k, j] = force @ bodies.screws[j]
        composite = _carried(composite, bodies.transforms[k])
    return M


def articulated_acceleration(bodies: Bodies, qd, effort) -> np.ndarray:
    """q̈, (..., n), for the torques that are left when friction has taken its part.

    Raises numpy.linalg.LinAlgError, naming the joint, where nothing resists its motion.
    """
    v, drifts, biases = np.zeros(6), [], []
    for k, (X, I) in enumerate(zip(bodies.transforms, bodies.inertias, strict=True)):
        moved = bodies.screws[k] * qd[..., k : k + 1]
        v = np.matvec(X, v) + moved
        drifts.append(np.matvec(motion_cross(v), moved))
        biases.append(np.matvec(force_cross(v), np.matvec(I, v)))
    outwards: list = []
    inertia, bias = np.zeros((6, 6)), np.zeros(6)
    for k in reversed(range(bodies.n)):
        screw = bodies.screws[k]
        inertia, bias = inertia + bodies.inertias[k], bias + biases[k]
        held = inertia @ screw
        resistance = (held @ screw + bodies.armature[k])[..., np.newaxis]
        _refuse_idle(bodies, k, resistance[..., 0], inertia)
        free = (effort[..., k : k + 1] - (bias @ screw)[..., np.newaxis]) / resistance
        drag = held / resistance
        outwards.insert(0, (free, drag))
        rest = inertia - held[..., :, np.newaxis] * drag[..., np.newaxis, :]
        bias = bias + np.matvec(rest, drifts[k]) + held * free
        bias = np.vecmat(bias, bodies.transforms[k])
        inertia = _carried(rest, bodies.transforms[k])
    qdd = np.empty(effort.shape)
    a = bodies.base_acceleration
    for k, (free, drag) in enumerate(outwards):
        a = np.matvec(bodies.transforms[k], a) + drifts[k]
        qdd[..., k] = free[..., 0] - np.vecdot(drag, a)
        a = a + bodies.screws[k] * qdd[..., k : k + 1]
    return qdd


def _refuse_idle(bodies: Bodies, k: int, resistance, inertia) -> None:
    # Against the entries of the same unit, so that a very small or large arm is not refused.
    part = slice(0, 3) if bodies.turning[k] else slice(3, 6)
    size = np.max(np.abs(inertia[..., part, part]), axis=(-2, -1))
    if np.any(resistance <= bodies.n * ROUNDING * size):
        raise np.linalg.LinAlgError(
            f"M(q) is singular: the links from joint {k + 1} outwards do not resist its motion, "
            "so q̈ is not determined"
        )


def _carried(inertia, X) -> np.ndarray:
    """The inertia in the coordinates of the link before, Xᵀ I X."""
    return np.swapaxes(X, -1, -2) @ inertia @ X
