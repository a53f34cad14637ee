"""Mistakes about the energy along a run."""

import numpy as np

from autograder.judging.terms import Term
from autograder.problems.material import sentences
from autograder.problems.material.planar_2r import kinetic_energy, potential_energy


def drift(x, arm, kinetic=kinetic_energy, potential=potential_energy):
    """E(t) − E(0), (len(x),), J: the right answer, or with another K or P."""
    energy = np.array([kinetic(s[:2], s[2:], arm) + potential(s[:2], arm) for s in x])
    return energy - energy[0]


def _nothing(*_):
    return 0.0


DRIFT_TERMS = (
    Term("the change of K", lambda x, arm: drift(x, arm, potential=_nothing)),
    Term("the change of P", lambda x, arm: drift(x, arm, kinetic=_nothing)),
)

DRIFT_SAID = {
    "½ of K missing": sentences.HALF_MISSING,
    "diagonal of M alone": (
        "Your kinetic energy uses only the diagonal of M. What does the energy gain when both "
        "joints turn at once?"
    ),
    "M of the start": (
        "Your kinetic energy uses the M of the first state in every row. What does M depend on?"
    ),
    "C in the energy": (
        "There is a term with C in your energy. Which two energies does the arm have?"
    ),
    "C for M": ("You make the kinetic energy with C. Which matrix gives the kinetic energy?"),
    "P missing": ("The potential energy is missing. What does the arm gain as it rises?"),
    "K missing": ("The kinetic energy is missing. What does the arm gain as it moves faster?"),
    "L for the energy": (
        "Your potential energy falls as the arm rises. Is E the sum of K and P, and does your P "
        "grow with height?"
    ),
    "wrong angle / the weight of link 2 beyond the elbow / q2 / q1 + q2": (
        "Your P measures q2 from the x axis. From where is q2 measured, and how high is the "
        "second centre of mass then?"
    ),
    "cosine for sine": (
        "Your heights use the cosine. From which axis is q1 measured, and how high is the arm "
        "at q = 0?"
    ),
    "dropped / the weight of link 2 at the elbow": (
        "You measure the height of the second centre of mass from the elbow. How high is the elbow?"
    ),
    "torque times coordinate": (
        "Your P is the gravity torque times the angle. A torque that changes on the way must be "
        "summed along it: how high are the two centres of mass?"
    ),
    "gravity of Earth / 9.81 / g": (
        "Your P is right only on Earth, because you typed 9.81 into it. The check also uses "
        "other planets: which parameter of arm gives g?"
    ),
    "from the row before": (
        "You return the change from each row to the next. From which state do you count the drift?"
    ),
    "size of the drift": (
        "You return the size of the drift without its sign. Does the run gain energy or lose it?"
    ),
    "sign of the whole": (
        "Your drift has the wrong sign. Is it positive or negative when the energy grows?"
    ),
    "energy for its drift": (
        "You return the energy itself. By how much has it changed since the first row?"
    ),
    "from the mean": (
        "You subtract the mean of the energy. From which state do you count the drift?"
    ),
    "from the end": (
        "You subtract the energy of the last row. From which state do you count the drift?"
    ),
    "share for the drift": (
        "You divide by the energy at the start. That ratio depends on where P is zero, but the "
        "drift in J does not."
    ),
    "numbers of the example": (
        "Your energy is always that of the arm of this notebook. The check passes other arms to "
        "your function: in which argument do they come?"
    ),
}
