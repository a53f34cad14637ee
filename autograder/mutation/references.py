"""The right answers of a mechanism, as functions of numbers: M(q, arm), C(q, qd, arm) and so on."""

from collections.abc import Callable
from functools import lru_cache

import numpy as np
import sympy as sp

from autograder.mechanisms import Mechanism
from autograder.mutation.answers import ANSWERS, Answer


@lru_cache(maxsize=64)
def reference(mechanism: Mechanism, answer: str) -> Callable:
    """The right answer, with the arguments of the student's function."""
    asked = ANSWERS[answer]
    if asked.of_kinetic or asked.of_potential:
        return _of_entries(mechanism, asked, asked.entries(mechanism))
    assert asked.composition is not None
    composed = asked.composition(mechanism)
    return lambda *args: composed.right(*composed.columns([args]))[0]


@lru_cache(maxsize=1024)
def contribution(mechanism: Mechanism, answer: str, term: int) -> Callable:
    """What one term of the energies, by its place, contributes to the right answer."""
    asked = ANSWERS[answer]
    part, derived = list(asked.terms(mechanism))[term]
    return _of_entries(mechanism, asked, derived(part.energy, mechanism))


def _of_entries(mechanism: Mechanism, asked: Answer, entries: list[sp.Expr]) -> Callable:
    names = [p.name for p in mechanism.parameters]
    symbols = [*mechanism.q, *mechanism.qd, *(p.symbol for p in mechanism.parameters)]
    compute = sp.lambdify(symbols, entries, modules="numpy", cse=True)
    shape, n = asked.shape(mechanism.n), mechanism.n

    def right(q, *rest):
        *velocities, arm = rest
        qd = velocities[0] if velocities else np.zeros(n)
        values = compute(*q, *qd, *(getattr(arm, name) for name in names))
        return np.reshape(np.array(values, dtype=float), shape)

    return right
