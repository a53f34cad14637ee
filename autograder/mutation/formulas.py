"""Numbers from a mechanism's formulas, for many states at once.

The formulas are kept as a tape, so that SymPy makes them once on a machine.
"""

from collections.abc import Callable, Sequence
from types import SimpleNamespace
from typing import TYPE_CHECKING

import numpy as np

from autograder.mechanisms.outline import Outline
from autograder.mutation import kept
from autograder.mutation.shared import shared
from autograder.mutation.tape import Tape

if TYPE_CHECKING:
    import sympy as sp

    from autograder.mechanisms import Mechanism

Make = Callable[["Mechanism"], "list[sp.Expr]"]
# From q, q̇ (cases, n) and the arms, one a case, to an array (formulas, cases).
Numbers = Callable[..., np.ndarray]


def formulas(
    mechanism: Outline, parts: tuple[str, ...], make: Make, count: int, friction: bool = False
) -> Numbers:
    """The numbers of so many formulas. make: gives them, and is called where none are kept yet.

    parts: what tells them from others of the mechanism. friction: whether they hold its coefficients.
    """

    def made() -> dict:
        from autograder.mutation.taping import taped

        full = mechanism.full
        return taped(symbols(full, friction), make(full)).as_data()

    def read(data: dict) -> Tape:
        tape = Tape.from_data(data)
        if (tape.inputs, len(tape.outputs)) != (inputs, count):
            raise ValueError("the tape is not that of these formulas")
        return tape

    inputs = len(mechanism.coordinates) * 2 + len(mechanism.parameters)
    inputs += len(mechanism.friction) if friction else 0
    tape = kept.entry(("formulas", *kept.definition(mechanism), *parts), made, read)

    @shared
    def numbers(q, qd, arms) -> np.ndarray:
        with np.errstate(all="ignore"):  # a wrong term may have no value everywhere
            return tape(columns(mechanism, q, qd, arms, friction))

    return numbers


def columns(
    mechanism: Outline, q, qd, arms: Sequence[SimpleNamespace], friction: bool = False
) -> np.ndarray:
    """What a tape takes, (inputs, cases), in the order of `symbols`."""
    parameters = [[getattr(arm, p.name) for arm in arms] for p in mechanism.parameters]
    if friction:
        parameters += [
            [getattr(arm, term.coefficient)[mechanism.place(term)] for arm in arms]
            for term in mechanism.friction
        ]
    return np.array([*np.transpose(q), *np.transpose(qd), *parameters])


def symbols(mechanism: "Mechanism", friction: bool = False) -> "list[sp.Symbol]":
    """q, q̇, the parameters, and the coefficients of friction."""
    found = [*mechanism.q, *mechanism.qd, *(p.symbol for p in mechanism.parameters)]
    return found + [term.symbol for term in mechanism.friction] if friction else found
