"""M_dot(q, qd, arm): how fast the inertia matrix changes along a motion."""

from __future__ import annotations

from typing import TYPE_CHECKING

from autograder.mutation.answers.answer import Answer, Judged, in_motion
from autograder.mutation.answers.coriolis import of_wrong_inertia
from autograder.mutation.answers.inertia_matrix import symmetric
from autograder.mutation.derivatives import inertia_rate

if TYPE_CHECKING:
    from autograder.mechanisms import Mechanism


def _judged(mechanism: Mechanism) -> Judged:
    return symmetric(mechanism, "Ṁ", inertia_rate(mechanism.K, mechanism), "/s")


INERTIA_RATE = Answer(
    "M_dot",
    ("q", "qd", "arm"),
    "kg·m²/s",
    lambda n: (n, n),
    _judged,
    in_motion,
    (
        "M changes with time only because the coordinates do. By the chain rule an entry's rate is a "
        "sum over all coordinates: its derivative by each, times that one's velocity. Which are zero?",
    ),
    of_kinetic=inertia_rate,
    symmetric=True,
    composition=lambda mechanism: of_wrong_inertia(mechanism, "M_dot", lambda right: right.M_dot),
)
