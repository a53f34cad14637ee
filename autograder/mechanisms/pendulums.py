"""Pendulums: one in a plane, one that swings in space, and one on a turning arm (Furuta)."""

import math

import sympy as sp

from autograder.mechanisms.friction import joint_friction
from autograder.mechanisms.mechanism import EnergyTerm, Mechanism
from autograder.mechanisms.outline import Coordinate, Parameter
from autograder.mechanisms.shapes import Ground, Link, rod
from autograder.mechanisms.shapes import arm as links

G = Parameter("g", "m/s²", "gravitational acceleration", 3.0, 15.0)


def _pendulum() -> Mechanism:
    q = Coordinate("q", "rad", "the body hanging down")
    m = Parameter("m", "kg", "mass of the body", 0.5, 3.0)
    lc = Parameter("lc", "m", "pivot to the centre of mass", 0.2, 0.9, to_find=True)
    I = Parameter("I", "kg·m²", "inertia about the pivot", 0.2, 2.0)
    weight = m.symbol * G.symbol * lc.symbol
    return Mechanism(
        "pendulum",
        (q,),
        (m, lc, I, G),
        (EnergyTerm("the rotation of the body", I.symbol * q.velocity**2 / 2),),
        (EnergyTerm("the weight of the body", weight * (1 - sp.cos(q.symbol))),),
        lambda at, arm: [(0.0, 0.0), (arm.lc * math.sin(at[0]), -arm.lc * math.cos(at[0]))],
        joint_friction((q, "the pivot")),
        _drawn,
    )


def _drawn(at, arm):
    pivot, centre = (0.0, 0.0), (arm.lc * math.sin(at[0]), -arm.lc * math.cos(at[0]))
    # I about the pivot may be drawn smaller than any body's with this m and lc: then a point mass.
    spread = math.sqrt(max(arm.I / (arm.m * arm.lc**2) - 1, 0.0))
    return [Ground(pivot, above=True), *rod(pivot, centre, spread)]


def _spherical() -> Mechanism:
    """A bob on a rigid rod without mass. Goldstein, Poole & Safko 2002, Classical Mechanics, ch. 1."""
    theta = Coordinate("theta", "rad", "the rod hanging down")
    phi = Coordinate("phi", "rad", "the rod above the x axis")
    m = Parameter("m", "kg", "mass of the bob", 0.5, 3.0)
    l = Parameter("l", "m", "length of the rod", 0.4, 1.2)
    size = m.symbol * l.symbol**2 / 2
    return Mechanism(
        "spherical-pendulum",
        (theta, phi),
        (m, l, G),
        (
            EnergyTerm("the swing of the bob", size * theta.velocity**2),
            EnergyTerm(
                "the turn of the bob about the vertical",
                size * sp.sin(theta.symbol) ** 2 * phi.velocity**2,
            ),
        ),
        (
            EnergyTerm(
                "the weight of the bob", -m.symbol * G.symbol * l.symbol * sp.cos(theta.symbol)
            ),
        ),
        lambda at, arm: [(0.0, 0.0), (arm.l * math.sin(at[0]), -arm.l * math.cos(at[0]))],
        draws=_spherical_drawn,
    )


def _furuta() -> Mechanism:
    """B. S. Cazzolato, Z. Prime (2011), On the Dynamics of the Furuta Pendulum, for slender links."""
    q1 = Coordinate("q1", "rad", "the arm along the x axis")
    q2 = Coordinate("q2", "rad", "the pendulum hanging down")
    J1 = Parameter("J1", "kg·m²", "inertia of the arm about its vertical axis", 0.2, 1.0)
    l1 = Parameter("l1", "m", "length of the arm", 0.4, 1.0)
    m2 = Parameter("m2", "kg", "mass of the pendulum", 0.5, 2.0)
    lc2 = Parameter(
        "lc2", "m", "pivot of the pendulum to its centre of mass", 0.15, 0.5, to_find=True
    )
    I2 = Parameter("I2", "kg·m²", "inertia of the pendulum about its centre of mass", 0.05, 0.4)
    (w1, w2), m, l, c, I = (q1.velocity, q2.velocity), m2.symbol, l1.symbol, lc2.symbol, I2.symbol
    sine = sp.sin(q2.symbol)
    return Mechanism(
        "furuta",
        (q1, q2),
        (J1, l1, m2, lc2, I2, G),
        (
            EnergyTerm("the rotation of the arm", J1.symbol * w1**2 / 2),
            EnergyTerm("the mass of the pendulum at its pivot", m * l**2 * w1**2 / 2),
            EnergyTerm("the rotation of the pendulum about its pivot", I * w2**2 / 2),
            EnergyTerm("the centre of mass of the pendulum about its pivot", m * c**2 * w2**2 / 2),
            EnergyTerm("the rotation of the pendulum about the vertical", I * sine**2 * w1**2 / 2),
            EnergyTerm(
                "the centre of mass of the pendulum about the vertical",
                m * c**2 * sine**2 * w1**2 / 2,
            ),
            EnergyTerm("the coupling of arm and pendulum", m * l * c * sp.cos(q2.symbol) * w1 * w2),
        ),
        (EnergyTerm("the weight of the pendulum", -m * G.symbol * c * sp.cos(q2.symbol)),),
        lambda at, arm: [(0.0, 0.0), (arm.lc2 * math.sin(at[1]), -arm.lc2 * math.cos(at[1]))],
        joint_friction((q1, "the arm"), (q2, "the pivot")),
        _furuta_drawn,
    )


def _seen(x: float, y: float, z: float) -> tuple[float, float]:
    """A place in space as it is drawn, the y axis aslant."""
    return x + 0.4 * y, z + 0.25 * y


def _furuta_drawn(at, arm):
    x, y = arm.l1 * math.cos(at[0]), arm.l1 * math.sin(at[0])
    swing = arm.lc2 * math.sin(at[1])
    end = x - swing * math.sin(at[0]), y + swing * math.cos(at[0]), -arm.lc2 * math.cos(at[1])
    joint, centre = _seen(x, y, 0.0), _seen(*end)
    pendulum = rod(joint, centre, math.sqrt(arm.I2 / arm.m2) / arm.lc2)
    return [Ground((0.0, 0.0)), Link((0.0, 0.0), joint), *pendulum]


def _spherical_drawn(at, arm):
    out = arm.l * math.sin(at[0])
    bob = _seen(out * math.cos(at[1]), out * math.sin(at[1]), -arm.l * math.cos(at[0]))
    return links([(0.0, 0.0), bob])


PENDULUM = _pendulum()
SPHERICAL = _spherical()
FURUTA = _furuta()
