"""Solves the equation of an implicit step by fixed-point iteration, to rounding."""

import numpy as np

ITERATIONS = 100
ROUNDING = 4 * np.finfo(float).eps
NEARLY = 1e-9


def to_rounding(improved, change, x, method: str, t: float, dt: float) -> np.ndarray:
    """The Δx with Δx = improved(Δx), from a first guess `change`; all of shape (..., N), as x.

    Stops where Δx changes by no more than rounding beside x and Δx, or stops getting closer near
    that. Raises FloatingPointError, naming the method and the time, where it does neither.

    Source: E. Hairer, C. Lubich, G. Wanner (2006), Geometric Numerical Integration, chapter VIII.
    """
    last = np.inf
    done = np.zeros(x.shape[:-1], bool)
    for _ in range(ITERATIONS):
        new = improved(change)
        moved = np.max(np.abs(new - change), axis=-1)
        size = np.max(np.abs(x) + np.abs(new), axis=-1)
        if not np.isfinite(size).all():
            break
        change = new
        # Rounding inside the rate may keep the change above ROUNDING: then it stops shrinking.
        done |= (moved <= ROUNDING * size) | ((moved >= last) & (moved <= NEARLY * size))
        if done.all():
            return change
        last = moved
    raise FloatingPointError(
        f"{method} did not converge in the step of {dt:.3g} s from t = {t:.6g} s: its "
        "iteration needs a shorter step, and a rate without jumps such as Coulomb friction at rest"
    )
