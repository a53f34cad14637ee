"""The right answers of a mechanism, as functions of numbers: M(q, arm), C(q, qd, arm) and so on."""

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from autograder.mechanisms.outline import Outline
from autograder.mutation.answers import ANSWERS
from autograder.mutation.calls import Model
from autograder.mutation.formulas import formulas
from autograder.mutation.shared import shared


@lru_cache(maxsize=64)
def reference(mechanism: Outline, answer: str) -> Model:
    """The right answer, with the arguments of the student's function."""
    asked = ANSWERS[answer]
    if asked.of_kinetic or asked.of_potential:
        shape = asked.shape(mechanism.n)
        entries = formulas(mechanism, ("answer", answer), asked.entries, int(np.prod(shape)))

        def right(q, qd, arms) -> np.ndarray:
            return entries(q, qd, arms).T.reshape(-1, *shape)

        return Model(mechanism, answer, right)
    assert asked.composition is not None
    return Model(mechanism, answer, asked.composition(mechanism).right)


@lru_cache(maxsize=64)
def contributions(mechanism: Outline, answer: str) -> tuple[tuple[str, Model], ...]:
    """What each term of the energies contributes to the right answer, by the term's name."""
    asked = ANSWERS[answer]
    names = asked.term_names(mechanism)
    shape = asked.shape(mechanism.n)
    size = int(np.prod(shape))
    entries = formulas(
        mechanism,
        ("terms", answer),
        lambda of: [e for term, derived in asked.terms(of) for e in derived(term.energy, of)],
        len(names) * size,
    )

    @shared
    def every(q, qd, arms) -> np.ndarray:
        found = entries(q, qd, arms).reshape(len(names), *shape, len(q))
        return np.moveaxis(found, -1, 1)

    def term(k: int) -> Callable[..., np.ndarray]:
        return lambda *columns: every(*columns)[k]

    return tuple((name, Model(mechanism, answer, term(k))) for k, name in enumerate(names))
