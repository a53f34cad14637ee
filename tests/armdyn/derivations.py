"""Derivations by several routes, and numbers for their symbols."""

from dataclasses import asdict
from functools import cache

import numpy as np
import sympy as sp
from sympy.physics.mechanics import dynamicsymbols

from armdyn.derive import Link, from_energies, from_lagrangian, from_links, planar_2r, planar_chain


@cache
def cart_pole():
    x, angle = dynamicsymbols("x theta")
    cart, m, l, g = sp.symbols("M m l g", positive=True)
    t = dynamicsymbols._t
    tip = sp.Matrix([x + l * sp.sin(angle), -l * sp.cos(angle)])
    v = tip.diff(t)
    K = cart * x.diff(t) ** 2 / 2 + m * v.dot(v) / 2
    return from_lagrangian(K - m * g * tip[1], [x, angle])


@cache
def revolute_prismatic():
    """A slide on a turning beam, in a vertical plane."""
    m1, m2, lc, I1, I2, g = sp.symbols("m1 m2 lc I1 I2 g", real=True)
    beam = Link("revolute", m1, com=(lc, 0, 0), inertia=sp.diag(0, 0, I1))
    slide = Link("prismatic", m2, axis=(1, 0, 0), inertia=sp.diag(0, 0, I2))
    return from_links([beam, slide], gravity=(0, -g, 0))


@cache
def spherical_pendulum():
    a, b = q = sp.symbols("theta phi", real=True)
    ad, bd = qd = sp.symbols("thetad phid", real=True)
    m, l, g = sp.symbols("m l g", positive=True)
    place = l * sp.Matrix([sp.sin(a) * sp.cos(b), sp.sin(a) * sp.sin(b), -sp.cos(a)])
    v = place.diff(a) * ad + place.diff(b) * bd
    return from_energies(m * v.dot(v) / 2, m * g * place[2], q, qd)


@cache
def arm_with_payload():
    """The 2R of links, with a point mass at its tip that is a third, fixed body."""
    arm = planar_2r()
    q, qd = arm.q, arm.qd
    l1, l2, load, g = (sp.Symbol(name, real=True) for name in ("l1", "l2", "load", "g"))
    tip = sp.Matrix([f(q[0]) * l1 + f(q[0] + q[1]) * l2 for f in (sp.cos, sp.sin)])
    v = tip.jacobian(q) * sp.Matrix(qd)
    K = (sp.Matrix(qd).T * arm.M * sp.Matrix(qd))[0] / 2 + load * v.dot(v) / 2
    return from_energies(K, arm.P + load * g * tip[1], q, qd)


EXAMPLES = {
    "cart-pole": cart_pole,
    "revolute-prismatic": revolute_prismatic,
    "spherical pendulum": spherical_pendulum,
    "2R with payload": arm_with_payload,
    "2R": planar_2r,
    "3 links, offsets": lambda: planar_chain(3, offsets=True),
}


def with_friction(derivation):
    """Viscous and Coulomb friction at each joint, under the names of Planar2R."""
    n = derivation.n
    return derivation.with_friction(
        *(sp.symbols(f"{kind}1:{n + 1}") for kind in ("viscous", "coulomb"))
    )


def hiding():
    """Where a state may be infinite and q̈ is not: in a sign, a minimum, a condition."""
    q, qd = sp.symbols("q qd", real=True)
    P = sp.Piecewise((q, q < 1), (1 + sp.tanh(q), True)) + sp.Min(q, 2)
    return from_energies(qd**2 / 2, P, [q], [qd]).with_friction(coulomb=[2])


def parameters(arm):
    """The numbers of a Planar2R for with_friction(planar_2r())."""
    numbers = asdict(arm)
    for kind in ("viscous", "coulomb"):
        numbers |= {f"{kind}{i}": value for i, value in enumerate(numbers.pop(kind), 1)}
    return numbers


def values(derivation, seed=0):
    rng = np.random.default_rng(seed)
    return {p.name: float(rng.uniform(0.5, 2)) for p in derivation.parameters}


def states(n, batch=(), parts=3, seed=1):
    # Away from θ = 0, where the spherical pendulum's M is singular.
    q = np.random.default_rng(seed).uniform(0.3, 1.2, (*batch, n))
    others = np.random.default_rng(seed + 1).normal(size=(parts - 1, *batch, n))
    return q, *others


def numbers(expression, derivation, given, q, qd):
    """The expression at one state, in SymPy's own evaluation to 30 digits."""
    place = {p: sp.Float(given[p.name], 30) for p in derivation.parameters}
    place |= {s: sp.Float(float(x), 30) for s, x in zip(derivation.q, q, strict=True)}
    place |= {s: sp.Float(float(x), 30) for s, x in zip(derivation.qd, qd, strict=True)}
    return np.array(sp.Matrix(expression).evalf(30, subs=place).tolist(), dtype=float)
