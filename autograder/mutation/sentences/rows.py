"""Sentences for one answer, mechanism, term or entry, where a teacher knows a better one.

They are said before the operator's own sentence in `of_terms` and `of_steps`; the most specific wins.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """A sentence of a teacher's for an operator, where the place fits the patterns (`*` for any)."""

    operator: str
    sentence: str
    answer: str = "*"
    mechanism: str = "*"
    term: str = "*"
    entry: str = "*"


ROWS = (
    Row(
        "dropped",
        "Your {where} lacks {term}. Hold joint 2 and move joint 1: which of the two links turn?",
        "M",
        "planar-2r*",
        "the rotation of link 2",
        "M11",
    ),
    Row(
        "dropped",
        "Your {where} lacks {term}. In which products of two velocities does its energy appear?",
        "M",
        entry="M*",
    ),
    Row(
        "half of the whole",
        "Your {where} is half of the right one. There is a ½ in K = ½ q̇ᵀ M q̇: is it a part of M?",
        "M",
    ),
    Row(
        "sign of the whole",
        "Your {where} has the wrong sign. Can a kinetic energy be negative?",
        "M",
    ),
    Row(
        "sign of the whole",
        "Your {where} has the wrong sign. Does an entry of M grow or shrink as the joints move?",
        "M_dot",
    ),
    Row(
        "M",
        "You return M itself. How fast do its entries change as the joints move?",
        "M_dot",
    ),
    Row(
        "diagonal alone",
        "Your {where} is diagonal. Which entries of M beside its diagonal change as the joints move?",
        "M_dot",
    ),
    Row(
        "upper triangle alone",
        "Your {where} is 0 below its diagonal. Which property of M does its derivative keep?",
        "M_dot",
    ),
    Row(
        "diagonal alone",
        "Your {where} is diagonal. Does no joint feel the acceleration of another?",
        "M",
    ),
    Row(
        "wrong sign",
        "In your {where}, {term} has the wrong sign. Does its energy rise or fall as the coordinate "
        "grows?",
        "g_vec",
    ),
    Row(
        "sign of the whole",
        "Your q̈ as a whole has the wrong sign. Which terms stand beside M q̈ in the equation of motion, "
        "and which on the other side?",
        "f",
    ),
    Row(
        "sign of the whole",
        "Your {where} has the wrong sign. Does it rise when a body is lifted or a spring stretched?",
        "potential_energy",
    ),
    Row(
        "sign of the whole",
        "Your {where} has the wrong sign. Is L the sum of K and P, or which of them less the other?",
        "lagrangian",
    ),
    Row(
        "sign of the whole",
        "Your {where} has the wrong sign. Is it positive or negative when the energy grows?",
        "energy_drift",
    ),
    Row(
        "sign of the whole",
        "Your {where} has the wrong sign. Does Y π give what the motors do, or what acts against them?",
        "regressor",
    ),
    Row(
        "joints exchanged",
        "Your {where} has its rows in the wrong order. Which coordinate does the first row belong to?",
        "regressor",
    ),
    Row(
        "velocities squared",
        "Your {where} has each velocity squared. How does the rate of an entry change if the joints "
        "move twice as fast?",
        "M_dot",
    ),
    Row(
        "velocity squared",
        "In your {where}, the velocity {put} is squared. How does the rate of an entry change if the "
        "joints move twice as fast?",
        "M_dot",
    ),
    Row(
        "velocity of the wrong sign",
        "In your {where}, the part with the velocity {put} has the wrong sign. How does M change as "
        "that coordinate alone grows?",
        "M_dot",
    ),
    Row(
        "velocity dropped",
        "In your {where}, the part with the velocity {put} is missing. How does M change as that "
        "coordinate alone grows?",
        "M_dot",
    ),
    Row(
        "product dropped",
        "Your Y lacks the product of velocities {put} in {where}. Which entries of C bring it there?",
        "regressor",
    ),
    Row(
        "product of the wrong sign",
        "Your Y has the product of velocities {put} with the wrong sign in {where}. Which entries "
        "of C bring it there?",
        "regressor",
    ),
    Row(
        "product halved",
        "Your Y has half of the product of velocities {put} in {where}. How often does it come up when "
        "C is multiplied by q̇?",
        "regressor",
    ),
    Row(
        "product doubled",
        "Your Y counts the product of velocities {put} twice in {where}. How often does it come up when "
        "C is multiplied by q̇?",
        "regressor",
    ),
)
