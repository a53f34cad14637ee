"""potential_energy(q, arm): P, but for a constant."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from autograder.judging.criterion import Criterion
from autograder.judging.quantities import Numbers, one_number
from autograder.mutation.answers.answer import Answer, Judged
from autograder.mutation.derivatives import energy
from autograder.protocol import Call

if TYPE_CHECKING:
    from autograder.mechanisms import Mechanism


def _judged(mechanism: Mechanism) -> Judged:
    def changes(calls: list[Call], values: list) -> Numbers:
        """Between two places of one arm: a constant, even one of each arm's own, is free."""
        P = [energy for (energy,) in one_number(calls, values)]
        return [(a - b,) for a, b in zip(P[::2], P[1::2], strict=True) for _ in range(2)]

    return changes, (Criterion("change of P between two places", "J"),)


def _case(mechanism: Mechanism, rng: np.random.Generator, k: int) -> list[tuple]:
    """Two places of one arm."""
    arm, q = mechanism.drawn(rng), mechanism.placed(rng)
    return [(q, arm), (mechanism.placed(rng), arm)]


POTENTIAL_ENERGY = Answer(
    "potential_energy",
    ("q", "arm"),
    "J",
    lambda n: (),
    _judged,
    _case,
    (
        "Write the height of each body, or the stretch of each spring, as a function of the "
        "coordinates, and test it at a position where you know it.",
    ),
    of_potential=energy,
)
