"""Random but physical parameters and states for the checks."""

from types import SimpleNamespace

import numpy as np


def pendulum(rng: np.random.Generator) -> SimpleNamespace:
    """`pend`: m (kg), lc (m), I about the pivot (kg·m²), g (m/s²); never two that could be confused."""
    m, lc = rng.uniform(0.5, 3.0), rng.uniform(0.2, 0.9)
    I_com = rng.uniform(0.1, 0.6) * m * lc**2
    return SimpleNamespace(m=m, lc=lc, I=I_com + m * lc**2, g=rng.uniform(3.0, 15.0))


def angle(rng: np.random.Generator) -> np.ndarray:
    """q, (1,), rad: anywhere on the circle, but not where sine or cosine nearly vanishes."""
    quarter = rng.integers(-2, 2) * np.pi / 2
    return np.array([quarter + rng.uniform(0.2, np.pi / 2 - 0.2)])


def velocity(rng: np.random.Generator) -> np.ndarray:
    """q̇, (1,), rad/s: either sign, not near zero."""
    return np.array([rng.choice([-1.0, 1.0]) * rng.uniform(0.5, 3.0)])
