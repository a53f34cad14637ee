"""`OwnArm`: how a student's own arm measures its angles, which way gravity pulls, and what is given."""

from collections.abc import Callable

import numpy as np


class OwnArm:
    """A planar arm with two links, as the set-up cell of a problem drew it.

    turns: ∂φ/∂q, (2, 2), with φ the angles of the links from the x axis. zeros: φ at q = 0, (2,), rad.
    pull: the angle from the x axis at which gravity pulls, rad. code: functions that the problem gives,
    as Python source that knows NumPy as np; they become attributes.
    """

    def __init__(self, turns, zeros, pull: float, code: str = ""):
        self.turns = np.array(turns, dtype=float)
        self._zeros, self._pull = np.array(zeros, dtype=float), float(pull)
        self._given: dict[str, Callable] = {}
        exec(code, {"np": np}, self._given)

    def directions(self, q) -> np.ndarray:
        """The angles of the links from the x axis, (…, 2), rad. q: (…, 2), rad."""
        return np.asarray(q, dtype=float) @ self.turns.T + self._zeros

    def angles(self, directions) -> np.ndarray:
        """q, (…, 2), rad, at which the links have these angles from the x axis, (…, 2), rad."""
        apart = np.asarray(directions, dtype=float) - self._zeros
        return apart @ np.linalg.inv(self.turns).T

    def gravity(self, g: float) -> np.ndarray:
        """The gravitational acceleration as a vector, (3,), m/s². g: its size."""
        # Where gravity pulls straight down, no rounding is left in x.
        return g * np.round([np.cos(self._pull), np.sin(self._pull), 0.0], 15)

    def __getattr__(self, name: str) -> Callable:
        try:
            return self.__dict__["_given"][name]
        except KeyError:
            raise AttributeError(
                f"this problem gives no {name}; it gives {', '.join(self._given) or 'no function'}"
            ) from None
