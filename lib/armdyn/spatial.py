"""Six-dimensional vectors: the velocity of a rigid body as [ω; v], the force on it as [n; f].

ω is the angular velocity and v the velocity of the body's point at the origin of the coordinates
used; n is the moment about that origin and f the force. A matrix X takes velocities from one frame's
coordinates to another's; its transpose takes forces back. All functions take leading batch axes.

Source: R. Featherstone (2008), Rigid Body Dynamics Algorithms, chapter 2.
"""

import numpy as np
from numpy.typing import ArrayLike


def skew(r: ArrayLike) -> np.ndarray:
    """r×, (..., 3, 3): skew(r) @ s = r × s for r of shape (..., 3)."""
    r = np.asarray(r, dtype=float)
    matrix = np.zeros((*r.shape, 3))
    matrix[..., 2, 1], matrix[..., 0, 2], matrix[..., 1, 0] = np.moveaxis(r, -1, 0)
    return matrix - np.swapaxes(matrix, -1, -2)


def rotation(axis: ArrayLike, angle: ArrayLike) -> np.ndarray:
    """Rotation by `angle`, (...), rad, about the unit vector `axis`, (3,): (..., 3, 3).

    Source: O. Rodrigues (1840), Des lois géométriques qui régissent les déplacements d'un système
    solide dans l'espace.
    """
    turn = skew(axis)
    angle = np.asarray(angle, dtype=float)[..., np.newaxis, np.newaxis]
    return np.eye(3) + np.sin(angle) * turn + (1 - np.cos(angle)) * (turn @ turn)


def motion_transform(R: ArrayLike, p: ArrayLike) -> np.ndarray:
    """X, (..., 6, 6): from a frame's coordinates to those of a frame placed at (R, p) in it.

    R: (..., 3, 3), whose columns are the placed frame's axes. p: (..., 3), its origin, m.
    """
    across = np.swapaxes(R, -1, -2)
    return _blocks(across, np.zeros_like(across), -across @ skew(p), across)


def motion_cross(v: np.ndarray) -> np.ndarray:
    """v×, (..., 6, 6): the rate of a velocity that is fixed in a body moving with v, (..., 6)."""
    turn = skew(v[..., :3])
    return _blocks(turn, np.zeros_like(turn), skew(v[..., 3:]), turn)


def force_cross(v: np.ndarray) -> np.ndarray:
    """v×*, (..., 6, 6): the same for a force; minus the transpose of v×."""
    return -np.swapaxes(motion_cross(v), -1, -2)


def swapped_cross(f: np.ndarray) -> np.ndarray:
    """(..., 6, 6), skew-symmetric: swapped_cross(f) @ v = force_cross(v) @ f, f of shape (..., 6)."""
    force = -skew(f[..., 3:])
    return _blocks(-skew(f[..., :3]), force, force, np.zeros_like(force))


def rigid_inertia(mass: float, com: np.ndarray, inertia: np.ndarray) -> np.ndarray:
    """Spatial inertia (6, 6) about the frame's origin: it maps [ω; v] to the momentum.

    mass: kg. com: (3,), centre of mass in the frame, m. inertia: (3, 3), about the centre of mass
    and along the frame's axes, kg·m².
    """
    moment = mass * skew(com)
    about_origin = inertia + moment @ skew(com).T
    return _blocks(about_origin, moment, moment.T, mass * np.eye(3))


def _blocks(a, b, c, d) -> np.ndarray:
    """Four (..., 3, 3) arrays of one shape as [[a, b], [c, d]]."""
    matrix = np.empty((*a.shape[:-2], 6, 6))
    matrix[..., :3, :3], matrix[..., :3, 3:] = a, b
    matrix[..., 3:, :3], matrix[..., 3:, 3:] = c, d
    return matrix
