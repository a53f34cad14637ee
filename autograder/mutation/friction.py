"""Friction in numbers: the right torques, and those of each mistake."""

from collections.abc import Callable
from dataclasses import astuple
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from autograder.mechanisms.outline import Outline
from autograder.mutation import kept
from autograder.mutation.formulas import formulas
from autograder.mutation.mutant import Mutant

if TYPE_CHECKING:
    import sympy as sp

    from autograder.mechanisms import Mechanism

# A kind of friction, by the coefficient of its terms.
WORDS = {"viscous": "the viscous friction", "coulomb": "the Coulomb friction"}


@lru_cache(maxsize=64)
def torques(mechanism: Outline) -> Callable[..., np.ndarray]:
    """A function of q, q̇ (cases, n) and arms to the right torque of each term, (terms, cases, n)."""

    def right(of: "Mechanism") -> "list[dict[int, sp.Expr]]":
        return [{k: term.torque} for k, term in enumerate(of.friction)]

    return _rows(mechanism, "friction", right, len(mechanism.friction))


@lru_cache(maxsize=64)
def wrong_torques(mechanism: Outline) -> tuple[list[Mutant], Callable[..., np.ndarray]]:
    """The mistakes, and a function to the whole friction of each, (mutants, cases, n)."""

    def wrong(of: "Mechanism") -> "list[tuple[Mutant, dict[int, sp.Expr]]]":
        from autograder.mutation.wrong_friction import mistakes

        return mistakes(of)

    def made() -> dict:
        return {"mutants": [astuple(mutant) for mutant, _ in wrong(mechanism.full)]}

    def read(data: dict) -> list[Mutant]:
        return [Mutant(*fields) for fields in data["mutants"]]

    mutants = kept.entry(("mistakes in friction", *kept.definition(mechanism)), made, read)
    numbers = _rows(
        mechanism,
        "wrong friction",
        lambda of: [changed for _, changed in wrong(of)],
        len(mutants),
    )
    return mutants, numbers


def _rows(
    mechanism: Outline,
    name: str,
    rows: "Callable[[Mechanism], list[dict[int, sp.Expr]]]",
    count: int,
) -> Callable[..., np.ndarray]:
    """For each row the sum of its terms' torques, at the coordinates they resist: (rows, cases, n).

    rows(mechanism): each a torque by the place of its term, called where none are kept.
    """
    n = mechanism.n

    def entries(of: "Mechanism") -> "list[sp.Expr]":
        return [
            sum(torque for k, torque in row.items() if of.place(of.friction[k]) == i)
            for row in rows(of)
            for i in range(n)
        ]

    numbers = formulas(mechanism, (name,), entries, count * n, friction=True)

    def function(q, qd, arms) -> np.ndarray:
        return np.moveaxis(numbers(q, qd, arms).reshape(count, n, len(q)), 1, -1)

    return function
