"""Makes ẋ a function of time and state: a state form f(x, u) with its input u put in."""

from collections.abc import Callable

import numpy as np

from armdyn.manipulator import Manipulator
from armdyn.parameters import all_finite, real_array

Input = np.ndarray | Callable[[float, np.ndarray], np.ndarray]


class Rate:
    """ẋ as a function of (t, x); NaN if f cannot be computed with finite numbers.

    After a NaN, an adaptive method takes its step back and tries a shorter one.

    u: held constant, (n,); one row per time of t, (..., T, n), of which row k is put in by hold(k);
    or a function u(t, x). Raises ValueError for another shape, and, when called, for an input or
    an ẋ that is not real numbers of the right shape.
    f: a function f(x, u), or a Manipulator, which stands for its state form; `model` is None for a
    function.
    latest: the last time at which ẋ was finite. calls: how often it was asked for.
    """

    def __init__(self, f, u: Input, t):
        self.model = f if isinstance(f, Manipulator) else None
        self.f = f.state_derivative if isinstance(f, Manipulator) else f
        self.latest = -np.inf
        self.calls = 0
        self.samples = None
        self.u = u if callable(u) else all_finite("u", real_array("u", u))
        if not callable(self.u) and self.u.ndim > 1:
            if self.u.shape[-2] not in (1, len(t)):
                raise ValueError(
                    f"u: got shape {self.u.shape}, needs (n,), held constant, or one row per time, "
                    f"(..., {len(t)}, n), or a function u(t, x); (..., 1, n) holds one per arm"
                )
            self.samples = np.broadcast_to(self.u, (*self.u.shape[:-2], len(t), self.u.shape[-1]))
            self.hold(0)

    def hold(self, k: int) -> None:
        """Let sample k be the input from now on."""
        if self.samples is not None:
            self.u = self.samples[..., k, :]

    def jumps(self) -> list[int]:
        """The indices k, not 0 nor the last, at which a sampled input differs from the one before.

        The last sample is left out, as no time follows for which it is held.
        """
        if self.samples is None:
            return []
        rows = np.moveaxis(self.samples, -2, 0)[:-1]
        changed = np.any(rows[1:] != rows[:-1], axis=tuple(range(1, rows.ndim)))
        return [int(k) + 1 for k in np.flatnonzero(changed)]

    def input(self, t, x) -> np.ndarray:
        """u at this time and state."""
        return real_array("u(t, x)", self.u(t, x)) if callable(self.u) else self.u

    def __call__(self, t, x) -> np.ndarray:
        self.calls += 1
        if not np.isfinite(x).all():
            return np.full(x.shape, np.nan)
        u = self.input(t, x)
        if not np.isfinite(u).all():
            return np.full(x.shape, np.nan)
        try:
            slope = slope_of(self.f, x, u, f"f(x, u) at t = {t:.6g} s")
        except (OverflowError, FloatingPointError):
            return np.full(x.shape, np.nan)
        if np.isfinite(slope).all():
            self.latest = max(self.latest, t)
        return slope


def slope_of(f, x, u, name: str) -> np.ndarray:
    """f(x, u) as a float array; ValueError, under that name, unless it has the shape of x."""
    slope = real_array(name, f(x, u))
    if slope.shape != x.shape:
        raise ValueError(f"{name}: got shape {slope.shape}, needs that of x, {x.shape}")
    return slope
