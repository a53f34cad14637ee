"""energy_drift(x, arm): E(t_k) − E(t_0) along the states of a motion, a row each."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from autograder.judging.criterion import Criterion
from autograder.judging.quantities import each, vector
from autograder.mechanisms.outline import Outline
from autograder.mutation.answers.answer import Answer, Judged, in_motion
from autograder.mutation.answers.composition import Composition, Group
from autograder.mutation.derivatives import energy
from autograder.mutation.formulas import formulas
from autograder.mutation.mutant import Mutant
from autograder.mutation.steps import STEPS, Run, drift
from autograder.mutation.whole import whole

if TYPE_CHECKING:
    from autograder.mechanisms import Mechanism

ROWS = 6
NOTHING = np.zeros(0)


def _judged(mechanism: Mechanism) -> Judged:
    n = mechanism.n

    @each
    def parts(call, value):
        x = call.args[0]
        judged = [NOTHING] * 3
        which = 1 if not np.any(x[:, n:]) else 2 if np.any(np.diff(x[:, :n], axis=0)) else 0
        judged[which] = vector(value, len(x))
        return tuple(judged)

    return parts, (
        Criterion("change of the kinetic energy", "J", 0.35),
        Criterion("change of the potential energy", "J", 0.35),
        Criterion("drift where both change", "J", 0.3),
    )


def _case(mechanism: Mechanism, rng: np.random.Generator, k: int) -> list[tuple]:
    """In turn: only K changes, only P changes, both do."""
    q = np.array([mechanism.placed(rng) for _ in range(ROWS)])
    qd = np.array([mechanism.moving(rng) for _ in range(ROWS)])
    if k % 3 == 0:
        q[:] = q[0]
    elif k % 3 == 1:
        qd[:] = 0.0
    return [(np.hstack([q, qd]), mechanism.drawn(rng))]


@lru_cache(maxsize=64)
def _composition(mechanism: Outline) -> Composition:
    right, energies = whole(mechanism), _energies(mechanism)

    def run(x, arms) -> Run:
        q, qd, some = _flat(x, arms)
        numbers = right(q, qd, some).named() | {"q": q}
        shape = x.shape[:2]
        return Run(**{name: np.reshape(v, shape + v.shape[1:]) for name, v in numbers.items()})

    def groups(catalogue) -> Iterator[Group]:
        names, wrong = list(STEPS["energy_drift"]), catalogue("energy")

        def of_steps(at: Run) -> np.ndarray:
            return np.array([STEPS["energy_drift"][name](at) for name in names])

        yield Group(
            [Mutant(name) for name in names],
            lambda x, arms: of_steps(run(x, arms)),
        )
        yield Group(wrong.mutants, lambda x, arms: along(wrong.numbers, x, arms))

    def along(numbers: Callable, x, arms) -> np.ndarray:
        found = numbers(*_flat(x, arms))
        return drift(found.reshape(*found.shape[:-1], *x.shape[:2]))

    def part(k: int) -> Callable[..., np.ndarray]:
        return lambda x, arms: along(lambda *state: energies(*state)[k], x, arms)

    terms = [term.name for term in (*mechanism.kinetic, *mechanism.potential)]
    return Composition(
        lambda calls: (np.array([args[0] for args in calls]), [args[1] for args in calls]),
        lambda x, arms: drift(run(x, arms).E),
        groups,
        {name: part(k) for k, name in enumerate(terms)},
    )


def _flat(x, arms) -> tuple:
    """q, q̇ and the arms of all rows of all motions, (cases · rows, n)."""
    q, qd = np.split(x.reshape(-1, x.shape[-1]), 2, axis=-1)
    return q, qd, [arm for arm in arms for _ in range(x.shape[1])]


def _energies(mechanism: Outline) -> Callable[..., np.ndarray]:
    """A function of q, q̇ (cases, n) and the arms to the energy of each term, (terms, cases)."""
    count = len(mechanism.kinetic) + len(mechanism.potential)
    return formulas(
        mechanism,
        ("energies",),
        lambda of: [term.energy for term in (*of.kinetic, *of.potential)],
        count,
    )


ENERGY = Answer(
    "energy",
    ("q", "qd", "arm"),
    "J",
    lambda n: (),
    _judged,
    in_motion,
    (),
    of_kinetic=energy,
    of_potential=energy,
)
ENERGY_DRIFT = Answer(
    "energy_drift",
    ("x", "arm"),
    "J",
    lambda n: (ROWS,),
    _judged,
    _case,
    (
        "First write a function for the energy of one state; then use it on every row.",
        "The energy is the sum of K and P. For P you need the height of each body and the stretch of "
        "each spring; for K the velocity of each body, or M.",
        "Put the energies into an array of len(x) entries. The drift compares all of them with one of "
        "them. Which entry of your result is 0?",
    ),
    position=lambda args: np.split(np.asarray(args[0])[0], 2)[0],
    composition=_composition,
)
