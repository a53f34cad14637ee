"""From which earlier answers of a mechanism an answer follows: what is declared once for all of them."""

from functools import partial

import numpy as np

from autograder.judging.carried import ways
from autograder.judging.carried.follows import Follows, Way
from autograder.mechanisms.outline import Outline
from autograder.mutation.friction import torques

RIGHT = "so this step is right. The mistake is in {}: mend it, and {} follows."
# By the answer that follows: by which earlier ones, and what is said of it.
FOLLOWS: dict[str, tuple[tuple[tuple[str, ...], str, Way], ...]] = {
    "lagrangian": (
        (
            ("potential_energy",),
            f"The potential part of your L is that of your own P, {RIGHT.format('P', 'L')}",
            ways.POTENTIAL_PART,
        ),
    ),
    "M": (
        (
            ("lagrangian",),
            f"Your M is what stands before q̈ with your own L, {RIGHT.format('L', 'M')}",
            ways.INERTIA,
        ),
    ),
    "M_dot": (
        (
            ("M",),
            f"Your Ṁ is the rate of change of your own M, {RIGHT.format('M', 'Ṁ')}",
            ways.RATE,
        ),
    ),
    "C": (
        (
            ("M",),
            f"Your C is the Christoffel form of your own M, {RIGHT.format('M', 'C')}",
            ways.CHRISTOFFEL,
        ),
        (
            ("M_dot",),
            "This is what the Christoffel form gives with the derivatives of M in your own Ṁ, "
            f"{RIGHT.format('Ṁ', 'C')}",
            ways.CHRISTOFFEL_OF_RATES,
        ),
    ),
    "g_vec": (
        (
            ("potential_energy",),
            f"This is the gradient of your own P, {RIGHT.format('P', 'g')}",
            ways.GRADIENT,
        ),
        (
            ("lagrangian",),
            f"Your g is the derivative of the P in your own L, {RIGHT.format('L', 'g')}",
            ways.GRADIENT_IN_L,
        ),
    ),
    "energy_drift": (
        (
            ("M", "potential_energy"),
            f"This is the change of your own K + P, {RIGHT.format('one of these', 'the drift')}",
            ways.DRIFT,
        ),
    ),
}
ACCELERATIONS = f"Your ẋ is what your own M, C and g give, {RIGHT.format('one of these', 'ẋ')}"


def follows(mechanism: Outline, answer: str) -> tuple[Follows, ...]:
    """What is declared of this answer, for this mechanism."""
    declared = [
        Follows(_ids(mechanism, earlier), said, way)
        for earlier, said, way in FOLLOWS.get(answer, ())
    ]
    if answer == "f":
        way = ways.accelerations(partial(_friction, mechanism))
        declared = [Follows(_ids(mechanism, ("M", "C", "g_vec")), ACCELERATIONS, way)]
    return tuple(declared)


def _ids(mechanism: Outline, answers: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(f"{mechanism.name}-{answer}" for answer in answers)


def _friction(mechanism: Outline, q, qd, arm) -> np.ndarray:
    if not mechanism.friction:
        return np.zeros(len(qd))
    return np.sum(torques(mechanism)(q[np.newaxis], qd[np.newaxis], [arm]), axis=0)[0]
