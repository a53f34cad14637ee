"""The physical pendulum: the smallest manipulator, n = 1."""

from dataclasses import dataclass, field, fields
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from armdyn.friction import joint_friction
from armdyn.manipulator import Manipulator
from armdyn.parameters import finite, nonnegative, positive, state_vector, state_vectors

# How far below m·lc² rounding alone may put an I that was computed as I_com + m·lc² with I_com = 0.
ROUNDING = 1e-12


@dataclass(frozen=True)
class Pendulum(Manipulator):
    """A rigid body that swings about a fixed horizontal axis.

    q is measured from hanging straight down; positive is counter-clockwise. Then M = I, C = 0 and
    g = m g ℓc sin q, so that I q̈ + m g ℓc sin q + f = u.

    `I` is the inertia about the *pivot*. It cannot be smaller than m ℓc² (parallel-axis theorem),
    and ValueError says so; from an inertia about the centre of mass use `Pendulum.from_com`.
    Raises ValueError, naming the argument, for a parameter that is not finite or not physical.
    """

    m: float = field(metadata={"unit": "kg", "doc": "mass"})
    lc: float = field(metadata={"unit": "m", "doc": "distance from pivot to centre of mass"})
    I: float = field(metadata={"unit": "kg·m²", "doc": "inertia about the pivot"})
    g: float = field(default=9.81, metadata={"unit": "m/s²", "doc": "gravitational acceleration"})
    viscous: float = field(default=0.0, metadata={"unit": "N·m·s/rad", "doc": "viscous friction"})
    coulomb: float = field(default=0.0, metadata={"unit": "N·m", "doc": "Coulomb friction"})

    n = 1

    def __post_init__(self):
        checks = {"m": positive, "I": positive, "g": finite}
        for parameter in fields(self):
            name, unit = parameter.name, parameter.metadata["unit"]
            value = checks.get(name, nonnegative)(name, getattr(self, name), unit)
            # Floats whatever came, so that pendulums compare and hash by their numbers.
            object.__setattr__(self, name, value)
        least = self.m * self.lc**2
        if least * (1 - ROUNDING) > self.I:
            raise ValueError(
                f"I = {self.I!r}: the inertia about the pivot is at least m lc² = {least:.6g} "
                "kg·m²; for an inertia about the centre of mass use "
                "Pendulum.from_com(m, lc, I_com)"
            )

    @classmethod
    def from_com(cls, m: float, lc: float, I_com: float, **others) -> Self:
        """A pendulum from its inertia about the centre of mass, I = I_com + m ℓc² (kg·m²).

        others: g, viscous and coulomb, as in the constructor, whose ValueErrors it raises too.
        """
        nonnegative("I_com", I_com, "kg·m²")
        positive("m", m, "kg")
        nonnegative("lc", lc, "m")
        return cls(m=m, lc=lc, I=I_com + m * lc**2, **others)

    def M(self, q: ArrayLike) -> np.ndarray:
        """(1, 1), kg·m²: the constant I."""
        q = state_vector("q", q, 1)
        return np.full((*q.shape, 1), self.I)

    def C(self, q: ArrayLike, qd: ArrayLike) -> np.ndarray:
        """(1, 1), kg·m²/s: zero, since M does not depend on q."""
        q, qd = state_vectors(1, q=q, qd=qd)
        return np.zeros((*np.broadcast_shapes(q.shape, qd.shape), 1))

    def g_vec(self, q: ArrayLike) -> np.ndarray:
        """m g ℓc sin q, (1,), N·m."""
        return self.m * self.g * self.lc * np.sin(state_vector("q", q, 1))

    def f_vec(self, qd: ArrayLike) -> np.ndarray:
        """Viscous and Coulomb friction, (1,), N·m."""
        return joint_friction(state_vector("qd", qd, 1), self.viscous, self.coulomb)

    def potential_energy(self, q: ArrayLike) -> np.ndarray:
        """P = m g ℓc (1 − cos q), zero when hanging, J."""
        q = state_vector("q", q, 1)[..., 0]
        return self.m * self.g * self.lc * (1 - np.cos(q))
