"""Mistakes about a C for which Ṁ − 2C is not skew-symmetric."""

import numpy as np

from autograder.judging.diagnosis import Mistake
from autograder.mutation.steps import STEPS, Right
from autograder.problems.material import planar_2r as right
from autograder.problems.p2_energy_skew.mistakes import OF_ANY_C, PATTERN, h_times

PLUS_CONSTANT = (
    "What you add to C does not vanish when it is multiplied by q̇. Which (2, 2) matrices, built from "
    "q̇1 and q̇2, send the vector q̇ to zero?"
)
ADDED = {
    "constant skew matrix added": [[0.0, 1.0], [-1.0, 0.0]],
    "constant skew matrix taken off": [[0.0, -1.0], [1.0, 0.0]],
    "unit matrix added": [[1.0, 0.0], [0.0, 1.0]],
    "ones added": [[1.0, 1.0], [1.0, 1.0]],
}


def _numbers(q, qd, arm) -> Right:
    slopes = np.multiply.outer(right.h(q, arm) * PATTERN, [0.0, 1.0])
    P = np.array(right.potential_energy(q, arm))
    return Right(right.M(q, arm), slopes, qd, right.g_vec(q, arm), P)


def _other(step):
    """A wrong C of the arm, from its numbers."""
    return lambda q, qd, arm: step(_numbers(q, qd, arm))


def _plus(matrix):
    return lambda numbers: numbers.C + np.array(matrix)


OTHER = (
    Mistake(
        "C itself",
        right.C,
        "You return the Christoffel C again, for which Ṁ − 2C is skew-symmetric. Here you need a "
        "C for which it is not. What can you add to C without changing C q̇?",
    ),
    *(
        Mistake(name, _other(STEPS["C"][name]), OF_ANY_C[name])
        for name in (
            *("transposed", "half the rate of M", "rate of M"),
            *("torque for C", "C times ones"),
        )
    ),
    Mistake(
        "zero",
        _other(STEPS["C"]["zero"]),
        "Your C_other is zero, and so is its product with q̇. Is the torque C q̇ zero when the joints "
        "turn?",
    ),
    Mistake(
        "scaled",
        _other(STEPS["C"]["twice the whole"]),
        "You return 2C, and so you change C q̇ as well. What can you add to C without changing C q̇?",
    ),
    *(Mistake(name, _other(_plus(matrix)), PLUS_CONSTANT) for name, matrix in ADDED.items()),
    Mistake(
        "first entry dropped",
        h_times(lambda a, b: [[0.0, a + b], [-a, 0.0]]),
        "You took an entry out of the first column and lost it: C q̇ now has only half of its "
        "term with q̇1 q̇2. Where in the row can the entry go so that C q̇ stays the same?",
    ),
    Mistake(
        "columns exchanged",
        _other(lambda numbers: numbers.C[:, ::-1]),
        "You swapped the columns of C, but not q̇1 and q̇2. Is C q̇ still the same?",
    ),
)
