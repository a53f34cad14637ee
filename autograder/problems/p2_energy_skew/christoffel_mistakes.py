"""Mistakes about the Christoffel form, for any n: they are the steps from M to C."""

import numpy as np

from autograder.judging.diagnosis import Mistake
from autograder.judging.models import AtPoints
from autograder.judging.terms import Term
from autograder.mutation.steps import STEPS, Right
from autograder.problems.p2_energy_skew.mistakes import NOT_SKEW, OF_ANY_C, WRONG_VELOCITY
from autograder.protocol import Expressions, numbers_at

STEP = 1e-30  # no difference is formed, so no digits are lost


def _derivatives_at(M: Expressions, q: list[str], point: dict[str, float]):
    """∂M_ij/∂q_k, (n, n, n), and M, (n, n), at a point.

    The complex step, Im M(q + i ε) / ε, is exact for analytic entries, and a fraction of the work of
    SymPy's derivatives.
    """
    steps = np.array([point[name] for name in q]) + 1j * STEP * np.eye(len(q))
    values = np.array([numbers_at(M, dict(zip(q, step, strict=True))) for step in steps])
    return np.moveaxis(values.imag, 0, -1) / STEP, values[0].real


def at_points(step, multiplied_by=2):
    """A model of `christoffel` from a step: what that makes of the numbers at a point, (n, n).

    multiplied_by: the argument that the symbols are multiplied by, counted from 0.
    """

    def numbers(call, point):
        M, q, _ = call.args
        slopes, inertia = _derivatives_at(M, [symbol.name for symbol in q], point)
        velocities = np.array([point[symbol.name] for symbol in call.args[multiplied_by]])
        return step(Right(inertia, slopes, velocities, np.zeros(len(q)), np.zeros(())))

    return AtPoints(numbers)


HALF_OF_ONE = (
    "Only one of the three derivatives in your Christoffel symbol is halved. Where do the brackets "
    "behind its ½ begin and end?"
)
CHRISTOFFEL_SAID = OF_ANY_C | {
    "first derivative alone halved": HALF_OF_ONE,
    "second derivative alone halved": HALF_OF_ONE,
    "last derivative alone halved": HALF_OF_ONE,
    "last term alone": (
        "Your C_ij holds only the last term of its sum over k. Is each term added to those before it, "
        "or written over them?"
    ),
    "first term alone": (
        "Your C_ij holds only the first term of its sum over k. Does your function return, or your loop "
        "end, before the others are added?"
    ),
    "last term left out": (
        "The last term of the sum over k is missing from your C_ij. Which numbers does k take, in "
        "Python and on paper?"
    ),
    "first term left out": (
        "The first term of the sum over k is missing from your C_ij. Which numbers does k take, in "
        "Python and on paper?"
    ),
    "sum never begun anew": (
        "Each entry of your C also holds all the entries before it. Where does the sum for an entry "
        "begin?"
    ),
    "upper triangle mirrored": (
        "Your C is symmetric: below its diagonal stands what stands above it. Must C be symmetric, as "
        "M is?"
    ),
    "not symmetrised": NOT_SKEW,
    "second derivative twice": NOT_SKEW,
    "last derivative not halved": (
        "The last of the three derivatives in your Christoffel symbol counts twice as much as it "
        "should. The kinetic energy has a ½: what stands in front of its derivative with respect to q?"
    ),
    "first derivative missing": (
        "Your Christoffel symbol leaves out the derivative of M_ij itself, with respect to q_k, or "
        "shares it wrongly. Where does d/dt act on M?"
    ),
    "velocity of the row": WRONG_VELOCITY,
    "second kind": (
        "Your Christoffel symbols are of the second kind: you multiplied M⁻¹ into them. That "
        "is right for q̈ = …, but does M⁻¹ have a place in M q̈ + C q̇ + … = u?"
    ),
}
COORDINATE_FOR_VELOCITY = (
    "You multiply each h_ijk by a coordinate. With what does C grow: with where the joints are, or with "
    "how fast they move?"
)
CHRISTOFFEL = (
    *(
        Mistake(name, at_points(STEPS["C"][name]), sentence)
        for name, sentence in CHRISTOFFEL_SAID.items()
    ),
    Mistake(
        "coordinate for velocity",
        at_points(lambda numbers: numbers.C, multiplied_by=1),
        COORDINATE_FOR_VELOCITY,
    ),
    Mistake(
        "upper triangle alone",
        at_points(lambda numbers: np.triu(numbers.C)),
        "Your C is 0 below its diagonal. Which i and j do your loops run over?",
    ),
)
CHRISTOFFEL_TERMS = (
    Term("the part from d/dt(M q̇)", at_points(STEPS["C"]["last derivative missing"])),
    Term(
        "the part from −∂K/∂q",
        at_points(lambda numbers: numbers.C - STEPS["C"]["last derivative missing"](numbers)),
    ),
)
