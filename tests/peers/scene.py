"""Bodies in space, as SymPy's mechanics has them: their equations by Lagrange's and by Kane's method."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import sympy as sp
from sympy.physics.mechanics import (
    KanesMethod,
    LagrangesMethod,
    Particle,
    Point,
    ReferenceFrame,
    RigidBody,
    dynamicsymbols,
    inertia,
    kinetic_energy,
)

Equations = tuple[sp.Matrix, sp.Matrix]


@dataclass
class Scene:
    """Bodies in the inertial frame N, placed by coordinates q(t); gravity g pulls along −up.

    springs: the energy of each, and its loads on points and frames. tied: coordinates beyond q, which
    constraints, expressions that are 0, tie to q. closing(q, qd, arm): their numbers and their rates'.
    """

    names: tuple[str, ...]
    g: sp.Expr
    up: tuple = (0, 1, 0)
    tied: tuple[str, ...] = ()
    closing: Callable = lambda q, qd, arm: ((), ())
    bodies: list = field(default_factory=list)
    springs: list = field(default_factory=list)
    constraints: list = field(default_factory=list)

    def __post_init__(self):
        self.N, self.origin = ReferenceFrame("N"), Point("O")
        self.origin.set_vel(self.N, 0)
        self.q = [dynamicsymbols(name) for name in (*self.names, *self.tied)]
        self.rates = [x.diff() for x in self.q]
        self.upwards = sum((x * e for x, e in zip(self.up, self.N, strict=True)), 0 * self.N.x)

    def point(self, base: Point, way) -> Point:
        """A point this way from another; its velocity is the derivative of its place."""
        point = base.locatenew(f"P{len(self.bodies)}", way)
        point.set_vel(self.N, point.pos_from(self.origin).dt(self.N))
        return point

    def body(self, com: Point, frame, mass, spin, about: Point | None = None) -> None:
        """spin: inertias about the frame's axes through `about`, by default the centre of mass."""
        where = (inertia(frame, *spin), about or com)
        self.bodies.append(RigidBody(f"body{len(self.bodies)}", com, frame, mass, where))

    def particle(self, at: Point, mass) -> None:
        self.bodies.append(Particle(f"body{len(self.bodies)}", at, mass))

    @property
    def potential(self) -> sp.Expr:
        heights = [b.masscenter.pos_from(self.origin).dot(self.upwards) for b in self.bodies]
        weights = [b.mass * self.g * h for b, h in zip(self.bodies, heights, strict=True)]
        return sp.Add(*weights, *(energy for energy, _ in self.springs))

    def by_lagrange(self) -> Equations:
        """A, b of A x = b, from the energies of the bodies; x begins with q̈."""
        energy = kinetic_energy(self.N, *self.bodies) - self.potential
        method = LagrangesMethod(energy, self.q, hol_coneqs=self.constraints or None)
        method.form_lagranges_equations()
        if not self.tied:
            return method.mass_matrix, method.forcing
        n = len(self.q)  # before these rows are those of q̇ = q̇
        return method.mass_matrix_full[n:, n:], method.forcing_full[n:, :]

    def by_kane(self) -> Equations:
        """The same, from the forces on the bodies and their partial velocities."""
        loads = [(body.masscenter, -body.mass * self.g * self.upwards) for body in self.bodies]
        loads += [load for _, of_one in self.springs for load in of_one]
        speeds = [dynamicsymbols(f"u{k}") for k in range(len(self.q))]
        known, n = dict(zip(self.rates, speeds, strict=True)), len(self.names)
        tied = {
            "q_dependent": self.q[n:],
            "u_dependent": speeds[n:],
            "configuration_constraints": self.constraints,
            "velocity_constraints": [
                c.diff(dynamicsymbols._t).subs(known) for c in self.constraints
            ],
        }
        equal = [rate - u for rate, u in known.items()]
        method = KanesMethod(self.N, self.q[:n], speeds[:n], equal, **(tied if self.tied else {}))
        method.kanes_equations(self.bodies, loads)
        back = dict(zip(speeds, self.rates, strict=True))
        return method.mass_matrix.subs(back), method.forcing.subs(back)

    def compiled(self, expressions, parameters: dict[str, sp.Symbol]) -> Callable:
        """The expressions as a function of q (n,), q̇ (n,) and an arm: arrays."""
        plain = [sp.Dummy() for _ in (*self.rates, *self.q)]
        known = dict(zip((*self.rates, *self.q), plain, strict=True))
        flat = [sp.sympify(e).subs(known) for e in expressions]
        compute = sp.lambdify([plain, list(parameters.values())], flat, modules="numpy", cse=True)

        def numbers(q, qd, arm):
            places, rates = self.closing(q, qd, arm)
            values = [*qd, *rates, *q, *places]
            found = compute(values, [getattr(arm, name) for name in parameters])
            return [np.array(value, dtype=float) for value in found]

        return numbers


def solved_for(n: int, A: np.ndarray, b: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """M and C q̇ + g of the first n coordinates, the other unknowns of A x = b eliminated."""
    b = np.ravel(b)
    others = A[:n, n:] @ np.linalg.inv(A[n:, n:])
    return A[:n, :n] - others @ A[n:, :n], others @ b[n:] - b[:n]
