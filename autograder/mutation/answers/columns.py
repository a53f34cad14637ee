"""What people do wrong with whole columns of a regressor Y, and the entries of π that they belong to."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from autograder.mechanisms.outline import Outline, Parameter
from autograder.mutation.answers.composition import Group
from autograder.mutation.formulas import Numbers, formulas
from autograder.mutation.in_pi import in_pi
from autograder.mutation.mutant import Mutant

if TYPE_CHECKING:
    import sympy as sp

    from autograder.mechanisms import Mechanism

# What becomes of a part of an answer.
TIMES = {"dropped": 0.0, "wrong sign": -1.0, "doubled": 2.0, "halved": 0.5}


def pi_of(mechanism: Outline) -> list[Parameter]:
    """π, in order; doc: what an entry is made of, as I1 + m1·lc1²."""
    return [p for p in in_pi(mechanism).parameters if not p.known]


def values_of(mechanism: Outline) -> Numbers:
    """A function of q, q̇ and the arms to π, (entries, cases)."""

    def made(of: Mechanism) -> list[sp.Expr]:
        from autograder.mutation.inertial_parameters import inertial_parameters

        return [pi.value for pi in inertial_parameters(of)]

    return formulas(mechanism, ("pi",), made, len(pi_of(mechanism)))


def of_columns(mechanism: Outline, right: Callable[..., np.ndarray]) -> Group:
    """Columns in another order, missing, of the wrong sign, with their parameters in them, or with what
    belongs to another one. right: gives Y, (cases, n, p).
    """
    entries, values = pi_of(mechanism), values_of(mechanism)
    orders = _orders([pi.unit for pi in entries])
    rows: list[list[int]] = [list(range(mechanism.n)), *([i] for i in range(mechanism.n))]
    changes = [
        (Mutant(operator, f"the column of {pi.doc}", _row(row)), row, k, TIMES[operator])
        for operator in TIMES
        for k, pi in enumerate(entries)
        for row in rows
    ]

    taken = list(itertools.permutations(range(len(entries)), 2))

    def numbers(q, qd, qdd, arms):
        Y = right(q, qd, qdd, arms)
        pi = values(q, qd, arms).T
        found = [Y * pi[:, np.newaxis], Y[:, ::-1], -Y]
        found += [Y[..., order] for order in orders]
        for _, row, column, factor in changes:
            wrong = Y.copy()
            wrong[:, row, column] *= factor
            found.append(wrong)
        for source, target in taken:
            wrong = Y.copy()
            wrong[..., target] = Y[..., source]
            found.append(wrong)
        return np.array(found)

    names = ("parameters inside", "joints exchanged", "sign of the whole")
    mutants = [Mutant(name) for name in names]
    words = [pi.doc for pi in entries]
    mutants += [
        Mutant("columns in another order", detail=", ".join(words[k] for k in order))
        for order in orders
    ]
    mutants += [mutant for mutant, *_ in changes]
    mutants += [
        Mutant("column of another", f"the column of {entries[target].doc}", put=entries[source].doc)
        for source, target in taken
    ]
    return Group(mutants, numbers)


def _row(rows: list[int]) -> str:
    return f"row {rows[0] + 1}" if len(rows) == 1 else ""


def _orders(units: list[str]) -> list[list[int]]:
    """Orders in which people write columns: from the end, by kind, or two of them exchanged."""
    places = list(range(len(units)))
    found = [places[::-1]]
    for kinds in itertools.permutations(dict.fromkeys(units)):
        found.append([k for kind in kinds for k in places if units[k] == kind])
    for a, b in itertools.combinations(places, 2):
        exchanged = places.copy()
        exchanged[a], exchanged[b] = b, a
        found.append(exchanged)
    return found
