"""A slider-crank: one joint, and yet C is not zero, as M changes with the crank's angle."""

import math

import sympy as sp

from autograder.mechanisms.friction import joint_friction
from autograder.mechanisms.mechanism import EnergyTerm, Mechanism
from autograder.mechanisms.outline import Coordinate, Parameter
from autograder.mechanisms.shapes import Cart, Ground, Link, Rail


def _slider_crank() -> Mechanism:
    """Crank and slider have mass, the rod between them has none. The slider moves on a level line."""
    q = Coordinate("q", "rad", "the crank along the x axis, towards the slider")
    r = Parameter("r", "m", "length of the crank", 0.2, 0.4)
    l = Parameter("l", "m", "length of the rod", 0.8, 1.4)
    J = Parameter("J", "kg·m²", "inertia of the crank about its axis", 0.1, 0.6)
    mc = Parameter("mc", "kg", "mass of the crank", 1.0, 4.0)
    lc = Parameter("lc", "m", "axis to the centre of mass of the crank", 0.05, 0.15, to_find=True)
    m = Parameter("m", "kg", "mass of the slider", 1.0, 4.0)
    g = Parameter("g", "m/s²", "gravitational acceleration", 3.0, 15.0)
    angle, turn = q.symbol, q.velocity
    reach = sp.sqrt(l.symbol**2 - r.symbol**2 * sp.sin(angle) ** 2)
    slide = (r.symbol * sp.cos(angle) + reach).diff(angle) * turn

    def points(at, arm):
        pin = arm.r * math.cos(at[0]), arm.r * math.sin(at[0])
        return [(0.0, 0.0), pin, (pin[0] + math.sqrt(arm.l**2 - pin[1] ** 2), 0.0)]

    def draws(at, arm):
        axis, pin, slider = points(at, arm)
        rail = Rail(slider[0] - 0.2, slider[0] + 0.2)
        return [Ground(axis), rail, Cart(slider), Link(axis, pin), Link(pin, slider)]

    return Mechanism(
        "slider-crank",
        (q,),
        (r, l, J, mc, lc, m, g),
        (
            EnergyTerm("the rotation of the crank", J.symbol * turn**2 / 2),
            EnergyTerm("the motion of the slider", m.symbol * slide**2 / 2),
        ),
        (EnergyTerm("the weight of the crank", mc.symbol * g.symbol * lc.symbol * sp.sin(angle)),),
        points,
        joint_friction((q, "the crank")),
        draws,
    )


SLIDER_CRANK = _slider_crank()
