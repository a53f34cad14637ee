"""A pole on a cart, free or held by a spring: the cart rolls on a level rail."""

import math

import sympy as sp

from autograder.mechanisms.friction import joint_friction
from autograder.mechanisms.mechanism import EnergyTerm, Mechanism
from autograder.mechanisms.outline import Coordinate, Parameter
from autograder.mechanisms.shapes import Cart, Rail, Spring, Wall, rod


def _cart(name: str, spring: bool) -> Mechanism:
    """Angles from upright, as in F. L. Lewis, D. M. Dawson, C. T. Abdallah (2004), Robot Manipulator
    Control, chapter 3, for a point mass; here with the pole's inertia.
    """
    x = Coordinate("x", "m", "the cart at the middle of the rail")
    theta = Coordinate("theta", "rad", "the pole upright, positive clockwise")
    mc = Parameter("mc", "kg", "mass of the cart", 1.0, 5.0)
    m = Parameter("m", "kg", "mass of the pole", 0.3, 2.0)
    lc = Parameter("lc", "m", "hinge to the pole's centre of mass", 0.3, 1.0, to_find=True)
    I = Parameter("I", "kg·m²", "inertia of the pole about its centre of mass", 0.05, 0.5)
    g = Parameter("g", "m/s²", "gravitational acceleration", 3.0, 15.0)
    k = Parameter("k", "N/m", "stiffness of the spring", 5.0, 40.0)
    xd, qd, pole = x.velocity, theta.velocity, m.symbol * lc.symbol
    kinetic = (
        EnergyTerm("the motion of the cart", mc.symbol * xd**2 / 2),
        EnergyTerm("the mass of the pole on the cart", m.symbol * xd**2 / 2),
        EnergyTerm("the coupling of cart and pole", pole * sp.cos(theta.symbol) * xd * qd),
        EnergyTerm("the centre of mass of the pole about the hinge", pole * lc.symbol * qd**2 / 2),
        EnergyTerm("the rotation of the pole", I.symbol * qd**2 / 2),
    )
    weight = EnergyTerm("the weight of the pole", pole * g.symbol * sp.cos(theta.symbol))
    energy = EnergyTerm("the spring", k.symbol * x.symbol**2 / 2)

    def points(at, arm):
        return [
            (at[0], 0.0),
            (at[0] + arm.lc * math.sin(at[1]), arm.lc * math.cos(at[1])),
        ]

    def draws(at, arm):
        cart, pole = points(at, arm)
        held = [Wall((-0.8, 0.0)), Spring((-0.8, 0.0), cart)] if spring else []
        return [
            Rail(-0.8, 0.9),
            *held,
            Cart(cart),
            *rod(cart, pole, math.sqrt(arm.I / arm.m) / arm.lc),
        ]

    return Mechanism(
        name,
        (x, theta),
        (mc, m, lc, I, g, k) if spring else (mc, m, lc, I, g),
        kinetic,
        (weight, energy) if spring else (weight,),
        points,
        joint_friction((x, "the cart"), (theta, "the hinge")),
        draws,
    )


CART_POLE = _cart("cart-pole", spring=False)
SPRING_CART = _cart("spring-cart", spring=True)
