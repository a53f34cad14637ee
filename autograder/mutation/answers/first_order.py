"""f(x, u, arm): the equation of motion in first-order form, ẋ = [q̇; M⁻¹(u − C q̇ − g − f)]."""

from collections.abc import Callable, Iterator
from functools import lru_cache, partial
from typing import TYPE_CHECKING

import numpy as np

from autograder.judging.quantities import each, vector
from autograder.mechanisms.outline import Outline
from autograder.mutation import velocities
from autograder.mutation.answers.answer import (
    Answer,
    Judged,
    by_coordinate,
    criterion,
    in_other_units,
)
from autograder.mutation.answers.composition import Composition, Group, throughout
from autograder.mutation.answers.coriolis import propagated
from autograder.mutation.friction import WORDS, torques, wrong_torques
from autograder.mutation.mutant import Mutant
from autograder.mutation.shared import shared
from autograder.mutation.steps import STEPS, Driven, rate, solved, times
from autograder.mutation.whole import whole

if TYPE_CHECKING:
    from autograder.mechanisms import Mechanism

# How often a torque is held, by what is wrong with it.
TIMES = {"dropped": 0.0, "wrong sign": -1.0, "doubled": 2.0, "halved": 0.5}


def _judged(mechanism: Outline) -> Judged:
    n = mechanism.n

    @each
    def halves(call, value):
        x = vector(value, 2 * n)
        return x[:n], x[n:]

    return halves, (
        criterion("velocities in ẋ", by_coordinate(mechanism, "rad/s", "m/s"), 0.25),
        criterion("accelerations in ẋ", by_coordinate(mechanism, "rad/s²", "m/s²"), 0.75),
    )


def _case(mechanism: "Mechanism", rng: np.random.Generator, k: int) -> list[tuple]:
    """All joints moving; one at rest; one slow, each joint in turn: what tells a sign from its like."""
    n = mechanism.n
    arm = mechanism.drawn(rng, friction=True)
    q, qd = mechanism.placed(rng), mechanism.moving(rng)
    if mechanism.friction:
        qd[k // 3 % n] *= (1.0, 0.0, 0.001)[k % 3]
    u = rng.choice([-1.0, 1.0], n) * rng.uniform(1.0, 8.0, n)
    return [(np.concatenate([q, qd + 0.0]), u, arm)]  # and no -0.0


def _columns(calls: list[tuple]) -> tuple:
    x = np.array([args[0] for args in calls])
    u = np.array([np.ravel(args[1]) for args in calls])
    return *np.split(x, 2, axis=-1), u, [args[2] for args in calls]


def _driven(mechanism: Outline, q, qd, u, arms) -> Driven:
    right = whole(mechanism)(q, qd, arms)
    friction = np.sum(torques(mechanism)(q, qd, arms), axis=0)
    return Driven(**right.named(), q=q, u=u, friction=friction)


@lru_cache(maxsize=64)
def _composition(mechanism: Outline) -> Composition:
    at = shared(partial(_driven, mechanism))

    def right(q, qd, u, arms):
        return rate(qd, at(q, qd, u, arms).acceleration)

    def groups(catalogue) -> Iterator[Group]:
        names = list(STEPS["f"])
        yield Group(
            [Mutant(name) for name in names],
            lambda *state: _each([STEPS["f"][name] for name in names], at(*state)),
        )
        yield _of_torques(at)
        yield _readings(mechanism, right)
        yield _of_friction(mechanism, at)
        if mechanism.friction:
            yield _by_input(mechanism, at)
        yield from _of_parts(mechanism, at, catalogue)

    def part(name: str) -> Callable[..., np.ndarray]:
        def numbers(*state):
            driven = at(*state)
            return rate(np.zeros_like(driven.qd), solved(driven.M, driven.torques[name]))

        return numbers

    def friction(k: int) -> Callable[..., np.ndarray]:
        def numbers(q, qd, u, arms):
            lost = -torques(mechanism)(q, qd, arms)[k]
            return rate(np.zeros_like(qd), solved(whole(mechanism)(q, qd, arms).M, lost))

        return numbers

    terms = {name: part(name) for name in ("the input u", "C q̇", "g(q)")}
    terms |= {term.name: friction(k) for k, term in enumerate(mechanism.friction)}
    return Composition(_columns, right, groups, terms)


def _each(steps: list[Callable], driven: Driven) -> np.ndarray:
    return np.array([step(driven) for step in steps])


def _of_torques(at: Callable[..., Driven]) -> Group:
    """One torque is missing or not there once; or it is not divided by M."""
    names = ["the input u", "C q̇", "g(q)", "the friction"]
    mutants = [Mutant(operator, name) for name in names for operator in TIMES]
    mutants += [Mutant("not divided by M", name) for name in names]

    def numbers(*state):
        driven = at(*state)
        found = [
            driven.rest + (factor - 1) * driven.torques[name]
            for name in names
            for factor in TIMES.values()
        ]
        found = [solved(driven.M, rest) for rest in found]
        for torque in driven.torques.values():
            found.append(solved(driven.M, driven.rest - torque) + torque)
        return rate(driven.qd, np.array(found))

    return Group(mutants, numbers)


def _readings(mechanism: Outline, right: Callable[..., np.ndarray]) -> Group:
    """x is read, or ẋ written, in another order, or x in other units."""
    names = ("state read as q̇ and q", "state interleaved", "states interleaved",
             "rate interleaved")  # fmt: skip
    converted = list(in_other_units(mechanism, np.zeros((1, mechanism.n))))

    def numbers(q, qd, u, arms):
        x = np.concatenate([q, qd], axis=-1)
        apart = right(x[:, 0::2], x[:, 1::2], u, arms)
        in_order = right(q, qd, u, arms)
        others = [right(at, qd, u, arms) for at in in_other_units(mechanism, q).values()]
        return np.array([right(qd, q, u, arms), apart, _woven(apart), _woven(in_order), *others])

    return Group([Mutant(name) for name in (*names, *converted)], numbers)


def _woven(rate: np.ndarray) -> np.ndarray:
    """Each acceleration beside its velocity."""
    woven = np.empty_like(rate)
    woven[:, 0::2], woven[:, 1::2] = np.split(rate, 2, axis=-1)
    return woven


def _of_friction(mechanism: Outline, at: Callable[..., Driven]) -> Group:
    mutants, wrong = wrong_torques(mechanism)

    def numbers(q, qd, u, arms):
        driven = at(q, qd, u, arms)
        rests = driven.rest + driven.friction - wrong(q, qd, arms)
        return rate(qd, solved(driven.M, rests))

    return Group(mutants, numbers)


def _by_input(mechanism: Outline, at: Callable[..., Driven]) -> Group:
    """Friction that goes with u where the velocity belongs: each kind of it, and all."""
    words = [WORDS.get(term.coefficient, "the friction") for term in mechanism.friction]
    chosen = [(kind, np.array([own == kind for own in words])) for kind in dict.fromkeys(words)]
    chosen.append(("the friction", np.full(len(words), True)))

    def numbers(q, qd, u, arms):
        driven = at(q, qd, u, arms)
        change = torques(mechanism)(q, qd, arms) - torques(mechanism)(q, u, arms)
        rests = [driven.rest + np.sum(change[which], axis=0) for _, which in chosen]
        return rate(qd, solved(driven.M, np.array(rests)))

    return Group([Mutant("input for velocity", kind) for kind, _ in chosen], numbers)


def _of_parts(mechanism: Outline, at: Callable[..., Driven], catalogue) -> Iterator[Group]:
    """A mistake in g, in C, in M alone, or in M and in the C that follows from it."""
    g, inertia = catalogue("g_vec"), catalogue("M")
    own, products = catalogue("C"), velocities.in_coriolis(mechanism)

    def of_gravity(q, qd, u, arms):
        driven = at(q, qd, u, arms)
        return rate(qd, solved(driven.M, driven.rest + driven.g_vec - g.numbers(q, qd, arms)))

    def of_coriolis(of: Callable) -> Callable[..., np.ndarray]:
        def numbers(q, qd, u, arms):
            driven = at(q, qd, u, arms)
            change = times(driven.C - of(q, qd, arms), qd)
            return rate(qd, solved(driven.M, driven.rest + change))

        return numbers

    def of_inertia(q, qd, u, arms):
        return rate(qd, solved(inertia.numbers(q, qd, arms), at(q, qd, u, arms).rest))

    terms, wrong = propagated(mechanism, inertia)

    def of_both(q, qd, u, arms):
        driven, other = at(q, qd, u, arms), wrong(q, qd, arms)
        return rate(qd, solved(other.M, driven.rest + times(driven.C - other.C, qd)))

    alike, in_M, in_g = throughout([inertia.mutants[k] for k in terms], g.mutants)

    def of_all(q, qd, u, arms):
        driven, other = at(q, qd, u, arms), wrong(q, qd, arms)
        torque = times(driven.C - other.C[in_M], qd)
        torque += driven.g_vec - g.numbers(q, qd, arms)[in_g]
        return rate(qd, solved(other.M[in_M], driven.rest + torque))

    yield Group(alike, of_all)
    yield Group([m.within("g_vec") for m in g.mutants], of_gravity)
    yield Group([m.within("C") for m in own.mutants], of_coriolis(own.numbers))
    yield Group([m.within("C") for m in products.mutants], of_coriolis(products.numbers))
    yield Group([m.within("M") for m in inertia.mutants], of_inertia)
    yield Group([inertia.mutants[k].within("M and C") for k in terms], of_both)


FIRST_ORDER = Answer(
    "f",
    ("x", "u", "arm"),
    "rad/s²",
    lambda n: (2 * n,),
    _judged,
    _case,
    (
        "Cut x into its two halves first. One half of ẋ is then there already, without any physics.",
        "Solve the equation of motion for M q̈. How many torques act beside u, and which of them depend "
        "on q, on q̇, or on both?",
        "Write each torque on a line of its own, with np.sign where friction is dry. Then let "
        "np.linalg.solve divide by M, and join the halves with np.concatenate.",
    ),
    friction=True,
    position=lambda args: np.split(np.asarray(args[0]), 2)[0],
    composition=_composition,
)
