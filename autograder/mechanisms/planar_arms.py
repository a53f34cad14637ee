"""Planar arms of turning joints: 2R in five conventions, and 3R.

The translation of a link's centre of mass is split into what each link before it contributes, and
what two of them contribute together, so that each part has a name.
"""

import math
from typing import Literal

import numpy as np
import sympy as sp

from autograder.mechanisms.friction import joint_friction
from autograder.mechanisms.mechanism import EnergyTerm, Mechanism
from autograder.mechanisms.outline import Coordinate, Parameter

Angles = Literal["relative", "square", "absolute", "crossed"]
Zero = Literal["level", "hanging"]
PLACES = {1: "the shoulder", 2: "the elbow", 3: "the wrist"}


def planar_arm(
    name: str,
    n: int,
    angles: Angles = "relative",
    zero: Zero = "level",
    beside: bool = False,
    slope: bool = False,
) -> Mechanism:
    """n links with turning joints in a plane, gravity along −y, or at an angle of 30° to it on a slope.

    angles: whether q2, q3, … are measured from the line of the link before, or from the direction at a
    right angle to it (square), to the left; from the axis that q1 is measured from, or from the other
    one (crossed). zero: that axis, x or −y. beside: whether the centres of mass lie off the links'
    axes, by lyᵢ.
    """
    q = [Coordinate(f"q{i}", "rad", _zero(i, angles, zero, slope)) for i in range(1, n + 1)]
    quarter = sp.pi / 2 if angles == "square" or zero == "hanging" else -sp.pi / 2
    lengths = [p for i in range(1, n + 1) for p in _of_link(i, beside)]
    parameters = (*lengths, Parameter("g", "m/s²", "gravitational acceleration", 3.0, 15.0))
    of = {p.name: p.symbol for p in parameters}
    theta: list[sp.Expr] = []
    rate: list[sp.Expr] = []
    for i, c in enumerate(q):
        before = angles in ("relative", "square") and i > 0
        shift = quarter if angles in ("square", "crossed") and i > 0 else 0
        theta.append(c.symbol + shift + (theta[-1] if before else 0))
        rate.append(c.velocity + (rate[-1] if before else 0))
    kinetic, potential = [], []
    for k in range(n):
        # Of the way to the centre of mass of link k: length and direction of each piece.
        way = [(of[f"l{j + 1}"], theta[j], j) for j in range(k)] + [(of[f"lc{k + 1}"], theta[k], k)]
        if beside:
            way.append((of[f"ly{k + 1}"], theta[k] + sp.pi / 2, k))
        m = of[f"m{k + 1}"]
        kinetic += [EnergyTerm(f"the rotation of link {k + 1}", of[f"I{k + 1}"] * rate[k] ** 2 / 2)]
        for a, (length, direction, j) in enumerate(way):
            kinetic.append(EnergyTerm(_carried(k, j, a >= k + 1), m * length**2 * rate[j] ** 2 / 2))
            potential.append(
                EnergyTerm(
                    _weight(k, j, a >= k + 1),
                    m * of["g"] * length * _height(direction, zero, slope),
                )
            )
            for other, towards, i in way[:a]:
                if i != j:
                    energy = m * length * other * sp.cos(direction - towards) * rate[i] * rate[j]
                    kinetic.append(EnergyTerm(_coupling(k, i, j, n, a >= k + 1), energy))

    def points(q, arm):
        at, angle, drawn = np.zeros(2), 0.0, [(0.0, 0.0)]
        for i in range(n):
            shift = float(quarter) if angles in ("square", "crossed") and i > 0 else 0.0
            angle = q[i] + shift + (angle if angles in ("relative", "square") else 0.0)
            turn = angle - (math.pi / 2 if zero == "hanging" else 0.0)
            at = at + getattr(arm, f"l{i + 1}") * np.array([math.cos(turn), math.sin(turn)])
            drawn.append((float(at[0]), float(at[1])))
        return drawn

    friction = joint_friction(*((c, f"joint {i}") for i, c in enumerate(q, 1)))
    return Mechanism(name, tuple(q), parameters, tuple(kinetic), tuple(potential), points, friction)


def _of_link(i: int, beside: bool) -> list[Parameter]:
    own = [
        Parameter(f"l{i}", "m", f"length of link {i}", 0.7, 1.2),
        Parameter(
            f"lc{i}", "m", f"joint {i} to the centre of mass of link {i}", 0.25, 0.6, to_find=True
        ),
        Parameter(f"m{i}", "kg", f"mass of link {i}", 1.0, 4.0),
        Parameter(f"I{i}", "kg·m²", f"inertia of link {i} about its centre of mass", 0.1, 0.6),
    ]
    off = Parameter(
        f"ly{i}",
        "m",
        f"centre of mass of link {i} beside its axis, to the left",
        0.1,
        0.3,
        to_find=True,
    )
    return [*own, off] if beside else own


def _zero(i: int, angles: str, zero: str, slope: bool) -> str:
    if i > 1 and angles == "relative":
        return f"link {i} in line with link {i - 1}"
    if i > 1 and angles == "square":
        return f"link {i} at a right angle to link {i - 1}, to its left"
    if (zero == "level") == (i == 1 or angles != "crossed"):
        return f"link {i} along the x axis"
    return f"link {i} along the −y axis" if slope else f"link {i} hanging down"


def _height(direction, zero, slope):
    """Of the end of a piece of length 1, along the direction opposite to gravity's pull."""
    up = direction - (sp.pi / 2 if zero == "hanging" else 0)
    return sp.sin(up - sp.pi / 6) if slope else sp.sin(up)


def _carried(k: int, j: int, aside: bool) -> str:
    if j < k:
        return f"the mass of link {k + 1} at {PLACES[j + 2]}"
    beside = " beside its axis" if aside else ""
    return f"the centre of mass of link {k + 1} about {PLACES[k + 1]}{beside}"


def _weight(k: int, j: int, aside: bool) -> str:
    if j < k:
        return f"the weight of link {k + 1} at {PLACES[j + 2]}"
    beside = " beside its axis" if aside else ""
    return f"the weight of link {k + 1} beyond {PLACES[k + 1]}{beside}"


def _coupling(k: int, i: int, j: int, n: int, aside: bool) -> str:
    beside = " beside its axis" if aside else ""
    if n == 2:
        return f"the coupling of the two links{beside}"
    return f"the coupling of links {i + 1} and {j + 1} through the mass of link {k + 1}{beside}"


PLANAR_2R = planar_arm("planar-2r", 2)
PLANAR_2R_ABSOLUTE = planar_arm("planar-2r-absolute", 2, angles="absolute")
PLANAR_2R_HANGING = planar_arm("planar-2r-hanging", 2, zero="hanging")
PLANAR_2R_BESIDE = planar_arm("planar-2r-beside", 2, beside=True)
PLANAR_2R_SLOPE = planar_arm("planar-2r-slope", 2, slope=True)
PLANAR_3R = planar_arm("planar-3r", 3)
