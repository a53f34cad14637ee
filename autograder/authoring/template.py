"""The file of a mechanism to fill in: a block on a spring, and at each line what belongs there."""

TEXT = '''\
"""A mechanism of my own. Change every line below to yours, from the top down."""

import sympy as sp

from autograder.mechanisms import Coordinate, EnergyTerm, Mechanism, Parameter

# Coordinates, one line each: name, unit (rad or m), and where it is zero, as students read it.
x = Coordinate("x", "m", "the spring loose, positive to the right")

# Parameters, one line each: name, unit, what it is, and the range that checks draw it from (low, high).
# Choose ranges in which no term of the energies is small beside the others.
m = Parameter("m", "kg", "mass of the block", 0.5, 3.0)
k = Parameter("k", "N/m", "stiffness of the spring", 5.0, 40.0)

# The kinetic energy in J, as a sum of terms. Write m.symbol for a parameter, x.symbol for a coordinate,
# x.velocity for its velocity, and sp.sin, sp.cos, sp.sqrt for functions.
# Each name ends the sentence "Your M lacks ...", as "the rotation of link 2".
KINETIC = (
    EnergyTerm("the motion of the block", m.symbol * x.velocity**2 / 2),
)

# The potential energy in J: weights (height times mass times gravity) and springs. It may be empty: ().
POTENTIAL = (
    EnergyTerm("the spring", k.symbol * x.symbol**2 / 2),
)


# What is drawn, in m: one (x, y) after the other. q[0] is the first coordinate, arm.m the number of m.
# For an angle, write sp.sin(q[1]) and so on.
def points(q, arm):
    return [(0.0, 0.0), (q[0], 0.0)]


MECHANISM = Mechanism(
    name="NAME",
    coordinates=(x,),
    parameters=(m, k),
    kinetic=KINETIC,
    potential=POTENTIAL,
    points=points,
)
'''


def template(name: str) -> str:
    """The text of the file for a mechanism of this name. It runs as it stands."""
    return TEXT.replace("NAME", name)
