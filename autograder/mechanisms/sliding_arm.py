"""An arm with one turning and one sliding joint (RP): link 2 slides along link 1."""

import math

import sympy as sp

from autograder.mechanisms.friction import joint_friction
from autograder.mechanisms.mechanism import EnergyTerm, Mechanism
from autograder.mechanisms.outline import Coordinate, Parameter
from autograder.mechanisms.shapes import Ground, Link, Mass, Slide


def _sliding_arm() -> Mechanism:
    q1 = Coordinate("q1", "rad", "the arm along the x axis")
    q2 = Coordinate("q2", "m", "the centre of mass of link 2 at the shoulder")
    lc1 = Parameter("lc1", "m", "shoulder to the centre of mass of link 1", 0.2, 0.6, to_find=True)
    m1 = Parameter("m1", "kg", "mass of link 1", 1.0, 4.0)
    m2 = Parameter("m2", "kg", "mass of link 2", 1.0, 4.0)
    I1 = Parameter("I1", "kg·m²", "inertia of link 1 about its centre of mass", 0.1, 0.6)
    I2 = Parameter("I2", "kg·m²", "inertia of link 2 about its centre of mass", 0.1, 0.6)
    g = Parameter("g", "m/s²", "gravitational acceleration", 3.0, 15.0)
    turn, slide, sine = q1.velocity, q2.velocity, sp.sin(q1.symbol)
    return Mechanism(
        "turn-and-slide",
        (q1, q2),
        (lc1, m1, m2, I1, I2, g),
        (
            EnergyTerm("the rotation of link 1", I1.symbol * turn**2 / 2),
            EnergyTerm("the centre of mass of link 1", m1.symbol * lc1.symbol**2 * turn**2 / 2),
            EnergyTerm("the rotation of link 2", I2.symbol * turn**2 / 2),
            EnergyTerm("the mass of link 2 carried around", m2.symbol * q2.symbol**2 * turn**2 / 2),
            EnergyTerm("the sliding of link 2", m2.symbol * slide**2 / 2),
        ),
        (
            EnergyTerm("the weight of link 1", m1.symbol * g.symbol * lc1.symbol * sine),
            EnergyTerm("the weight of link 2", m2.symbol * g.symbol * q2.symbol * sine),
        ),
        lambda at, arm: [(0.0, 0.0), (at[1] * math.cos(at[0]), at[1] * math.sin(at[0]))],
        joint_friction((q1, "joint 1"), (q2, "joint 2")),
        _drawn,
    )


def _drawn(at, arm):
    """Link 1 as a bar, with link 2 as a sleeve on it and its mass in the sleeve."""
    direction = math.cos(at[0]), math.sin(at[0])
    end, centre = ((x * direction[0], x * direction[1]) for x in (max(0.9, at[1] + 0.2), at[1]))
    return [Ground((0.0, 0.0)), Link((0.0, 0.0), end), Slide((0.0, 0.0), centre), Mass(centre)]


TURN_AND_SLIDE = _sliding_arm()
