"""regressor(q, qd, qdd, arm): Y with Y π = M q̈ + C q̇ + g, for π of `inertial_parameters`.

A column of Y is the torque of the mechanism whose π is 1 there and 0 elsewhere. So wrong regressors are
those of wrong mechanisms whose parameters are the entries of π.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache, partial
from types import SimpleNamespace
from typing import TYPE_CHECKING

import numpy as np

from autograder.judging.quantities import UnfitError, each
from autograder.mechanisms.outline import Outline
from autograder.mechanisms.units import spelled
from autograder.mutation import velocities
from autograder.mutation.answers.answer import (
    Answer,
    Judged,
    by_coordinate,
    criterion,
    in_other_units,
)
from autograder.mutation.answers.columns import TIMES, of_columns, pi_of
from autograder.mutation.answers.composition import Composition, Group, throughout
from autograder.mutation.answers.coriolis import propagated
from autograder.mutation.in_pi import in_pi
from autograder.mutation.mutant import Mutant
from autograder.mutation.steps import times
from autograder.mutation.whole import whole

if TYPE_CHECKING:
    from autograder.mechanisms import Mechanism

PARTS = ("M q̈", "C q̇", "g(q)")
# What is no mistake in a column, as an entry of π is 1 or 0 there, or would not be linear in π.
OF_A_NUMBER = (
    "parameter left out", "kind left out", "point mass", "mass for inertia", "parallel axis added",
    "parallel axis taken off", "square lost", "square added",
)  # fmt: skip


def _judged(mechanism: Mechanism) -> Judged:
    n, entries = mechanism.n, pi_of(mechanism)
    shape = (n, len(entries))
    listed = ", ".join(pi.doc for pi in entries)

    @each
    def columns(call, value):
        if np.shape(value) == shape:
            return tuple(np.transpose(value))
        raise UnfitError(
            f"an array of shape {np.shape(value)}; it must return one row for each coordinate and one "
            f"column for each of {listed}, shape {shape}"
        )

    return columns, tuple(
        criterion(f"column of {pi.doc}", _units(mechanism, pi.unit), 1 / len(entries))
        for pi in entries
    )


def _units(mechanism: Outline, unit: str) -> tuple[str, ...]:
    """Of the torques and forces over this."""
    turning = {"kg": "m²/s²", "kg·m": "m/s²", "kg·m²": "rad/s²"}
    sliding = {"kg": "m/s²", "kg·m": "rad/s²", "kg·m²": "rad/(m·s²)"}
    return by_coordinate(
        mechanism,
        turning.get(unit) or spelled("N·m", per=unit),
        sliding.get(unit) or spelled("N", per=unit),
    )


def _case(mechanism: Mechanism, rng: np.random.Generator, k: int) -> list[tuple]:
    arm, n = mechanism.drawn(rng), mechanism.n
    qdd = rng.choice([-1.0, 1.0], n) * rng.uniform(1.0, 6.0, n)
    return [(mechanism.placed(rng), mechanism.moving(rng), qdd, arm)]


def _columns(calls: list[tuple]) -> tuple:
    q, qd, qdd = (np.array([args[k] for args in calls]) for k in range(3))
    return q, qd, qdd, [args[3] for args in calls]


@lru_cache(maxsize=64)
def _composition(mechanism: Outline) -> Composition:
    linear = in_pi(mechanism)
    right = whole(linear)
    count = len(pi_of(mechanism))

    def made(torque: Callable, q, qd, qdd, arms) -> np.ndarray:
        """Y (…, cases, n, p) of a torque (…, columns · cases, n)."""
        units = [
            SimpleNamespace(**vars(arm) | {f"pi{k + 1}": float(k == j) for k in range(count)})
            for j in range(count)
            for arm in arms
        ]
        found = torque(*(np.tile(x, (count, 1)) for x in (q, qd, qdd)), units)
        apart = found.reshape(*found.shape[:-2], count, len(q), mechanism.n)
        return np.moveaxis(apart, -3, -1)

    def parts(q, qd, qdd, arms) -> list[np.ndarray]:
        known = right(q, qd, arms)
        return [times(known.M, qdd), times(known.C, qd), known.g_vec]

    def part(k: int) -> Callable[..., np.ndarray]:
        return partial(made, lambda *state: parts(*state)[k])

    def whole_torque(*state) -> np.ndarray:
        return np.sum(parts(*state), axis=0)

    def groups(catalogue: Callable) -> Iterator[Group]:
        rows = ["", *(f"row {i + 1}" for i in range(mechanism.n if mechanism.n > 1 else 0))]
        names = [(operator, k, row) for row in rows for k in range(3) for operator in TIMES]

        def of_parts(*state):
            known = parts(*state)
            found = []
            for operator, k, row in names:
                change = (TIMES[operator] - 1) * known[k]
                found.append(sum(known) + (_only(row, change) if row else change))
            return np.array(found)

        yield Group([Mutant(o, PARTS[k], row) for o, k, row in names], partial(made, of_parts))
        yield _readings(mechanism, partial(made, whole_torque))
        yield of_columns(mechanism, partial(made, whole_torque))
        for mutants, torque in _of_energies(linear, catalogue, parts):
            yield Group(mutants, partial(made, torque))

    return Composition(
        _columns,
        partial(made, whole_torque),
        groups,
        {
            "its acceleration part": part(0),
            "its velocity part": part(1),
            "its gravity part": part(2),
        },
    )


def _readings(mechanism: Outline, right: Callable[..., np.ndarray]) -> Group:
    def numbers(q, qd, qdd, arms):
        return np.array([right(at, qd, qdd, arms) for at in in_other_units(mechanism, q).values()])

    converted = in_other_units(mechanism, np.zeros((1, mechanism.n)))
    return Group([Mutant(name) for name in converted], numbers)


def _only(row: str, torque: np.ndarray) -> np.ndarray:
    """A torque in one row alone: "row 1"."""
    return torque * np.eye(torque.shape[-1])[int(row.removeprefix("row ")) - 1]


def _of_energies(linear: Outline, catalogue: Callable, parts: Callable) -> Iterator[tuple]:
    """Mistakes in g, in C, in M, or in M and in the C that follows from it, as torques."""
    g, inertia, own = (catalogue(name, linear) for name in ("g_vec", "M", "C"))
    products = velocities.in_coriolis(linear)

    def of_gravity(q, qd, qdd, arms):
        M_qdd, C_qd, _ = parts(q, qd, qdd, arms)
        return M_qdd + C_qd + g.numbers(q, qd, arms)

    def of_coriolis(of: Callable) -> Callable[..., np.ndarray]:
        def torque(q, qd, qdd, arms):
            M_qdd, _, gravity = parts(q, qd, qdd, arms)
            return M_qdd + times(of(q, qd, arms), qd) + gravity

        return torque

    def of_inertia(q, qd, qdd, arms):
        _, C_qd, gravity = parts(q, qd, qdd, arms)
        return times(inertia.numbers(q, qd, arms), qdd) + C_qd + gravity

    terms, wrong = propagated(linear, inertia)

    def of_both(q, qd, qdd, arms):
        other = wrong(q, qd, arms)
        return times(other.M, qdd) + times(other.C, qd) + parts(q, qd, qdd, arms)[2]

    def linear_ones(mutants: list[Mutant], source: str, torque: Callable) -> tuple:
        kept = [k for k, m in enumerate(mutants) if _is_linear(m)]
        return [mutants[k].within(source) for k in kept], lambda *state: torque(*state)[kept]

    alike, in_M, in_g = throughout([inertia.mutants[k] for k in terms], g.mutants)

    def of_all(q, qd, qdd, arms):
        other, gravity = wrong(q, qd, arms), g.numbers(q, qd, arms)
        return times(other.M[in_M], qdd) + times(other.C[in_M], qd) + gravity[in_g]

    yield linear_ones(alike, "", of_all)
    yield linear_ones(g.mutants, "g_vec", of_gravity)
    yield linear_ones([inertia.mutants[k] for k in terms], "M and C", of_both)
    yield linear_ones(inertia.mutants, "M", of_inertia)
    yield linear_ones(own.mutants, "C", of_coriolis(own.numbers))
    yield linear_ones(products.mutants, "C", of_coriolis(products.numbers))


def _is_linear(mutant: Mutant) -> bool:
    """Whether it gives a torque that is linear in π."""
    names = (mutant.put, mutant.instead_of)
    in_pi = any(name.startswith("pi") for name in names) or mutant.operator == "kind left out"
    steps = ("inverse", "divided by M", "second kind", "energy for its derivative")
    return mutant.operator not in steps and not (in_pi and mutant.operator in OF_A_NUMBER)


REGRESSOR = Answer(
    "regressor",
    ("q", "qd", "qdd", "arm"),
    "N·m",
    lambda n: (n, -1),
    _judged,
    _case,
    (
        "Take M q̈ + C q̇ + g and multiply every product out. Which products of masses, distances to "
        "centres of mass and inertias are left?",
        "Underline in all lines what has the same product of unknown parameters. What stands beside it "
        "is its column; lengths and the gravitational acceleration are known, so they stay.",
        "To test a column, set its parameter to 1 and the others to 0, and look at every row.",
    ),
    composition=_composition,
)
