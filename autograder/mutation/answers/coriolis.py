"""C(q, q̇): the Coriolis and centrifugal matrix in Christoffel form."""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from autograder.judging.criterion import TOLERANCE, Criterion, Said
from autograder.judging.models import Beside
from autograder.judging.quantities import array, each
from autograder.mechanisms.outline import Outline
from autograder.mutation import velocities
from autograder.mutation.answers.answer import (
    Answer,
    Judged,
    by_coordinate,
    criterion,
    in_motion,
    states,
    unit_of_inertia,
)
from autograder.mutation.answers.composition import Composition, Group
from autograder.mutation.derivatives import coriolis
from autograder.mutation.shared import shared
from autograder.mutation.steps import Right
from autograder.mutation.whole import slopes, whole


def _judged(mechanism: Outline) -> Judged:
    from autograder.mutation.references import reference  # which knows every answer

    n, right = mechanism.n, Beside(reference(mechanism, "C"))

    @each
    def steps(call, value):
        C, qd = _matrix(n, right, call, value), call.args[1]
        return C @ qd, qd @ C @ qd, C + C.T

    energy = "With your C the energy would change although nobody does work."
    skew = "Ṁ − 2C is not skew-symmetric with your C, as it is with the Christoffel form."
    enough = Said(
        "Ṁ − 2C is not skew-symmetric with your C. A right C q̇ is not enough: how does the Christoffel "
        "form share the products of two velocities?",
        lambda answered: answered.met[0],
    )
    rates = [f"{unit_of_inertia(mechanism, i, j)}/s" for i, j in np.ndindex(n, n)]
    return steps, (
        criterion("vector C q̇", by_coordinate(mechanism, "N·m", "N"), 0.5),
        Criterion("power q̇ᵀC q̇ = ½ q̇ᵀṀ q̇", "W", 0.2, otherwise=energy, is_property=True),
        criterion("sum C + Cᵀ = Ṁ", rates, 0.3, otherwise=(enough, Said(skew)), is_property=True),
    )


def _matrix(n: int, right: Beside, call, value) -> np.ndarray:
    """C as it came. The vector C q̇ and the row sums of C are mistakes with a name: they count as the
    diagonal of a matrix.
    """
    if n == 1 and np.size(value) == 1:
        return np.reshape(value, (1, 1))
    if np.size(value) == n:
        C, qd = right.of(call), call.args[1]
        for vector in (C @ qd, np.sum(C, axis=-1)):
            if np.allclose(np.ravel(value), vector, rtol=TOLERANCE, atol=TOLERANCE):
                return np.diag(np.ravel(value))
    return array(value, n, n)


def of_wrong_inertia(
    mechanism: Outline, name: str, follows: Callable[[Right], np.ndarray]
) -> Composition:
    """Of an answer that is linear in M's slopes: its own mistakes, and those of M that show in it."""
    right = whole(mechanism)

    def groups(catalogue) -> Iterator[Group]:
        own, inertia = catalogue(name), catalogue("M")
        yield Group(own.mutants, own.numbers)
        yield (
            velocities.in_coriolis(mechanism)
            if name == "C"
            else velocities.in_inertia_rate(mechanism)
        )
        terms, wrong = propagated(mechanism, inertia)
        yield Group(
            [inertia.mutants[k].within("M") for k in terms],
            lambda q, qd, arms: follows(wrong(q, qd, arms)),
        )

    return Composition(states, lambda q, qd, arms: follows(right(q, qd, arms)), groups)


def propagated(mechanism: Outline, inertia) -> tuple[list[int], Callable[..., Right]]:
    """The mistakes of M's catalogue that are made in a term; and from q, q̇ and the arms the numbers of
    an arm with such an M, (mutants, cases, …).
    """
    terms = [k for k, mutant in enumerate(inertia.mutants) if not mutant.is_step]
    right = whole(mechanism)

    @shared
    def numbers(q, qd, arms) -> Right:
        def wrong(at):
            some = arms * (len(at) // len(arms))
            return inertia.numbers(at, np.zeros(at.shape), some)[terms]

        known = right(q, qd, arms)
        return replace(known, M=wrong(q), slopes=slopes(wrong, q))

    return terms, numbers


CORIOLIS = Answer(
    "C",
    ("q", "qd", "arm"),
    "kg·m²/s",
    lambda n: (n, n),
    _judged,
    in_motion,
    (
        "Differentiate each entry of your M by each coordinate. The sum over k of h_ijk times the k-th "
        "velocity is C_ij, and h_ijk has three derivatives: two with a plus, one with a minus.",
    ),
    of_kinetic=coriolis,
    composition=lambda mechanism: of_wrong_inertia(mechanism, "C", lambda right: right.C),
)
