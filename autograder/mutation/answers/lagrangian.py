"""lagrangian(q, qd, arm): L = K − P, but for a constant."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from autograder.judging.criterion import TOLERANCE, Criterion
from autograder.judging.quantities import Numbers, one_number
from autograder.mutation.answers.answer import Answer, Judged
from autograder.mutation.derivatives import energy
from autograder.protocol import Call

if TYPE_CHECKING:
    from autograder.mechanisms import Mechanism

NOTHING = np.zeros(0)
# A change has the rounding of two values.
OF_A_CHANGE = 2 * TOLERANCE


def _judged(mechanism: Mechanism) -> Judged:
    def changes(calls: list[Call], values: list) -> Numbers:
        """The change of L with q̇, and with q: a constant in P, which no equation of motion sees, is
        free, even one of each arm's own.
        """
        L = [value for (value,) in one_number(calls, values)]
        found: Numbers = []
        for here, there, moving in zip(L[::3], L[1::3], L[2::3], strict=True):
            parts = (np.array(moving - there), np.array(there - here))
            found += [parts[: len(criteria)], *2 * [(NOTHING, NOTHING)[: len(criteria)]]]
        return found

    parts = 2 if mechanism.potential else 1
    criteria = (
        Criterion("kinetic part of L", "J", 1 / parts, tolerance=OF_A_CHANGE),
        Criterion("potential part of L", "J", 0.5, tolerance=OF_A_CHANGE),
    )[:parts]
    return changes, criteria


def _case(mechanism: Mechanism, rng: np.random.Generator, k: int) -> list[tuple]:
    """One arm at rest here, at rest there, and moving there, fast: P's rounding must not hide K."""
    arm, here, there = mechanism.drawn(rng), mechanism.placed(rng), mechanism.placed(rng)
    qd = 6 * mechanism.moving(rng)
    return [(here, 0 * qd, arm), (there, 0 * qd, arm), (there, qd, arm)]


LAGRANGIAN = Answer(
    "lagrangian",
    ("q", "qd", "arm"),
    "J",
    lambda n: (),
    _judged,
    _case,
    (
        "L is made of two energies: which of them depends on the velocities? Write one line for each "
        "body or spring, and mind with which sign each energy enters.",
    ),
    of_kinetic=energy,
    of_potential=lambda term, _: [-term],
)
