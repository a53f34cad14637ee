"""The planar arm with two revolute joints (2R), in closed form."""

from dataclasses import dataclass, field, fields
from functools import cached_property
from inspect import getattr_static
from math import cos, inf, sin

import numpy as np
from numpy import empty  # found a little sooner, and `dynamics` is a matter of nanoseconds
from numpy.typing import ArrayLike

from armdyn.friction import joint_friction
from armdyn.manipulator import TERMS, Manipulator
from armdyn.parameters import (
    finite,
    nonnegative,
    per_joint,
    positive,
    state_vector,
    state_vectors,
)


@dataclass(frozen=True)
class Planar2R(Manipulator):
    """Two links in a vertical plane, x to the right, y up, gravity along −y.

    q1 is the angle of link 1 from the x axis, q2 that of link 2 relative to link 1. Each centre of
    mass lies on its link's axis; I1 and I2 are inertias about the centres of mass. A centre of mass
    behind its joint (a counterweight) has a negative lc.
    Raises ValueError, naming the argument, for a parameter that is not finite or not physical.
    Masses and inertias may be zero, and M(q) may then be singular: see `Manipulator.dynamics`.

    Source: M. W. Spong, M. Vidyasagar (1989), Robot Dynamics and Control, chapter 6, for M, C, g.
    """

    l1: float = field(metadata={"unit": "m", "doc": "length of link 1"})
    l2: float = field(metadata={"unit": "m", "doc": "length of link 2"})
    lc1: float = field(metadata={"unit": "m", "doc": "joint 1 to the centre of mass of link 1"})
    lc2: float = field(metadata={"unit": "m", "doc": "joint 2 to the centre of mass of link 2"})
    m1: float = field(metadata={"unit": "kg", "doc": "mass of link 1"})
    m2: float = field(metadata={"unit": "kg", "doc": "mass of link 2"})
    I1: float = field(
        metadata={"unit": "kg·m²", "doc": "inertia of link 1 about its centre of mass"}
    )
    I2: float = field(
        metadata={"unit": "kg·m²", "doc": "inertia of link 2 about its centre of mass"}
    )
    g: float = field(default=9.81, metadata={"unit": "m/s²", "doc": "gravitational acceleration"})
    viscous: tuple[float, float] = field(
        default=(0.0, 0.0), metadata={"unit": "N·m·s/rad", "doc": "viscous friction of each joint"}
    )
    coulomb: tuple[float, float] = field(
        default=(0.0, 0.0), metadata={"unit": "N·m", "doc": "Coulomb friction of each joint"}
    )

    n = 2

    def __post_init__(self):
        checks = {"l1": positive, "l2": positive, "lc1": finite, "lc2": finite, "g": finite}
        for parameter in fields(self):
            name, unit = parameter.name, parameter.metadata["unit"]
            value = getattr(self, name)
            if name in ("viscous", "coulomb"):
                value = per_joint(name, value, 2, unit)
            else:
                value = checks.get(name, nonnegative)(name, value, unit)
            # Floats and tuples whatever came, so that arms compare and hash by their numbers.
            object.__setattr__(self, name, value)

    def M(self, q: ArrayLike) -> np.ndarray:
        """(2, 2), kg·m²; it depends on q2 alone."""
        q2 = state_vector("q", q, 2)[..., 1]
        coupling = self.m2 * self.l1 * self.lc2 * np.cos(q2)
        M22 = self.I2 + self.m2 * self.lc2**2
        M12 = M22 + coupling
        M11 = self.I1 + self.m1 * self.lc1**2 + self.m2 * self.l1**2 + M22 + 2 * coupling
        # fmt: off
        return _matrix(M11, M12,
                       M12, M22)
        # fmt: on

    def C(self, q: ArrayLike, qd: ArrayLike) -> np.ndarray:
        """Christoffel form, (2, 2), kg·m²/s."""
        q, qd = state_vectors(2, q=q, qd=qd)
        qd1, qd2 = qd[..., 0], qd[..., 1]
        h = -self.m2 * self.l1 * self.lc2 * np.sin(q[..., 1])
        # fmt: off
        return _matrix( h * qd2, h * (qd1 + qd2),
                       -h * qd1, 0.0)
        # fmt: on

    def g_vec(self, q: ArrayLike) -> np.ndarray:
        """(2,), N·m."""
        q = state_vector("q", q, 2)
        g2 = self.m2 * self.lc2 * self.g * np.cos(q[..., 0] + q[..., 1])
        g1 = (self.m1 * self.lc1 + self.m2 * self.l1) * self.g * np.cos(q[..., 0]) + g2
        return np.stack([g1, g2], axis=-1)

    def f_vec(self, qd: ArrayLike) -> np.ndarray:
        """Viscous and Coulomb friction of each joint, (2,), N·m."""
        return joint_friction(state_vector("qd", qd, 2), self.viscous, self.coulomb)

    def dynamics(self, q: ArrayLike, qd: ArrayLike, u: ArrayLike) -> np.ndarray:
        """Acceleration q̈ = M⁻¹ (u − C q̇ − g − f), (2,), rad/s²; errors as in `Manipulator`.

        One state without friction is summed in plain floats, and M solved by Cramer's rule: for two
        joints NumPy's calls would cost ten times the arithmetic. All else goes the general way: what
        is near a singular M or not finite, to be judged there, and an arm whose M, C, g, f or
        bias is another than this class's, from wherever it came.
        """
        cls = type(self)
        own = self.__dict__
        try:
            a, b, k, G1, G2, least = own["_lumped"]
            if (
                q.dtype is qd.dtype is u.dtype is FLOAT  # type: ignore[union-attr]  # tried, below
                and cls.g_vec is _G
                and cls.f_vec is _F
                and cls.C is _C
                and cls.M is _M
                and cls.bias is _B
                and (len(own) == PLAIN or TERMS.isdisjoint(own))
            ):
                q1, q2 = q.tolist()  # type: ignore[union-attr]
                qd1, qd2 = qd.tolist()  # type: ignore[union-attr]
                u1, u2 = u.tolist()  # type: ignore[union-attr]
                coupling, minus_h, g2 = k * cos(q2), k * sin(q2), G2 * cos(q1 + q2)
                det = a * b - coupling * coupling
                if det > least:
                    M12 = b + coupling
                    rest1 = u1 + minus_h * qd2 * (qd1 + qd1 + qd2) - G1 * cos(q1) - g2
                    rest2 = u2 - minus_h * qd1 * qd1 - g2
                    qdd1 = (b * rest1 - M12 * rest2) / det
                    qdd2 = ((a + M12 + coupling) * rest2 - M12 * rest1) / det
                    if qdd1 - qdd1 == qdd2 - qdd2:  # both finite
                        qdd = empty(2)  # quicker to fill than np.array is to read a list
                        qdd[0], qdd[1] = qdd1, qdd2
                        return qdd
        except KeyError:
            _ = self._lumped  # kept from now on
            return Planar2R.dynamics(self, q, qd, u)
        except (AttributeError, TypeError, ValueError):
            pass  # not arrays of numbers: the general way says what is wrong with them
        return super().dynamics(q, qd, u)

    @cached_property
    def _lumped(self) -> tuple[float, ...]:
        """M11 = a + b + 2 k cos q2, M12 = b + k cos q2, M22 = b, g1 = G1 cos q1 + g2, g2 = G2 cos q12.

        Last the determinant a b − (k cos q2)² below which it has lost too many digits; no
        determinant is above that where there is friction, or a parameter that is computed anew.
        """
        a = self.I1 + self.m1 * self.lc1**2 + self.m2 * self.l1**2
        b = self.I2 + self.m2 * self.lc2**2
        k = self.m2 * self.l1 * self.lc2
        G1, G2 = (self.m1 * self.lc1 + self.m2 * self.l1) * self.g, self.m2 * self.lc2 * self.g
        computed = any(
            hasattr(getattr_static(type(self), p.name, None), "__get__") for p in fields(self)
        )
        plain = not computed and not any(self.viscous + self.coulomb)
        return a, b, k, G1, G2, 1e-3 * a * b if plain else inf

    def potential_energy(self, q: ArrayLike) -> np.ndarray:
        """Zero with both centres of mass at the height of joint 1, J."""
        q = state_vector("q", q, 2)
        q1, q12 = q[..., 0], q[..., 0] + q[..., 1]
        height1 = self.lc1 * np.sin(q1)
        height2 = self.l1 * np.sin(q1) + self.lc2 * np.sin(q12)
        return self.g * (self.m1 * height1 + self.m2 * height2)


# What `dynamics` writes out in closed form, and the number of entries of an arm that has no others.
_M, _C, _G, _F, _B = Planar2R.M, Planar2R.C, Planar2R.g_vec, Planar2R.f_vec, Planar2R.bias
FLOAT = np.dtype(float)
PLAIN = len(fields(Planar2R)) + 1  # and what is lumped


def as_written(arm: Planar2R) -> bool:
    """Whether M, C, g, f and bias are those of Planar2R, and its parameters say all of it."""
    cls = type(arm)
    terms = cls.M, cls.C, cls.g_vec, cls.f_vec, cls.bias
    return terms == (_M, _C, _G, _F, _B) and TERMS.isdisjoint(vars(arm))


def _matrix(a11, a12, a21, a22) -> np.ndarray:
    """Entries of shape (...) as a (..., 2, 2) array."""
    matrices = np.empty((*np.broadcast(a11, a12, a21, a22).shape, 2, 2))
    matrices[..., 0, 0], matrices[..., 0, 1] = a11, a12
    matrices[..., 1, 0], matrices[..., 1, 1] = a21, a22
    return matrices
