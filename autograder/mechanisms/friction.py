"""Friction of a mechanism: named torques or forces, one coordinate each, that take energy out."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

import sympy as sp

from autograder.mechanisms.outline import Coordinate, Resistance

if TYPE_CHECKING:
    from autograder.mechanisms.mechanism import Mechanism


@dataclass(frozen=True)
class FrictionTerm(Resistance):
    """A torque or force that resists one coordinate, in words: "the viscous friction of joint 1".

    coordinate: its name. coefficient: of the array of arm that holds its number, "viscous" for
    arm.viscous, which has one entry for each coordinate, 0 where there is no such term; unit, low,
    high: as a parameter's. torque: an expression in `symbol`, the velocities and the parameters. It
    stands on the left of the equation of motion, and takes energy out.
    """

    unit: str
    torque: sp.Expr
    low: float = 0.2
    high: float = 1.5

    @property
    def symbol(self) -> sp.Symbol:
        return coefficient(self.coefficient, self.coordinate)


def coefficient(name: str, coordinate: str) -> sp.Symbol:
    """The number of a friction term: its name holds a "_", so that no parameter has it."""
    return sp.Symbol(f"{name}_{coordinate}", positive=True)


def joint_friction(*joints: tuple[Coordinate, str]) -> tuple[FrictionTerm, ...]:
    """Viscous and Coulomb friction of joints, each with its name in words: (q1, "joint 1").

    As `armdyn.friction`: f = d q̇ + k sign(q̇), and sign(0) = 0. ValueError for anything but such pairs.
    """
    found = []
    for joint in joints:
        if not (isinstance(joint, tuple) and len(joint) == 2 and hasattr(joint[0], "velocity")):
            raise ValueError(
                f'joint_friction needs a coordinate and its words, as (x, "the cart"); got {joint!r}'
            )
        c, words = joint
        viscous, dry = ("N·m·s/rad", "N·m") if c.unit == "rad" else ("N·s/m", "N")
        slip, v = sp.sign(c.velocity), c.velocity
        for name, kind, unit, of in (
            (f"the viscous friction of {words}", "viscous", viscous, v),
            (f"the Coulomb friction of {words}", "coulomb", dry, slip),
        ):
            torque = coefficient(kind, c.name) * of
            found.append(FrictionTerm(name, c.name, kind, unit, torque))
    return tuple(found)


def refuse_other_than_friction(where: str, term: FrictionTerm, mechanism: Mechanism) -> None:
    """ValueError for a term that resists no coordinate of the mechanism's, or drives one."""
    parameters = {p.name: p.symbol for p in mechanism.parameters}
    velocities = {c.name: c.velocity for c in mechanism.coordinates}
    if term.coordinate not in velocities:
        raise ValueError(
            f"{where}: {term.name!r} resists {term.coordinate!r}, which is none of its coordinates"
        )
    if not re.fullmatch(r"[A-Za-z]+", term.coefficient) or term.coefficient in parameters:
        raise ValueError(
            f"{where}: the coefficient {term.coefficient!r} of {term.name!r} needs letters alone, "
            "and to be no parameter's name"
        )
    if not 0 < term.low < term.high:
        raise ValueError(
            f"{where}: the coefficient of {term.name!r} is drawn from {term.low} to {term.high}; "
            "needs 0 < low < high"
        )
    known = {*velocities.values(), term.symbol, *parameters.values()}
    symbols = sp.sympify(term.torque).free_symbols
    if unknown := sorted(s.name for s in symbols - known):
        raise ValueError(
            f"{where}: {term.name!r} holds {', '.join(unknown)}; it is made of its coefficient, the "
            "velocities and the parameters"
        )
    power = term.torque * velocities[term.coordinate]
    at = {s: sp.Rational(k + 2, 3) for k, s in enumerate(sorted(symbols, key=str))}
    for sign in (1, -1):
        point = at | {v: sign * at.get(v, 1) for v in velocities.values()}
        if not float(power.xreplace(point)) >= 0:
            raise ValueError(f"{where}: {term.name!r} drives {term.coordinate}; it must resist")
