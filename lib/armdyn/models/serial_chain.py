"""A spatial arm of revolute and prismatic joints, one after the other."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import ArrayLike

from armdyn.friction import joint_friction
from armdyn.manipulator import Manipulator, own_term
from armdyn.models.dh import Convention, dh_links
from armdyn.models.link import Link
from armdyn.models.recursive import (
    Bodies,
    articulated_acceleration,
    composite_inertia,
    newton_euler,
)
from armdyn.models.screws import screw_links
from armdyn.parameters import finite, per_joint, state_vector, state_vectors
from armdyn.spatial import (
    force_cross,
    motion_cross,
    motion_transform,
    rigid_inertia,
    rotation,
    swapped_cross,
)

if TYPE_CHECKING:
    from armdyn.derive import Derivation

# What the algorithms on the links compute by themselves; friction they take as the arm says it.
MOTION = ("M", "C", "g_vec", "bias")


@dataclass(frozen=True)
class SerialChain(Manipulator):
    """n links, each carried by the one before, the first by the base.

    `from_dh` makes a chain from Denavit–Hartenberg parameters, `from_screws` from screw axes, and
    `urdf.read_urdf` from a file.

    q holds the joints' angles (rad) and displacements (m); M, C, g and u have the units that go
    with them, N·m for a revolute and N for a prismatic joint.

    Velocities and forces are 6-vectors, angular part first, in the coordinates of the link they
    belong to: see `armdyn.spatial`. M, C and g come from the links' Jacobians, as they are defined;
    `rnea`, `crba` and `aba` are the recursive algorithms, which need no Jacobians.

    `armature` adds to M's diagonal, and so to all that follows from M, but not to C and g. The motors'
    masses belong to the links that carry them.

    Raises ValueError, naming the argument, for one that is not as described. Masses and inertias may
    be zero, and M(q) may then be singular: see `Manipulator.dynamics`.
    """

    links: tuple[Link, ...] = field(metadata={"doc": "from the base to the tip"})
    gravity: tuple[float, ...] = field(
        default=(0.0, 0.0, -9.81),
        metadata={"unit": "m/s²", "doc": "(3,), gravitational acceleration in the base's frame"},
    )
    viscous: tuple[float, ...] | None = field(
        default=None,
        metadata={"unit": "N·m·s/rad or N·s/m", "doc": "viscous friction of each joint"},
    )
    coulomb: tuple[float, ...] | None = field(
        default=None, metadata={"unit": "N·m or N", "doc": "Coulomb friction of each joint"}
    )
    armature: tuple[float, ...] | None = field(
        default=None,
        metadata={
            "unit": "kg·m² or kg",
            "doc": "inertia of each joint's motor as the joint feels it: see `reflected_inertia`",
        },
    )

    def __post_init__(self):
        links = tuple(self.links) if isinstance(self.links, Sequence) else ()
        if not links:
            raise ValueError(f"links = {self.links!r}: needs one Link or more")
        for k, link in enumerate(links):
            if not isinstance(link, Link):
                raise ValueError(f"links[{k}] = {link!r}: needs a Link")
        gravity = state_vector("gravity", self.gravity, 3)
        if gravity.ndim != 1:
            raise ValueError(f"gravity: got shape {gravity.shape}, needs (3,)")
        kept = {
            "links": links,
            "gravity": tuple(finite(f"gravity[{i}]", g, "m/s²") for i, g in enumerate(gravity)),
        }
        for name in ("viscous", "coulomb", "armature"):
            value = getattr(self, name)
            zero = (0.0,) * len(links)
            unit = self.__dataclass_fields__[name].metadata["unit"]
            kept[name] = zero if value is None else per_joint(name, value, len(links), unit)
        # Floats and tuples whatever came, so that arms compare and hash by their numbers.
        for name, value in kept.items():
            object.__setattr__(self, name, value)

    @classmethod
    def from_dh(
        cls,
        a: ArrayLike,
        alpha: ArrayLike,
        d: ArrayLike,
        theta: ArrayLike,
        mass: ArrayLike,
        com: ArrayLike | None = None,
        inertia: ArrayLike | None = None,
        *,
        joints: str | Sequence[str] | None = None,
        convention: Convention = "standard",
        triangle: Literal["error", "warn"] = "error",
        **more,
    ) -> "SerialChain":
        """A chain by its Denavit–Hartenberg parameters, one of each per joint.

        a: (n,), m. alpha: (n,), rad. d: (n,), m. theta: (n,), rad. joints: n of "revolute" (as all
        are if it is not given) and "prismatic"; q adds to theta of a revolute joint and to d of a
        prismatic one.
        mass: (n,), kg. com: (n, 3), m, in the links' Denavit–Hartenberg frames. inertia: (n, 3, 3),
        kg·m², about the centre of mass, along the axes of these frames. Where they are not given,
        they are 0.
        convention: "standard", frame k at the far end of link k: Rz(θ) Tz(d) Tx(a) Rx(α) leads from
        frame k − 1 to frame k. "modified", frame k on the axis of joint k: Rx(α) Tx(a) Rz(θ) Tz(d).
        triangle: as for `Link`. more: gravity, viscous, coulomb, armature, as for `SerialChain`.

        The Links have the modified frames, or in the standard convention frames on the axes of their
        joints: there, `link_placements`, `link_jacobians` and the parameters π refer to those.

        Raises ValueError, naming the argument, for one that is not as described.

        Source: J. Denavit, R. S. Hartenberg (1955), A Kinematic Notation for Lower-Pair Mechanisms
        Based on Matrices, Journal of Applied Mechanics 22; J. J. Craig (1986), Introduction to
        Robotics, chapter 3, for the modified convention.
        """
        links = dh_links(a, alpha, d, theta, mass, com, inertia, joints, convention, triangle)
        return cls(links, **more)

    @classmethod
    def from_screws(
        cls,
        screws: ArrayLike,
        homes: ArrayLike,
        inertias: ArrayLike,
        *,
        triangle: Literal["error", "warn"] = "error",
        **more,
    ) -> "SerialChain":
        """A chain by its joints' screw axes, the product of exponentials.

        screws: (n, 6), a row [ω; v] per joint, in the base's frame at q = 0: ω of length 1, rad/rad,
        and v = −ω × r, m, with r on the axis; or ω = 0 and v of length 1 for a prismatic joint.
        homes: (n, 4, 4), of the links' frames in the base's at q = 0. inertias: (n, 6, 6), spatial
        inertia of each link about its frame, [ω; v] to momentum, as `spatial.rigid_inertia` gives it.
        triangle: as for `Link`. more: gravity, viscous, coulomb, armature, as for `SerialChain`.

        In Modern Robotics' notation these are Slist transposed, the M_i (the products of Mlist) and
        Glist. The Links have frames along those of `homes`, with their origins moved onto the axes of
        revolute joints.

        Raises ValueError, naming the argument, for one that is not as described; a screw with a
        pitch is no joint of a SerialChain.

        Source: K. M. Lynch, F. C. Park (2017), Modern Robotics, sections 4.1 and 8.3.
        """
        return cls(screw_links(screws, homes, inertias, triangle), **more)

    @property
    def n(self) -> int:  # type: ignore[override]  # read only here, and nobody writes it
        return len(self.links)

    def M(self, q: ArrayLike) -> np.ndarray:
        """Σ_k J_kᵀ I_k J_k over the links, and the armature on the diagonal, (n, n)."""
        q = state_vector("q", q, self.n)
        M = np.zeros((*q.shape, self.n))
        for I, J in zip(self._inertias, self._jacobians(self._transforms(q)), strict=True):
            M += np.swapaxes(J, -1, -2) @ I @ J
        return (M + np.swapaxes(M, -1, -2)) / 2 + np.diag(np.array(self.armature))

    def C(self, q: ArrayLike, qd: ArrayLike) -> np.ndarray:
        """Christoffel form, (n, n): Σ_k J_kᵀ (I_k J̇_k + B_k J_k) over the links.

        J̇_k is the rate of the Jacobian's entries in the link's own coordinates, and
        B = ½ (v×* I + I v× + (I v)×̄*) is skew-symmetric with B v = v×* I v, so that Ṁ = C + Cᵀ.

        Source: S. Echeandia, P. M. Wensing (2021), Numerical Methods to Compute the Coriolis Matrix
        and Christoffel Symbols for Rigid-Body Systems, Journal of Computational and Nonlinear
        Dynamics 16(9), for B.
        """
        q, qd = state_vectors(self.n, q=q, qd=qd)
        C = np.zeros((*np.broadcast_shapes(q.shape, qd.shape), self.n))
        transforms = self._transforms(q)
        J_dot = np.zeros((*qd.shape[:-1], 6, self.n))
        before = np.zeros((6, self.n))
        for k, (I, J) in enumerate(zip(self._inertias, self._jacobians(transforms), strict=True)):
            carried = transforms[k] @ before
            turn = motion_cross(self._screws[k] * qd[..., k : k + 1])
            J_dot = transforms[k] @ J_dot - turn @ carried
            v = np.matvec(J, qd)
            B = (force_cross(v) @ I + I @ motion_cross(v) + swapped_cross(np.matvec(I, v))) / 2
            C += np.swapaxes(J, -1, -2) @ (I @ J_dot + B @ J)
            before = J
        return C

    def g_vec(self, q: ArrayLike) -> np.ndarray:
        """−Σ_k J_kᵀ I_k [0; g⃗] over the links, with g⃗ in the link's coordinates, (n,)."""
        q = state_vector("q", q, self.n)
        transforms = self._transforms(q)
        pull = np.array([0.0, 0.0, 0.0, *self.gravity])
        result = np.zeros(q.shape)
        for X, I, J in zip(transforms, self._inertias, self._jacobians(transforms), strict=True):
            pull = np.matvec(X, pull)
            result -= np.vecmat(np.matvec(I, pull), J)
        return result

    def f_vec(self, qd: ArrayLike) -> np.ndarray:
        """Viscous and Coulomb friction of each joint, (n,)."""
        return joint_friction(state_vector("qd", qd, self.n), self.viscous, self.coulomb)

    def potential_energy(self, q: ArrayLike) -> np.ndarray:
        """−Σ_k m_k g⃗ᵀ p_k with p_k the centre of mass: zero with all of them at the base, J."""
        R, p = self.link_placements(q)
        com = p + np.matvec(R, np.array([link.com for link in self.links]))
        mass = np.array([link.mass for link in self.links])
        return -np.matvec(com, np.array(self.gravity)) @ mass

    def link_placements(self, q: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        """Of each link's frame in the base's: rotation (n, 3, 3), and origin (n, 3), m."""
        q = state_vector("q", q, self.n)
        turns, origins = [], []
        R, p = np.eye(3), np.zeros(3)
        for k in range(self.n):
            R_k, p_k = self._placement(k, q[..., k])
            R, p = R @ R_k, p + np.matvec(R, p_k)
            turns.append(R)
            origins.append(np.broadcast_to(p, (*q.shape[:-1], 3)))
        return np.stack(turns, axis=-3), np.stack(origins, axis=-2)

    def link_jacobians(self, q: ArrayLike) -> np.ndarray:
        """J_k of each link, (n, 6, n): J_k q̇ = [ω; v] of link k at its frame, in its coordinates."""
        q = state_vector("q", q, self.n)
        return np.stack(list(self._jacobians(self._transforms(q))), axis=-3)

    def link_inertias(self) -> np.ndarray:
        """Spatial inertia of each link about its frame, (n, 6, 6): of M = Σ_k J_kᵀ I_k J_k.

        Without the armature, which belongs to no link.
        """
        return self._inertias.copy()

    def rnea(self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike) -> np.ndarray:
        """u = M q̈ + C q̇ + g + f, (n,), in a number of operations proportional to n.

        The recursive Newton–Euler algorithm. Source: J. Y. S. Luh, M. W. Walker, R. P. C. Paul
        (1980), On-Line Computational Scheme for Mechanical Manipulators, Journal of Dynamic Systems,
        Measurement, and Control 102(2). Raises ValueError for a subclass with another M, C, g_vec or
        bias than that of its links.
        """
        self._of_the_links("rnea", MOTION, "inverse_dynamics")
        q, qd, qdd = state_vectors(self.n, q=q, qd=qd, qdd=qdd)
        friction = self.f_vec(qd) + np.zeros(np.broadcast_shapes(q.shape, qd.shape, qdd.shape))
        return newton_euler(self._bodies(q), qd, qdd, friction)

    def crba(self, q: ArrayLike) -> np.ndarray:
        """M, (n, n), from the inertias of the links from k outwards taken as one body.

        The composite-rigid-body algorithm. Source: R. Featherstone (2008), Rigid Body Dynamics
        Algorithms, section 6.2. Raises ValueError for a subclass with another M.
        """
        self._of_the_links("crba", ("M",), "M")
        q = state_vector("q", q, self.n)
        return composite_inertia(self._bodies(q), q.shape[:-1])

    def aba(self, q: ArrayLike, qd: ArrayLike, u: ArrayLike) -> np.ndarray:
        """q̈ = M⁻¹ (u − C q̇ − g − f), (n,), in a number of operations proportional to n.

        The articulated-body algorithm. Raises numpy.linalg.LinAlgError, naming the joint, where
        the links from that joint outwards and its motor put up no resistance to its motion, to
        rounding; ValueError for a subclass with another M, C, g_vec or bias than that of its links.

        Source: R. Featherstone (1983), The Calculation of Robot Dynamics Using Articulated-Body
        Inertias, International Journal of Robotics Research 2(1); for motors, R. Featherstone
        (2008), Rigid Body Dynamics Algorithms, chapter 9.
        """
        self._of_the_links("aba", MOTION, "dynamics")
        q, qd, u = state_vectors(self.n, q=q, qd=qd, u=u)
        effort = u - self.f_vec(qd) + np.zeros(np.broadcast_shapes(q.shape, qd.shape, u.shape))
        return articulated_acceleration(self._bodies(q), qd, effort)

    def _of_the_links(self, what: str, terms: tuple[str, ...], instead: str) -> None:
        """Refuses a class with terms that the algorithms on the links know nothing of."""
        if term := own_term(self, SerialChain, terms):
            raise ValueError(
                f"{what} is of the links; this {type(self).__name__} has another {term}: use {instead}"
            )

    def _bodies(self, q: np.ndarray) -> Bodies:
        return Bodies(
            self._transforms(q),
            self._inertias,
            self._screws,
            np.array(self.armature),
            np.array(self.gravity),
            tuple(link.joint == "revolute" for link in self.links),
        )

    def derivation(self, inertial_symbols: bool = False, tolerance: float = 1e-9) -> "Derivation":
        """M, C, g, P and f in symbols, for `armdyn.codegen`: see `armdyn.derive.serial_chain`.

        Raises ValueError for a subclass with another M, C, g_vec, f_vec, bias or potential_energy
        than that of its links.
        """
        said = (*MOTION, "f_vec", "potential_energy")
        self._of_the_links("derivation", said, "derive.from_energies")
        from armdyn.derive import serial_chain  # the one door from models to derive

        return serial_chain(self, inertial_symbols, tolerance)

    @cached_property
    def _inertias(self) -> np.ndarray:
        return np.stack(
            [rigid_inertia(b.mass, np.array(b.com), np.array(b.inertia)) for b in self.links]
        )

    @cached_property
    def _screws(self) -> np.ndarray:
        """(n, 6): the velocity of each link for q̇ = 1, in its own coordinates."""
        none = (0.0, 0.0, 0.0)
        return np.array(
            [
                (*link.axis, *none) if link.joint == "revolute" else (*none, *link.axis)
                for link in self.links
            ]
        )

    def _placement(self, k, q_k) -> tuple[np.ndarray, np.ndarray]:
        """Of link k's frame in that of the link before: (..., 3, 3) and (..., 3)."""
        link = self.links[k]
        R, p = np.array(link.rotation), np.array(link.translation)
        if link.joint == "revolute":
            return R @ rotation(link.axis, q_k), p
        return np.broadcast_to(R, (*q_k.shape, 3, 3)), p + q_k[..., np.newaxis] * (R @ link.axis)

    def _transforms(self, q) -> list[np.ndarray]:
        """X_k, (..., 6, 6): from the coordinates of the link before to those of link k."""
        placements = (self._placement(k, q[..., k]) for k in range(self.n))
        return [motion_transform(R, np.broadcast_to(p, R.shape[:-1])) for R, p in placements]

    def _jacobians(self, transforms) -> Iterator[np.ndarray]:
        """Link by link, (..., 6, n): a new array each, since the next is made from it."""
        J = np.zeros((6, self.n))
        for k, X in enumerate(transforms):
            J = X @ J
            J[..., k] = self._screws[k]
            yield J
