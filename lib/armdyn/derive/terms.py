"""Sums and products that stay as they are written, so that what they share is found again.

SymPy multiplies out and flattens as it builds. A `Term` does not: it drops zeros and ones, keeps signs
in front, and gives the same node whenever the same operation comes again.
"""

import numbers
from collections.abc import Iterable

import sympy as sp


class Terms:
    """Makes the terms of one derivation, each node once."""

    def __init__(self):
        self._nodes: dict[sp.Expr, int] = {}
        self._kept: list[sp.Expr] = []

    def __call__(self, value) -> "Term":
        """A number or an expression as a term."""
        if isinstance(value, Term):
            return value
        if isinstance(value, numbers.Real) or (isinstance(value, sp.Expr) and value.is_Number):
            return Term(self, float(value), None)
        return Term(self, 1.0, self.node(value))

    def node(self, expression: sp.Expr) -> sp.Expr:
        """The one node for this expression."""
        place = self._nodes.setdefault(expression, len(self._kept))
        if place == len(self._kept):
            self._kept.append(expression)
        return self._kept[place]

    def ordered(self, expressions: Iterable[sp.Expr]) -> list[sp.Expr]:
        """In the order in which they were made, which is the same in every run."""
        return sorted(expressions, key=self._nodes.__getitem__)

    def sum(self, terms: Iterable) -> "Term":
        """Σ terms as one node."""
        number = 0.0
        addends: dict[sp.Expr, float] = {}
        for term in map(self, terms):
            if term.node is None:
                number += term.factor
            else:
                addends[term.node] = addends.get(term.node, 0.0) + term.factor
        addends = {node: factor for node, factor in addends.items() if factor != 0}
        if not addends:
            return Term(self, number, None)
        if number == 0 and len(addends) == 1:
            [(node, factor)] = addends.items()
            return Term(self, factor, node)
        # The sign of the sum in front of it, so that it is the same node as its negative.
        nodes = self.ordered(addends)
        sign = -1.0 if addends[nodes[0]] < 0 else 1.0
        parts = [self._scaled(sign * addends[node], node) for node in nodes]
        if number != 0:
            parts.append(self._number(sign * number))
        return Term(self, sign, self.node(sp.Add(*parts, evaluate=False)))

    def product(self, a: "Term", b: "Term") -> "Term":
        """a b, with the numbers in front."""
        factor = a.factor * b.factor
        if factor == 0 or (a.node is None and b.node is None):
            return Term(self, factor, None)
        if a.node is None or b.node is None:
            return Term(self, factor, a.node if b.node is None else b.node)
        # A number before one factor of a product is a node, which others may share.
        sign = -1.0 if factor < 0 else 1.0
        parts = [self._scaled(abs(t.factor), t.node) for t in (a, b)]
        if parts[0] == parts[1]:
            return Term(self, sign, self.node(sp.Pow(parts[0], 2, evaluate=False)))
        return Term(self, sign, self.node(sp.Mul(*self.ordered(parts), evaluate=False)))

    def _scaled(self, factor, node):
        if factor == 1:
            return node
        return self.node(sp.Mul(self._number(factor), node, evaluate=False))

    def _number(self, value):
        """The one node for a number."""
        return self.node(sp.Integer(value) if value in (-1, 0, 1) else sp.Float(value))


class Term:
    """A number times a node, or a number alone; + − and × with terms and numbers."""

    __slots__ = ("factor", "node", "terms")

    def __init__(self, terms: Terms, factor: float, node: sp.Expr | None):
        self.terms, self.factor, self.node = terms, factor, node

    @property
    def expression(self) -> sp.Expr:
        """The term in SymPy."""
        if self.node is None:
            return self.terms._number(self.factor)
        return self.terms._scaled(self.factor, self.node)

    @property
    def is_zero(self) -> bool:
        return self.factor == 0

    def __neg__(self):
        return Term(self.terms, -self.factor, self.node)

    def __add__(self, other):
        return self.terms.sum((self, other))

    __radd__ = __add__

    def __sub__(self, other):
        return self.terms.sum((self, -other))

    def __rsub__(self, other):
        return self.terms.sum((-self, other))

    def __mul__(self, other):
        return self.terms.product(self, self.terms(other))

    __rmul__ = __mul__
