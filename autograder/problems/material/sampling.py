"""Random but physical parameters and states for the checks."""

from types import SimpleNamespace

import numpy as np


def pendulum(rng: np.random.Generator) -> SimpleNamespace:
    """`pend`: m (kg), lc (m), I about the pivot (kg·m²), g (m/s²); never two that could be confused."""
    m, lc = rng.uniform(0.5, 3.0), rng.uniform(0.2, 0.9)
    I_com = rng.uniform(0.1, 0.6) * m * lc**2
    return SimpleNamespace(m=m, lc=lc, I=I_com + m * lc**2, g=rng.uniform(3.0, 15.0))


def planar_2r(rng: np.random.Generator, friction: bool = False) -> SimpleNamespace:
    """`arm`: lengths l1, l2, lc1, lc2 (m), masses m1, m2 (kg), inertias I1, I2 about the centres of mass
    (kg·m²), g (m/s²); with friction also viscous (N·m·s/rad) and coulomb (N·m), (2,) each.

    No term of its equations is small beside the others, and no two could be confused.
    """
    (l1, l2), (share_1, share_2) = rng.uniform(0.5, 1.2, 2), rng.uniform(0.35, 0.65, 2)
    m1, m2 = rng.uniform(1.0, 4.0, 2)
    lc1, lc2 = share_1 * l1, share_2 * l2
    I1, I2 = rng.uniform(0.3, 0.8, 2) * (m1 * lc1**2, m2 * lc2**2)
    arm = SimpleNamespace(
        l1=l1, l2=l2, lc1=lc1, lc2=lc2, m1=m1, m2=m2, I1=I1, I2=I2, g=rng.uniform(3.0, 15.0)
    )
    arm = SimpleNamespace(**{name: float(value) for name, value in vars(arm).items()})
    if friction:
        arm.viscous, arm.coulomb = rng.uniform(0.2, 1.5, 2), rng.uniform(0.2, 1.5, 2)
    return arm


def angles(rng: np.random.Generator) -> np.ndarray:
    """q of two joints, (2,), rad: neither sine nor cosine of q1, q2 or q1 + q2 nearly vanishes."""
    while True:
        q = np.concatenate([angle(rng), angle(rng)])
        if np.min(np.abs([np.sin(sum(q)), np.cos(sum(q))])) > 0.15:
            return q


def velocities(rng: np.random.Generator) -> np.ndarray:
    """q̇ of two joints, (2,), rad/s: either sign each, not near zero."""
    return np.concatenate([velocity(rng), velocity(rng)])


def angle(rng: np.random.Generator) -> np.ndarray:
    """q, (1,), rad: anywhere on the circle, but not where sine or cosine nearly vanishes."""
    quarter = rng.integers(-2, 2) * np.pi / 2
    return np.array([quarter + rng.uniform(0.2, np.pi / 2 - 0.2)])


def velocity(rng: np.random.Generator) -> np.ndarray:
    """q̇, (1,), rad/s: either sign, not near zero."""
    return np.array([rng.choice([-1.0, 1.0]) * rng.uniform(0.5, 3.0)])
