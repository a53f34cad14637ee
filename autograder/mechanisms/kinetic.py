"""The kinetic energy of a mechanism is positive for every motion, tried in numbers."""

import numpy as np
import sympy as sp

from autograder.mechanisms.mechanism import Mechanism

DRAWS = 4


def refuse_other_than_positive(mechanism: Mechanism) -> None:
    """ValueError, naming coordinates, where K is negative or 0 for a motion: M needs to be positive
    definite, so that M q̈ = … has one solution.
    """
    where = f"mechanism {mechanism.name!r}"
    rng = np.random.default_rng(0)
    named = [*mechanism.q, *mechanism.qd, *(p.symbol for p in mechanism.parameters)]
    K = sp.lambdify(named, sp.sympify(mechanism.K), "numpy")
    for _ in range(DRAWS):
        arm, q = mechanism.drawn(rng), mechanism.placed(rng)
        numbers = [vars(arm)[p.name] for p in mechanism.parameters]
        M = _inertia(lambda qd, q=q, numbers=numbers: float(K(*q, *qd, *numbers)), mechanism.n)
        sizes, motions = np.linalg.eigh(M)
        if sizes[0] > 1e-10 * max(sizes[-1], 1.0):
            continue
        moved = np.abs(motions[:, 0]) > 0.1
        names = [c.velocity.name for c, moves in zip(mechanism.coordinates, moved, strict=True)
                 if moves]  # fmt: skip
        if sizes[0] < -1e-10 * max(sizes[-1], 1.0):
            raise ValueError(
                f"{where}: K is negative for a motion with {' and '.join(names)}, as no kinetic "
                "energy is; look at the signs of its terms"
            )
        raise ValueError(
            f"{where}: K is 0 for a motion with {' and '.join(names)}, so M has no inverse; give what "
            "moves there a mass or an inertia"
        )


def _inertia(K, n: int) -> np.ndarray:
    """M, (n, n), of a K quadratic in q̇: 2 K = q̇ᵀ M q̇."""
    unit = np.eye(n)
    return np.array([[K(a + b) - K(a) - K(b) for b in unit] for a in unit])
