"""What a line looks like, and not only what its value is: whether it shows a form as a whole."""

import numpy as np

from autograder.proofs.derivation import Derivation, Form
from autograder.proofs.evaluating import Value
from autograder.proofs.expression import (
    Derivative,
    Name,
    Node,
    Power,
    Quotient,
    Sum,
    Transpose,
    names_in,
    parts,
    walk,
)
from autograder.proofs.parsing import LineError
from autograder.proofs.steps import ROUNDING, Worlds

MOTION = frozenset({"qd", "v1", "v2"})


def divides_by_motion(node: Node) -> bool:
    """Whether a velocity stands below a fraction line."""
    below = []
    for part in walk(node):
        match part:
            case Quotient(_, under) | Power(under, -1):
                below.append(under)
    return any(Name(name) in walk(under) for under in below for name in MOTION)


def half(node: Node) -> Node | None:
    """X of X + X'."""
    match node:
        case Sum((first, Transpose(second))) if first == second:
            return first
    return None


def shows(node: Node, form: Form, derivation: Derivation, worlds: Worlds) -> bool:
    """Whether one of the form's ways stands in the line, and nothing of it stands elsewhere in it."""
    return any(
        _Looking(tuple(map(derivation.read, way)), derivation, worlds).finds_all_in(node)
        for way in form.ways
    )


class _Looking:
    def __init__(self, wanted: tuple[Node, ...], derivation: Derivation, worlds: Worlds):
        self._rates = derivation.subject.rates
        self._wanted = wanted
        self._names = [names_in(one, self._rates) for one in wanted]
        self._world = worlds.given(())
        self._found = set[int]()

    def finds_all_in(self, node: Node) -> bool:
        outside = self._outside(node)
        return len(self._found) == len(self._wanted) and not outside & set().union(*self._names)

    def _outside(self, node: Node) -> set[str]:
        """The names that stand outside what is looked for."""
        if (at := self._which(node)) is not None:
            self._found.add(at)
            return set()
        inner = parts(node)
        if not inner or isinstance(node, Derivative):
            return names_in(node, self._rates)
        return set().union(*map(self._outside, inner))

    def _which(self, node: Node) -> int | None:
        names = names_in(node, self._rates)
        for at, wanted in enumerate(self._wanted):
            if names == self._names[at] and self._is_multiple(node, wanted):
                return at
        return None

    def _is_multiple(self, node: Node, of: Node) -> bool:
        """Whether it is the other by a constant factor, transposed or not."""
        try:
            value, other = self._world.value(node), self._world.value(of)
        except LineError:
            return False
        turned = Value(np.swapaxes(other.numbers, 1, 2), np.swapaxes(other.size, 1, 2))
        return _proportional(value, other) or _proportional(value, turned)


def _proportional(value: Value, other: Value) -> bool:
    if value.shape != other.shape:
        return False
    factor = np.sum(value.numbers * other.numbers) / np.sum(other.numbers**2)
    bound = ROUNDING * (value.size + abs(factor) * other.size)
    return factor != 0 and bool((abs(value.numbers - factor * other.numbers) <= bound).all())
