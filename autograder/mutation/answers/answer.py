"""What an answer is: its function, how it follows from the energies, and how it is judged."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np

from autograder.judging.criterion import Criterion
from autograder.judging.quantities import Quantities
from autograder.protocol import Call

if TYPE_CHECKING:
    import sympy as sp

    from autograder.mechanisms import EnergyTerm, Mechanism
    from autograder.mechanisms.outline import Outline
    from autograder.mutation.answers.composition import Composition

# Random cases at least, so that no few terms fit just any error.
LEAST_CASES = 12

Judged = tuple[Quantities, tuple[Criterion, ...]]
Derived = Callable[["sp.Expr", "Mechanism"], "list[sp.Expr]"]


@dataclass(frozen=True)
class Answer:
    """What a student's function returns, how it follows from the energies, and how it is judged.

    shape(n): of the array, as of the entries in a row below; −1 for a number that is the mechanism's.
    judged(mechanism): the quantities and criteria of its check. case(mechanism, rng, k): the arguments
    of the k-th call or calls. hints: all three, or the last alone, which says how to derive it.
    of_kinetic, of_potential: what a term of K or of P contributes to its entries, in a row; None where
    it contributes nothing. symmetric: whether the entries ij and ji are one. friction: whether its arms
    have friction. position: q of a call's arguments. composition(mechanism): how it is made of other
    answers, where it is not linear in the energies, or where a mistake in another answer shows in it.
    """

    name: str
    arguments: tuple[str, ...]
    unit: str
    shape: Callable[[int], tuple[int, ...]]
    judged: Callable[[Mechanism], Judged]
    case: Callable[[Mechanism, np.random.Generator, int], list[tuple]]
    hints: tuple[str, ...]
    of_kinetic: Derived | None = None
    of_potential: Derived | None = None
    symmetric: bool = False
    friction: bool = False
    position: Callable[[tuple], np.ndarray] = lambda args: args[0]
    composition: Callable[[Outline], Composition] | None = None

    @property
    def signature(self) -> str:
        return f"{self.name}({', '.join(self.arguments)})"

    @property
    def head(self) -> str:
        """How sentences call it: g for g_vec."""
        return HEADS.get(self.name, self.name)

    @property
    def returned(self) -> str:
        """How a place in what it returns is written: `Y[0, 5]`, `g[1]`."""
        return {"regressor": "Y", "g_vec": "g"}.get(self.name, self.name)

    def terms(self, mechanism: Mechanism) -> Iterator[tuple[EnergyTerm, Derived]]:
        """The terms of the energies that it follows from, with what derives it from them."""
        for energies, derived in (
            (mechanism.kinetic, self.of_kinetic),
            (mechanism.potential, self.of_potential),
        ):
            if derived:
                yield from ((term, derived) for term in energies)

    def term_names(self, mechanism: Outline) -> list[str]:
        """The names of these terms, for which no formula is needed."""
        kinetic = mechanism.kinetic if self.of_kinetic else ()
        potential = mechanism.potential if self.of_potential else ()
        return [term.name for term in (*kinetic, *potential)]

    def entries(self, mechanism: Mechanism) -> list[sp.Expr]:
        """The right entries, in a row."""
        import sympy as sp

        parts = [
            derived(energy, mechanism)
            for energy, derived in (
                (mechanism.K, self.of_kinetic),
                (mechanism.P, self.of_potential),
            )
            if derived
        ]
        return [sp.Add(*entry) for entry in zip(*parts, strict=True)]

    def calls(self, mechanism: Mechanism, rng: np.random.Generator, count: int) -> list[Call]:
        return [
            Call(self.name, args)
            for k in range(max(count, LEAST_CASES))
            for args in self.case(mechanism, rng, k)
        ]


HEADS = {"g_vec": "g", "potential_energy": "P", "M_dot": "Ṁ", "lagrangian": "L", "f": "q̈",
         "energy_drift": "drift", "regressor": "Y"}  # fmt: skip


def at_rest(mechanism: Mechanism, rng: np.random.Generator, k: int) -> list[tuple]:
    """Arguments (q, arm)."""
    arm = mechanism.drawn(rng)
    return [(mechanism.placed(rng), arm)]


def in_motion(mechanism: Mechanism, rng: np.random.Generator, k: int) -> list[tuple]:
    """Arguments (q, q̇, arm)."""
    arm, q = mechanism.drawn(rng), mechanism.placed(rng)
    return [(q, mechanism.moving(rng), arm)]


def states(calls: list[tuple]) -> tuple[np.ndarray, np.ndarray, list[SimpleNamespace]]:
    """q, q̇ (cases, n) and the arms of calls with the arguments (q, arm) or (q, q̇, arm)."""
    q = np.array([args[0] for args in calls])
    qd = np.array([args[1] for args in calls]) if len(calls[0]) == 3 else np.zeros_like(q)
    return q, qd, [args[-1] for args in calls]


def in_other_units(mechanism: Outline, q: np.ndarray) -> dict[str, np.ndarray]:
    """The angles among q (cases, n) converted where they need not be, by the operator's name."""
    turning = np.array([c.unit == "rad" for c in mechanism.coordinates])
    return {
        "radians converted": np.where(turning, np.radians(q), q),
        "angle in degrees": np.where(turning, np.degrees(q), q),
    }


def unit_of_inertia(mechanism: Outline, i: int, j: int) -> str:
    """The unit of M_ij: a length among the coordinates takes one metre from it."""
    slides = [mechanism.coordinates[k].unit for k in (i, j)].count("m")
    return ("kg·m²", "kg·m", "kg")[slides]


def by_coordinate(mechanism: Outline, turning: str, sliding: str) -> tuple[str, ...]:
    """The units of a vector's entries."""
    return tuple(turning if c.unit == "rad" else sliding for c in mechanism.coordinates)


def criterion(text: str, units: Sequence[str], share: float, **more: Any) -> Criterion:
    """One whose numbers have these units, row by row."""
    return Criterion(text, " or ".join(dict.fromkeys(units)), share, units=tuple(units), **more)
