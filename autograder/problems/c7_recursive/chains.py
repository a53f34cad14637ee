"""Random chains in space, with inertias that bodies can have."""

from types import SimpleNamespace

import numpy as np

from autograder.problems.c7_recursive.sweeps import rotation


def random_chain(rng: np.random.Generator, n: int, gravity: bool) -> SimpleNamespace:
    """A chain of n links whose joints point anywhere, with inertias that a body can have."""
    down = -rng.uniform(4.0, 12.0) * _direction(rng) if gravity else np.zeros(3)
    com = np.array([rng.uniform(0.15, 0.4) * _direction(rng) for _ in range(n)])
    m = rng.uniform(1.0, 3.0, n)
    return SimpleNamespace(
        axis=np.array([_direction(rng) for _ in range(n)]),
        offset=np.array([rng.uniform(0.3, 0.7) * _direction(rng) for _ in range(n)]),
        m=m,
        com=com,
        I=np.array([_inertia(rng, mass * (c @ c)) for mass, c in zip(m, com, strict=True)]),
        viscous=rng.uniform(0.2, 1.0, n),
        gravity=down,
    )


def _direction(rng) -> np.ndarray:
    """A unit vector of which no component is small."""
    while True:
        v = rng.normal(size=3)
        v /= np.linalg.norm(v)
        if np.min(np.abs(v)) > 0.2:
            return v


def _inertia(rng, size: float) -> np.ndarray:
    """About the centre of mass: three different principal moments, none above the sum of the others."""
    spread = size * rng.permutation([0.3, 0.7, 1.2]) * rng.uniform(0.8, 1.2, 3)
    moments = np.sum(spread) - spread
    turn = rotation(_direction(rng), rng.uniform(0.5, 2.5))
    I = turn @ np.diag(moments) @ turn.T
    return (I + I.T) / 2
