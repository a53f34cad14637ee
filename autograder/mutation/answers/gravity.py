"""g_vec(q, arm): the gradient of the potential energy."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from autograder.judging.criterion import Criterion
from autograder.judging.quantities import each, vector
from autograder.mutation.answers.answer import Answer, Judged, at_rest, by_coordinate
from autograder.mutation.derivatives import gradient

if TYPE_CHECKING:
    from autograder.mechanisms import Mechanism


def _judged(mechanism: Mechanism) -> Judged:
    n = mechanism.n
    entries = gradient(mechanism.P, mechanism)
    judged = [i for i in range(n) if entries[i] != 0] or list(range(n))
    zero = [i for i in range(n) if i not in judged]

    @each
    def parts(call, value):
        g = vector(value, n)
        return (np.array([g[judged[0]], *g[zero]]), *(g[[i]] for i in judged[1:]))

    units = by_coordinate(mechanism, "N·m", "N")
    of = [[judged[0], *zero], *([i] for i in judged[1:])]
    return parts, tuple(
        Criterion(
            f"g{i + 1}" if n > 1 else "g",
            units[i],
            1 / len(judged),
            units=tuple(units[j] for j in places),
        )
        for i, places in zip(judged, of, strict=True)
    )


GRAVITY = Answer(
    "g_vec",
    ("q", "arm"),
    "N·m",
    lambda n: (n,),
    _judged,
    at_rest,
    (
        "Entry i is the derivative of P by coordinate i. Which terms change when only that coordinate "
        "moves?",
    ),
    of_potential=gradient,
)
