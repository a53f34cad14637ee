"""Makes the checks of a mechanism: what is asked, the right answer, and every mistake that follows."""

from collections.abc import Callable
from functools import lru_cache, partial

import numpy as np

from autograder.judging.check import Check
from autograder.judging.criterion import Criterion
from autograder.judging.diagnosis import Mistake
from autograder.judging.quantities import Numbers, Quantities, array, each, one_number, vector
from autograder.judging.terms import Term
from autograder.mechanisms import Mechanism
from autograder.mutation.answers import ANSWERS, Answer, gradient, inertia
from autograder.mutation.catalogue import Catalogue, Mutant
from autograder.mutation.generated import Generated
from autograder.mutation.references import contribution, reference
from autograder.mutation.sentences import sentence
from autograder.protocol import Call

# Random cases at least, so that no few terms fit just any error.
LEAST_CASES = 12


def checks_of(mechanism: Mechanism) -> tuple[Check, ...]:
    """One check for each answer: `cart-pole-M`, `cart-pole-C` and so on."""
    return tuple(check_of(mechanism, answer) for answer in ANSWERS)


def check_of(mechanism: Mechanism, answer: str) -> Check:
    """The check of one answer. Its mistakes are made when the first answer is wrong."""
    asked = ANSWERS[answer]
    quantities, criteria = _JUDGED[answer](mechanism)
    return Check(
        id=f"{mechanism.name}-{answer}",
        signature=asked.signature,
        reference=reference(mechanism, answer),
        calls=partial(_calls, mechanism, asked),
        quantities=quantities,
        criteria=criteria,
        terms=partial(terms_of, mechanism, answer),
        catalogue=Generated(mechanism, answer),
        hints=_hints(mechanism, asked),
        pose=lambda call: list(mechanism.points(call.args[0], call.args[-1])),
    )


@lru_cache(maxsize=64)
def catalogue_of(mechanism: Mechanism, answer: str) -> Catalogue:
    """The catalogue, made once in a process."""
    return Catalogue(mechanism, answer)


@lru_cache(maxsize=64)
def mistakes_of(mechanism: Mechanism, answer: str) -> list[Mistake]:
    """Every mistake of an answer with its sentence."""
    catalogue = catalogue_of(mechanism, answer)
    return [
        Mistake(
            " / ".join(filter(None, _places(m))),
            partial(_one, mechanism, catalogue, k),
            sentence(m, mechanism, ANSWERS[answer]),
            whole=m.is_of_whole,
            combines=m.operator not in ("doubled", "halved"),
        )
        for k, m in enumerate(catalogue.mutants)
    ]


def _places(mutant: Mutant) -> list[str]:
    where = "in the energy" if mutant.in_energy else ""
    return [
        *(mutant.operator, mutant.term, mutant.entry, mutant.put, mutant.instead_of),
        where,
    ]


def numbers_of(mechanism: Mechanism, answer: str, calls: list[Call]) -> np.ndarray:
    """What each mistake returns for each call, (mistakes, calls, …)."""
    columns = _columns(mechanism, [call.args for call in calls])
    return catalogue_of(mechanism, answer).numbers(*columns)


@lru_cache(maxsize=64)
def terms_of(mechanism: Mechanism, answer: str) -> tuple[Term, ...]:
    """The parts of the right answer, by the terms of the energy that they come from."""
    asked = ANSWERS[answer]
    energies = mechanism.kinetic if asked.of_kinetic else mechanism.potential
    return tuple(
        Term(term.name, partial(_contribution, mechanism, answer, k))
        for k, term in enumerate(energies)
    )


def _one(mechanism: Mechanism, catalogue: Catalogue, k: int, *args) -> np.ndarray:
    """What the k-th mistake returns for one call."""
    return catalogue.numbers(*_columns(mechanism, [args]))[k, 0]


def _columns(mechanism: Mechanism, calls: list[tuple]) -> tuple[np.ndarray, np.ndarray, list]:
    """q, q̇ and the arms of calls with the arguments (q, arm) or (q, qd, arm)."""
    q = np.array([args[0] for args in calls])
    qd = np.array([args[1] for args in calls]) if len(calls[0]) == 3 else np.zeros_like(q)
    return q, qd, [args[-1] for args in calls]


def _calls(mechanism: Mechanism, asked: Answer, rng: np.random.Generator, count: int) -> list[Call]:
    found = []
    for _ in range(max(count, LEAST_CASES)):
        arm, q = mechanism.drawn(rng), mechanism.placed(rng)
        if "qd" in asked.arguments:
            found.append(Call(asked.name, (q, mechanism.moving(rng), arm)))
        else:
            found.append(Call(asked.name, (q, arm)))
        if asked.name == "potential_energy":
            found.append(Call(asked.name, (mechanism.placed(rng), arm)))
    return found


def _contribution(mechanism: Mechanism, answer: str, k: int, *args) -> np.ndarray:
    return contribution(mechanism, answer, k)(*args)


def _hints(mechanism: Mechanism, asked: Answer) -> tuple[str, ...]:
    """Which energy, of which bodies, into which entries; never a formula."""
    energies = mechanism.kinetic if asked.of_kinetic else mechanism.potential
    parts = "; ".join(term.name for term in energies)
    moving = " and ".join(c.name for c in mechanism.coordinates)
    energy = "kinetic energy K" if asked.of_kinetic else "potential energy P"
    zeros = "; ".join(f"{c.name} = 0 is {c.zero}" for c in mechanism.coordinates)
    last = {
        "M": "The entry M_ij is the second derivative of K by the velocities i and j. Sort K by the "
        "products of two velocities: where do the mixed ones go?",
        "C": "Differentiate each entry of your M by each coordinate. The sum over k of h_ijk times the "
        "k-th velocity is C_ij, and h_ijk has three derivatives: two with a plus, one with a minus.",
        "g_vec": "Entry i is the derivative of P by coordinate i. Which terms change when only that "
        "coordinate moves?",
        "potential_energy": "Write the height of each body, or the stretch of each spring, as a "
        "function of the coordinates, and test it at a position where you know it.",
    }
    return (
        f"Start from the {energy}. Which bodies and springs of this mechanism have a part in it, as "
        f"{moving} change?",
        f"The parts are: {parts}. And mind where the coordinates are zero: {zeros}.",
        last[asked.name],
    )


def _of_M(mechanism: Mechanism) -> tuple[Quantities, tuple[Criterion, ...]]:
    n = mechanism.n
    entries = inertia(mechanism.K, mechanism)
    pairs = [(i, j) for i in range(n) for j in range(i, n)]
    # An entry that is 0 earns nothing by itself: an empty matrix would have it right.
    zero = [(i, j) for i, j in pairs if entries[i * n + j] == 0]
    pairs = [pair for pair in pairs if pair not in zero]

    @each
    def parts(call, value):
        M = np.reshape(value, (1, 1)) if n == 1 and np.size(value) == 1 else array(value, n, n)
        found = [M[[i, j], [j, i]] if i != j else M[[i], [i]] for i, j in pairs]
        beside = [M[a, b] for i, j in zero for a, b in ((i, j), (j, i))]
        return (np.array([*found[0], *beside]), *found[1:])

    names = [f"M{i + 1}{j + 1}" + (f" and M{j + 1}{i + 1}" if i != j else "") for i, j in pairs]
    return parts, tuple(
        Criterion(name if n > 1 else "M", _unit_of(mechanism, i, j), 1 / len(pairs))
        for name, (i, j) in zip(names, pairs, strict=True)
    )


def _of_C(mechanism: Mechanism) -> tuple[Quantities, tuple[Criterion, ...]]:
    n = mechanism.n

    @each
    def steps(call, value):
        C = np.reshape(value, (1, 1)) if n == 1 and np.size(value) == 1 else array(value, n, n)
        qd = call.args[1]
        return C @ qd, qd @ C @ qd, C + C.T

    energy = "With your C the energy would change although nobody does work."
    skew = (
        "Ṁ − 2C is not skew-symmetric with your C. A right C q̇ is not enough: how does the Christoffel "
        "form share the products of two velocities?"
    )
    return steps, (
        Criterion("vector C q̇", _mixed(mechanism, "N·m", "N"), 0.5),
        Criterion("power q̇ᵀC q̇ = ½ q̇ᵀṀ q̇", "W", 0.2, otherwise=energy, is_property=True),
        Criterion(
            "sum C + Cᵀ = Ṁ",
            _mixed(mechanism, "kg·m²/s", "kg/s"),
            0.3,
            otherwise=skew,
            is_property=True,
        ),
    )


def _of_g_vec(mechanism: Mechanism) -> tuple[Quantities, tuple[Criterion, ...]]:
    n = mechanism.n
    entries = gradient(mechanism.P, mechanism)
    judged = [i for i in range(n) if entries[i] != 0] or list(range(n))
    zero = [i for i in range(n) if i not in judged]

    @each
    def parts(call, value):
        g = vector(value, n)
        return (np.array([g[judged[0]], *g[zero]]), *(g[[i]] for i in judged[1:]))

    units = ["N·m" if c.unit == "rad" else "N" for c in mechanism.coordinates]
    return parts, tuple(
        Criterion(f"g{i + 1}" if n > 1 else "g", units[i], 1 / len(judged)) for i in judged
    )


def _of_potential_energy(mechanism: Mechanism) -> tuple[Quantities, tuple[Criterion, ...]]:
    def changes(calls: list[Call], values: list) -> Numbers:
        """Between two places of one arm: a constant, even one of each arm's own, is free."""
        P = [energy for (energy,) in one_number(calls, values)]
        return [(a - b,) for a, b in zip(P[::2], P[1::2], strict=True) for _ in range(2)]

    return changes, (Criterion("change of P between two places", "J"),)


def _unit_of(mechanism: Mechanism, i: int, j: int) -> str:
    """The unit of M_ij: a length among the coordinates takes one metre from it."""
    slides = [mechanism.coordinates[k].unit for k in (i, j)].count("m")
    return ("kg·m²", "kg·m", "kg")[slides]


def _mixed(mechanism: Mechanism, turning: str, sliding: str) -> str:
    """The unit of a vector or matrix, where its entries may have several."""
    kinds = {c.unit for c in mechanism.coordinates}
    if kinds == {"rad"}:
        return turning
    return sliding if kinds == {"m"} else f"{turning} or {sliding}"


_JUDGED: dict[str, Callable] = {
    "M": _of_M,
    "C": _of_C,
    "g_vec": _of_g_vec,
    "potential_energy": _of_potential_energy,
}
