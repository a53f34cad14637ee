"""The tree of a line: what a student's text becomes, and nothing that can run."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Number:
    value: float


@dataclass(frozen=True)
class Name:
    name: str


@dataclass(frozen=True)
class Sum:
    terms: tuple["Node", ...]


@dataclass(frozen=True)
class Product:
    """Factors in their order: matrices do not commute."""

    factors: tuple["Node", ...]


@dataclass(frozen=True)
class Quotient:
    over: "Node"
    under: "Node"


@dataclass(frozen=True)
class Power:
    """exponent: a whole number; −1 is the inverse of a matrix."""

    base: "Node"
    exponent: int


@dataclass(frozen=True)
class Transpose:
    of: "Node"


@dataclass(frozen=True)
class Wave:
    """The sine or cosine of a number."""

    function: str
    of: "Node"


@dataclass(frozen=True)
class Derivative:
    """d/dt where `by` is "t", else the partial derivative by a coordinate or velocity."""

    of: "Node"
    by: str


@dataclass(frozen=True)
class Unknown:
    """A derivative whose rule is not given: some linear function of its operand, always the same."""

    of: "Node"
    by: str


Node = Number | Name | Sum | Product | Quotient | Power | Transpose | Wave | Derivative | Unknown


def parts(node: Node) -> tuple[Node, ...]:
    """The nodes directly below."""
    match node:
        case Sum(terms):
            return terms
        case Product(factors):
            return factors
        case Quotient(over, under):
            return over, under
        case Power(base, _):
            return (base,)
        case Transpose(of) | Wave(_, of) | Derivative(of, _) | Unknown(of, _):
            return (of,)
    return ()


def walk(node: Node) -> Iterator[Node]:
    """The node and all below it."""
    yield node
    for part in parts(node):
        yield from walk(part)


def minus(node: Node) -> Node:
    return Product((Number(-1.0), node))


def names_in(node: Node, rates: Mapping[str, str]) -> set[str]:
    """The names in a line, a rate by its own; "a derivative" for any other derivative."""
    found = set()
    for part in walk(node):
        match part:
            case Derivative(Name(name), "t") if name in rates:
                found.add(rates[name])
            case Derivative():
                found.add("a derivative")
            case Name(name):
                found.add(name)
    return found
