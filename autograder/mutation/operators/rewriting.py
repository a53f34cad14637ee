"""A wrong form of a term, and what is found in a term's expressions."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import sympy as sp

from autograder.mechanisms import Mechanism, Parameter


@dataclass(frozen=True)
class Rewriting:
    """A wrong form of expressions. operator: its name; put, instead_of: what stands there, and should
    not; detail: what else tells it from others of the operator.
    """

    operator: str
    expressions: sp.Tuple
    put: str = ""
    instead_of: str = ""
    entry: str = ""
    detail: str = ""


Operator = Callable[[sp.Tuple, Mechanism], Iterator[Rewriting]]


def times(factor, term: sp.Tuple) -> sp.Tuple:
    return sp.Tuple(*(factor * expression for expression in term))


def waves(term: sp.Tuple) -> list[sp.Expr]:
    """Its sines and cosines."""
    return sorted(term.atoms(sp.sin, sp.cos), key=sp.default_sort_key)


def angles(term: sp.Tuple) -> list[sp.Expr]:
    """Of which sines and cosines are taken."""
    return list(dict.fromkeys(wave.args[0] for wave in waves(term)))


def pairs(term: sp.Tuple, mechanism: Mechanism) -> Iterator[tuple[Parameter, Parameter]]:
    """A parameter of the term, and another parameter of its unit."""
    for parameter in mechanism.parameters:
        for other in mechanism.parameters:
            there = parameter.symbol in term.free_symbols
            if there and other.unit == parameter.unit and other != parameter:
                yield parameter, other
