"""A planar arm of n revolute links, in closed form."""

import reprlib
from collections.abc import Sequence
from dataclasses import dataclass, field, fields
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from armdyn.friction import joint_friction
from armdyn.manipulator import Manipulator
from armdyn.parameters import finite, nonnegative, positive, state_vector, state_vectors

CHECKS = {"l": positive, "lc": finite, "ly": finite}


@dataclass(frozen=True)
class PlanarChain(Manipulator):
    """n links in a vertical plane, x to the right, y up, gravity along −y.

    q1 is the angle of link 1 from the x axis, each other q that of its link relative to the link
    before. The centre of mass of link k lies at lc[k] along the link from its joint and ly[k] to
    the left of it; I[k] is the inertia about the centre of mass. With n = 2 and ly = 0 this is
    `Planar2R`.

    Raises ValueError, naming the argument and the link, for a parameter that is not finite or not
    physical, or that has not one entry per link. Masses and inertias may be zero, and M(q) may then
    be singular: see `Manipulator.dynamics`.

    With the absolute angles a_k = q1 + … + q_k and the plane as the complex numbers, the centre of
    mass of link k is Σ_i z_ki exp(i a_i), where z_ki is l_i for i < k and lc_k + i ly_k for i = k.
    The kinetic energy is then a sum over pairs of links, in the two constants `_pairs` and
    `_moments`, and q̇ enters it through ȧ, which is linear in q̇ with constant coefficients.
    """

    l: tuple[float, ...] = field(metadata={"unit": "m", "doc": "length of each link"})
    lc: tuple[float, ...] = field(
        metadata={"unit": "m", "doc": "joint to centre of mass, along the link"}
    )
    m: tuple[float, ...] = field(metadata={"unit": "kg", "doc": "mass of each link"})
    I: tuple[float, ...] = field(
        metadata={"unit": "kg·m²", "doc": "inertia of each link about its centre of mass"}
    )
    g: float = field(default=9.81, metadata={"unit": "m/s²", "doc": "gravitational acceleration"})
    ly: tuple[float, ...] | None = field(
        default=None, metadata={"unit": "m", "doc": "centre of mass left of the link; 0 if None"}
    )
    viscous: tuple[float, ...] | None = field(
        default=None, metadata={"unit": "N·m·s/rad", "doc": "viscous friction of each joint"}
    )
    coulomb: tuple[float, ...] | None = field(
        default=None, metadata={"unit": "N·m", "doc": "Coulomb friction of each joint"}
    )

    def __post_init__(self):
        n = _count(self.l)
        for parameter in fields(self):
            name, unit = parameter.name, parameter.metadata["unit"]
            value = getattr(self, name)
            if name == "g":
                value = finite(name, value, unit)
            elif value is None and parameter.default is None:
                value = (0.0,) * n
            else:
                value = _per_link(name, value, n, unit)
            # Floats and tuples whatever came, so that arms compare and hash by their numbers.
            object.__setattr__(self, name, value)

    @property
    def n(self) -> int:  # type: ignore[override]  # read only here, and nobody writes it
        return len(self.l)

    def M(self, q: ArrayLike) -> np.ndarray:
        """(n, n), kg·m²; it does not depend on q1."""
        turn = self._turns(state_vector("q", q, self.n))
        absolute = (self._pairs * turn).real + np.diag(self.I)
        M = _sum_of_later(_sum_of_later(absolute, axis=-2), axis=-1)
        # The sums round differently above and below the diagonal.
        return (M + np.swapaxes(M, -1, -2)) / 2

    def C(self, q: ArrayLike, qd: ArrayLike) -> np.ndarray:
        """Christoffel form, (n, n), kg·m²/s: Σ m Jᵀ J̇, which for a planar chain has that form."""
        q, qd = state_vectors(self.n, q=q, qd=qd)
        ad = np.cumsum(qd, axis=-1)
        absolute = -(self._pairs * self._turns(q)).imag * ad[..., np.newaxis, :]
        return _sum_of_later(_sum_of_later(absolute, axis=-2), axis=-1)

    def g_vec(self, q: ArrayLike) -> np.ndarray:
        """(n,), N·m."""
        a = np.cumsum(state_vector("q", q, self.n), axis=-1)
        return self.g * _sum_of_later((self._moments * np.exp(1j * a)).real, axis=-1)

    def f_vec(self, qd: ArrayLike) -> np.ndarray:
        """Viscous and Coulomb friction of each joint, (n,), N·m."""
        return joint_friction(state_vector("qd", qd, self.n), self.viscous, self.coulomb)

    def potential_energy(self, q: ArrayLike) -> np.ndarray:
        """Zero with all centres of mass at the height of joint 1, J."""
        a = np.cumsum(state_vector("q", q, self.n), axis=-1)
        return self.g * np.sum((self._moments * np.exp(1j * a)).imag, axis=-1)

    @cached_property
    def _shape(self) -> np.ndarray:
        """z_ki, (n, n), m: centre of mass of link k = Σ_i z_ki exp(i a_i)."""
        z = np.tril(np.tile(np.array(self.l, dtype=complex), (self.n, 1)), -1)
        return z + np.diag(np.array(self.lc) + 1j * np.array(self.ly))

    @cached_property
    def _pairs(self) -> np.ndarray:
        """Σ_k m_k conj(z_ki) z_kj, (n, n), kg·m²."""
        return (self._shape.conj().T * self.m) @ self._shape

    @cached_property
    def _moments(self) -> np.ndarray:
        """Σ_k m_k z_ki, (n,), kg·m."""
        return np.array(self.m) @ self._shape

    def _turns(self, q) -> np.ndarray:
        """exp(i (a_j − a_i)), (..., n, n): the turn from link i to link j, in which q1 cancels."""
        relative = q.copy()
        relative[..., 0] = 0.0
        e = np.exp(1j * np.cumsum(relative, axis=-1))
        return e.conj()[..., :, np.newaxis] * e[..., np.newaxis, :]


def _sum_of_later(array, axis) -> np.ndarray:
    """Σ_{k ≥ i} along an axis: joint i moves link i and all later ones."""
    return np.flip(np.cumsum(np.flip(array, axis), axis), axis)


def _count(l) -> int:
    if not _listed(l) or len(l) == 0:
        raise ValueError(f"l = {reprlib.repr(l)}: needs a sequence of link lengths, in m")
    return len(l)


def _per_link(name, value, n, unit) -> tuple[float, ...]:
    if not _listed(value) or np.shape(value)[:1] != (n,):
        raise ValueError(
            f"{name} = {reprlib.repr(value)}: needs {n} numbers, one per entry of l, in {unit}"
        )
    check = CHECKS.get(name, nonnegative)
    return tuple(check(f"{name}[{k}]", entry, unit) for k, entry in enumerate(value))


def _listed(value) -> bool:
    if isinstance(value, np.ndarray):
        return value.ndim > 0
    return isinstance(value, Sequence) and not isinstance(value, str | bytes)
