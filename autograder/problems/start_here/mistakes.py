"""Mistakes in the warm-up of lesson 00."""

from autograder.judging.diagnosis import Mistake

KINETIC_ENERGY = (
    Mistake(
        "half missing",
        lambda I, qd: I * qd**2,
        "Your kinetic energy is twice the right one. What stands in front of a kinetic energy?",
    ),
    Mistake(
        "velocity not squared",
        lambda I, qd: 0.5 * I * qd,
        "Your kinetic energy changes sign with the velocity. Can a moving body's be negative?",
    ),
)
