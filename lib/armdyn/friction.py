"""Computes joint friction: viscous plus Coulomb."""

import numpy as np


def joint_friction(qd: np.ndarray, viscous, coulomb) -> np.ndarray:
    """f(q̇) = d q̇ + k sign(q̇) for each joint, (..., n), N·m.

    qd: (..., n), rad/s. viscous d: (n,), N·m·s/rad. coulomb k: (n,), N·m. At rest sign(0) = 0: the
    model has no stiction. f is on the left of the equation of motion, so it opposes the motion: it
    takes the power q̇ᵀ f ≥ 0 out of the arm.
    """
    return np.asarray(viscous) * qd + np.asarray(coulomb) * np.sign(qd)
