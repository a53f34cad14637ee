"""Writes out the derivatives in a line, as far as the rules that are given allow."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from autograder.proofs.expression import (
    Derivative,
    Name,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Transpose,
    Unknown,
    Wave,
    minus,
    walk,
)
from autograder.proofs.parsing import LineError

MOST_NODES = 2000
ZERO, ONE = Number(0.0), Number(1.0)


class Calculus:
    """The derivatives of one world.

    definitions: name → what stands for it; that of a rate (Pdot) is under the rate's name. rates: name →
    the name of its rate, where that is drawn as a number of its own. constants: name → the variables
    ("t", "q", "qd") that it does not depend on. rules: the
    variables ("t", "q", "qd") by which products, powers and waves can be differentiated; by any other,
    the derivative stays Unknown. Sums, numbers and transposes need no rule.
    """

    def __init__(
        self,
        definitions: Mapping[str, Node],
        rates: Mapping[str, str],
        constants: Mapping[str, frozenset[str]],
        rules: frozenset[str],
    ):
        self._definitions = definitions
        self._rates = rates
        self._constants = constants
        self._rules = rules
        self.length = 0  # of what was written out last, in nodes
        self._open: set[str] = set()  # names whose definitions are being written out

    def written_out(self, node: Node) -> Node:
        """The same without Derivative and without defined names. LineError beyond MOST_NODES."""
        self.length = 0
        return self._written(node)

    def _count(self) -> None:
        self.length += 1
        if self.length > MOST_NODES:
            raise LineError("This line is too long when its derivatives are written out.")

    @contextmanager
    def _defining(self, name: str) -> Iterator[None]:
        """Two definitions may go round in a circle where a mistake is added to them."""
        if name in self._open:
            raise LineError(f"{name} is defined by itself.")
        self._open.add(name)
        try:
            yield
        finally:
            self._open.remove(name)

    def _written(self, node: Node) -> Node:
        self._count()
        match node:
            case Name(name) if name in self._definitions:
                with self._defining(name):
                    return self._written(self._definitions[name])
            case Derivative(of, by):
                return self._derivative(of, by)
            case Sum(terms):
                return Sum(tuple(map(self._written, terms)))
            case Product(factors):
                return Product(tuple(map(self._written, factors)))
            case Quotient(over, under):
                return Quotient(self._written(over), self._written(under))
            case Power(base, exponent):
                return Power(self._written(base), exponent)
            case Transpose(of):
                return Transpose(self._written(of))
            case Wave(function, of):
                return Wave(function, self._written(of))
            case Unknown(of, by):
                return Unknown(self._written(of), by)
        return node

    def _derivative(self, node: Node, by: str) -> Node:
        self._count()
        match node:
            case Name(name):
                return self._of_name(name, by)
            case Derivative(of, inner):
                return self._derivative(self._derivative(of, inner), by)
            case Sum(terms):
                return Sum(tuple(self._derivative(term, by) for term in terms))
            case Transpose(of):
                return Transpose(self._derivative(of, by))
            case Quotient(over, under) if _is_number(under):
                return Quotient(self._derivative(over, by), under)
            case Product(factors):
                numbers = tuple(factor for factor in factors if _is_number(factor))
                others = tuple(factor for factor in factors if not _is_number(factor))
                if len(others) == 1:
                    return Product((*numbers, self._derivative(others[0], by)))
        if _is_number(node):
            return ZERO
        return self._by_rule(node, by) if by in self._rules else Unknown(self._written(node), by)

    def _of_name(self, name: str, by: str) -> Node:
        if by == "t" and name in self._rates:
            return self._written(Name(self._rates[name]))
        if name in self._definitions:
            with self._defining(name):
                return self._derivative(self._definitions[name], by)
        if name == by:
            return ONE
        fixed = by in self._constants.get(name, ())
        return ZERO if fixed and by in self._rules else Unknown(Name(name), by)

    def _by_rule(self, node: Node, by: str) -> Node:
        match node:
            case Product(factors):
                terms = []
                for at, factor in enumerate(factors):
                    changed = self._derivative(factor, by)
                    if changed != ZERO:
                        rest = [self._written(other) for other in factors]
                        terms.append(Product((*rest[:at], changed, *rest[at + 1 :])))
                return Sum(tuple(terms)) if terms else ZERO
            case Quotient(over, under):
                top, bottom = self._written(over), self._written(under)
                first = Quotient(self._derivative(over, by), bottom)
                second = Quotient(Product((top, self._derivative(under, by))), Power(bottom, 2))
                return Sum((first, minus(second)))
            case Power(base, -1):
                inverse = Power(self._written(base), -1)
                return minus(Product((inverse, self._derivative(base, by), inverse)))
            case Power(base, 1):
                return self._derivative(base, by)
            case Power(base, exponent):
                return self._by_rule(Product((base,) * exponent), by)
            case Wave(function, of):
                inner, changed = self._written(of), self._derivative(of, by)
                if function == "sin":
                    return Product((Wave("cos", inner), changed))
                return minus(Product((Wave("sin", inner), changed)))
        return Unknown(self._written(node), by)


def _is_number(node: Node) -> bool:
    return not any(isinstance(part, Name | Derivative | Unknown) for part in walk(node))
