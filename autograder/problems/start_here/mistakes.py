"""Mistakes in the warm-up of lesson 00."""

from autograder.judging.diagnosis import Mistake
from autograder.problems.material import sentences

KINETIC_ENERGY = (
    Mistake(
        "half missing",
        lambda I, qd: I * qd**2,
        sentences.HALF_MISSING,
    ),
    Mistake(
        "velocity not squared",
        lambda I, qd: 0.5 * I * qd,
        "Your kinetic energy changes sign with the velocity. Can a moving body have negative "
        "kinetic energy?",
    ),
)
