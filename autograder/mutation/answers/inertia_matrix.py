"""M(q): the inertia matrix."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from autograder.judging.criterion import Criterion
from autograder.judging.quantities import array, each
from autograder.mutation.answers.answer import Answer, Judged, at_rest, unit_of_inertia
from autograder.mutation.derivatives import inertia

if TYPE_CHECKING:
    from autograder.mechanisms import Mechanism


def _judged(mechanism: Mechanism) -> Judged:
    return symmetric(mechanism, "M", inertia(mechanism.K, mechanism), "")


def symmetric(mechanism: Mechanism, head: str, entries: list, per: str) -> Judged:
    """Entry by entry, ij together with ji; per: what their units have beside those of M."""
    n = mechanism.n
    pairs = [(i, j) for i in range(n) for j in range(i, n)]
    # An entry that is 0 earns nothing by itself: an empty matrix would have it right.
    zero = [(i, j) for i, j in pairs if entries[i * n + j] == 0]
    zero = zero if len(zero) < len(pairs) else pairs[1:]
    pairs = [pair for pair in pairs if pair not in zero]

    zero = [place for i, j in zero for place in dict.fromkeys(((i, j), (j, i)))]

    places = [tuple(np.array([*dict.fromkeys(((i, j), (j, i)))]).T) for i, j in pairs]

    @each
    def parts(call, value):
        M = np.reshape(value, (1, 1)) if n == 1 and np.size(value) == 1 else array(value, n, n)
        found = [M[at] for at in places]
        beside = [M[i, j] for i, j in zero]
        return (np.array([*found[0], *beside]), *found[1:])

    names = [
        tuple(dict.fromkeys((f"{head}{i + 1}{j + 1}", f"{head}{j + 1}{i + 1}"))) for i, j in pairs
    ]
    beside = tuple(f"{head}{i + 1}{j + 1}" for i, j in zero)
    units = [unit_of_inertia(mechanism, i, j) + per for i, j in pairs]
    beside_units = tuple(unit_of_inertia(mechanism, i, j) + per for i, j in zero)
    return parts, tuple(
        Criterion(
            " and ".join(own) if n > 1 else head,
            unit,
            1 / len(pairs),
            entries=own if k else own + beside,
            units=() if k else len(own) * (unit,) + beside_units,
        )
        for k, (own, unit) in enumerate(zip(names, units, strict=True))
    )


INERTIA_MATRIX = Answer(
    "M",
    ("q", "arm"),
    "kg·m²",
    lambda n: (n, n),
    _judged,
    at_rest,
    (
        "The entry M_ij is the second derivative of K by the velocities i and j. Sort K by the "
        "products of two velocities: where do the mixed ones go?",
    ),
    of_kinetic=inertia,
    symmetric=True,
)
