"""A line that would follow but for one slip: a sign, a factor 2, sine for cosine."""

from collections.abc import Callable, Iterator
from dataclasses import replace

from autograder.proofs.expression import (
    Derivative,
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
)

MOST_TRIED = 60  # lines in all
OPPOSITE = "With the opposite sign, this line would follow."
SIGN = "With another sign of one term of this line, it would follow. Which term is it?"
FACTOR = "One term of this line has half or twice the factor with which it would follow. Which one?"
WAVE = (
    "With a sine and a cosine exchanged in one place of this line, it would follow. What is the "
    "derivative of each?"
)


def slips(node: Node) -> Iterator[tuple[Node, str]]:
    """The line with one slip mended, in each way and place, and what is said of it."""
    yield minus(node), OPPOSITE
    tried = 0
    for said, change in ((SIGN, _signs), (FACTOR, _factors), (WAVE, _waves)):
        for mended in _everywhere(node, change):
            tried += 1
            if tried > MOST_TRIED:
                return
            yield mended, said


def _signs(node: Node, _whole: bool) -> Iterator[Node]:
    yield from _of_terms(node, minus)


def _factors(node: Node, whole: bool) -> Iterator[Node]:
    for factor in (2.0, 0.5):

        def times(term: Node, factor: float = factor) -> Node:
            return Product((Number(factor), term))

        if whole and not isinstance(node, Sum):
            yield times(node)
        yield from _of_terms(node, times)


def _of_terms(node: Node, change: Callable[[Node], Node]) -> Iterator[Node]:
    if isinstance(node, Sum):
        for at, term in enumerate(node.terms):
            yield Sum((*node.terms[:at], change(term), *node.terms[at + 1 :]))


def _waves(node: Node, _whole: bool) -> Iterator[Node]:
    if isinstance(node, Wave):
        yield Wave("cos" if node.function == "sin" else "sin", node.of)


def _everywhere(
    node: Node, change: Callable[[Node, bool], Iterator[Node]], whole: bool = True
) -> Iterator[Node]:
    """The line with the change in one place. whole: whether the node is all of it."""
    yield from change(node, whole)
    match node:
        case Sum(terms):
            for at, term in enumerate(terms):
                for changed in _everywhere(term, change, False):
                    yield Sum((*terms[:at], changed, *terms[at + 1 :]))
        case Product(factors):
            for at, factor in enumerate(factors):
                for changed in _everywhere(factor, change, False):
                    yield Product((*factors[:at], changed, *factors[at + 1 :]))
        case Quotient(over, under):
            for changed in _everywhere(over, change, False):
                yield Quotient(changed, under)
        case Transpose(of) | Wave(_, of) | Derivative(of, _) | Unknown(of, _):
            for changed in _everywhere(of, change, False):
                yield replace(node, of=changed)
        case Power(base, _):
            for changed in _everywhere(base, change, False):
                yield replace(node, base=changed)
