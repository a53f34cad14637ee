"""One link behind a joint that gives: q1 turns the link, q2 the motor; a spring is between them."""

import math

import sympy as sp

from autograder.mechanisms.mechanism import EnergyTerm, Mechanism
from autograder.mechanisms.outline import Coordinate, Parameter
from autograder.mechanisms.shapes import Ground, Link, Spring, rod


def _elastic_joint() -> Mechanism:
    """M. W. Spong (1987), Modeling and Control of Elastic Joint Robots, Journal of Dynamic Systems,
    Measurement, and Control 109(4): the motor's energy is that of its own turning alone.
    """
    q1 = Coordinate("q1", "rad", "the link along the x axis")
    q2 = Coordinate("q2", "rad", "the motor where the spring is loose at q1 = 0")
    m = Parameter("m", "kg", "mass of the link", 1.0, 4.0)
    lc = Parameter("lc", "m", "joint to the centre of mass of the link", 0.2, 0.6, to_find=True)
    I = Parameter("I", "kg·m²", "inertia of the link about the joint", 0.3, 1.5)
    J = Parameter("J", "kg·m²", "inertia of the motor, seen through its gear", 0.1, 0.8)
    k = Parameter("k", "N·m/rad", "stiffness of the joint", 5.0, 40.0)
    g = Parameter("g", "m/s²", "gravitational acceleration", 3.0, 15.0)
    return Mechanism(
        "elastic-joint",
        (q1, q2),
        (m, lc, I, J, k, g),
        (
            EnergyTerm("the rotation of the link", I.symbol * q1.velocity**2 / 2),
            EnergyTerm("the rotation of the motor", J.symbol * q2.velocity**2 / 2),
        ),
        (
            EnergyTerm(
                "the weight of the link", m.symbol * g.symbol * lc.symbol * sp.sin(q1.symbol)
            ),
            EnergyTerm("the spring", k.symbol * (q1.symbol - q2.symbol) ** 2 / 2),
        ),
        lambda at, arm: [(0.0, 0.0), (arm.lc * math.cos(at[0]), arm.lc * math.sin(at[0]))],
        draws=_drawn,
    )


def _drawn(at, arm):
    """The motor as a short bar, with the joint's spring between it and the link."""
    (x, y), (u, v) = ((math.cos(angle), math.sin(angle)) for angle in at)
    spread = math.sqrt(max(arm.I / (arm.m * arm.lc**2) - 1, 0.0))
    link = rod((0.0, 0.0), (arm.lc * x, arm.lc * y), spread)
    length = math.hypot(*link[0].end)
    motor, hook = (0.4 * length * u, 0.4 * length * v), (0.5 * length * x, 0.5 * length * y)
    return [Ground((0.0, 0.0)), Spring(motor, hook), Link((0.0, 0.0), motor), *link]


ELASTIC_JOINT = _elastic_joint()
