"""Computes the regressors of the energies: K = Y_K(q, q̇) π, P = Y_P(q) π and E = (Y_K + Y_P) π.

π is that of `armdyn.regressor`, and as there, only geometry and gravity enter; K is that of the links
alone. Along a motion dE/dt = q̇ᵀ (u − f), so that the rise of E between two moments, which needs no
accelerations, is the work done by the motors less that lost to friction: measured energies show the
same base parameters.

Source: M. Gautier, W. Khalil (1988), On the Identification of the Inertial Parameters of Robots,
Proceedings of the 27th IEEE Conference on Decision and Control.
"""

import numpy as np
from numpy.typing import ArrayLike

from armdyn.geometry import INERTIA, PlanarGeometry, geometry, sum_of_those_before
from armdyn.manipulator import Manipulator
from armdyn.parameters import state_vector, state_vectors


def energy_regressor(model: Manipulator, q: ArrayLike, qd: ArrayLike) -> np.ndarray:
    """The row Y_E with K + P = Y_E π, (..., 4n) for planar arms, (..., 10n) for spatial chains.

    q, qd: (..., n), rad, rad/s (m, m/s for a prismatic joint). P is 0 where the model's
    `potential_energy` is. The motors' part of K, Σ ½ a_i q̇_i² with the armature a, is not in it: a
    model's `energy` has it. Raises ValueError for states of the wrong shape or not finite, and for a
    model without links.
    """
    return kinetic_energy_regressor(model, q, qd) + potential_energy_regressor(model, q)


def kinetic_energy_regressor(model: Manipulator, q: ArrayLike, qd: ArrayLike) -> np.ndarray:
    """The row Y_K with K = Y_K π: |v|²/2, v × ω and ω ωᵀ/2 of each link, in its own axes.

    Arguments, shape and errors are those of `energy_regressor`.
    """
    shape = geometry(model)
    q, qd = np.broadcast_arrays(*state_vectors(shape.n, q=q, qd=qd))
    if isinstance(shape, PlanarGeometry):
        return _planar_kinetic(shape, q, qd)
    velocity = np.matvec(shape.chain.link_jacobians(q), qd[..., np.newaxis, :])
    w, v = velocity[..., :3], velocity[..., 3:]
    # An entry beside the diagonal stands for two of ωᵀ J ω.
    turning = [w[..., i] * w[..., j] * (0.5 if i == j else 1.0) for i, j in INERTIA]
    return _joined(shape, np.vecdot(v, v) / 2, np.cross(v, w), *turning)


def potential_energy_regressor(model: Manipulator, q: ArrayLike) -> np.ndarray:
    """The row Y_P with P = Y_P π: how far against gravity each link's origin and axes reach.

    Arguments, shape and errors are those of `energy_regressor`.
    """
    shape = geometry(model)
    q = state_vector("q", q, shape.n)
    if isinstance(shape, PlanarGeometry):
        return _planar_potential(shape, q)
    R, p = shape.chain.link_placements(q)
    up = -np.array(shape.gravity)
    return _joined(shape, np.vecdot(p, up), np.vecmat(up, R), *[np.zeros(q.shape)] * 6)


def _planar_kinetic(shape, q, qd) -> np.ndarray:
    rate = np.cumsum(qd, axis=-1)
    x_axis, y_axis = shape.axes(q)
    length = np.array(shape.l)[:, np.newaxis]
    v = sum_of_those_before(length * rate[..., np.newaxis] * y_axis)  # of the joints
    across, along = np.vecdot(v, y_axis), np.vecdot(v, x_axis)
    return _joined(shape, np.vecdot(v, v) / 2, rate * across, -rate * along, rate**2 / 2)


def _planar_potential(shape, q) -> np.ndarray:
    x_axis, y_axis = shape.axes(q)
    joint = sum_of_those_before(np.array(shape.l)[:, np.newaxis] * x_axis)
    up = -np.array(shape.gravity)
    heights = (np.vecdot(part, up) for part in (joint, x_axis, y_axis))
    row = _joined(shape, *heights, np.zeros(q.shape))
    return row - up @ [1.0, 0.0] * np.array([0.0, 1.0, 0.0, 0.0]) if shape.hangs else row


def _joined(shape, *parts) -> np.ndarray:
    """Parts of shape (..., n) or (..., n, 3), link by link in one row: (..., 4n) or (..., 10n)."""
    batch = parts[0].shape[:-1]
    columns = [part.reshape(*batch, shape.n, -1) for part in parts]
    return np.concatenate(columns, axis=-1).reshape(*batch, -1)
