"""A line in numbers: its values in many worlds at once, and how large its parts are.

Every value is a stack of matrices, (B, rows, columns), one for each world; a vector is one column.
"""

import functools
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from autograder.proofs.expression import (
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
)
from autograder.proofs.parsing import LineError

LARGEST = 1e7


@dataclass(frozen=True)
class Value:
    """numbers: (B, rows, columns). size: of the same shape, the sum of the magnitudes that were added
    up, which bounds the rounding.
    """

    numbers: np.ndarray
    size: np.ndarray

    @property
    def shape(self) -> tuple[int, int]:
        return self.numbers.shape[1:]

    @property
    def is_zero(self) -> bool:
        return not self.numbers.any() and not self.size.any()


def value_of(
    node: Node,
    numbers: Mapping[str, np.ndarray],
    unknown: Callable[[np.ndarray, str], np.ndarray],
) -> Value:
    """The value of a tree without Derivative. unknown(x, by): the Unknown derivative of a value.

    LineError where shapes do not fit, or where the numbers are too large to be compared.
    """
    with np.errstate(all="ignore"):
        value = _value(node, numbers, unknown)
    if not np.isfinite(value.size).all() or value.size.max() > LARGEST:
        raise LineError("The numbers of this line are too large to be compared.")
    return value


def _value(
    node: Node,
    numbers: Mapping[str, np.ndarray],
    unknown: Callable[[np.ndarray, str], np.ndarray],
) -> Value:
    def of(part: Node) -> Value:
        return _value(part, numbers, unknown)

    match node:
        case Number(number):
            made = np.full((1, 1, 1), number)
            return Value(made, abs(made))
        case Name(name):
            return Value(numbers[name], abs(numbers[name]))
        case Sum(terms):
            return _sum([of(term) for term in terms])
        case Product(factors):
            return functools.reduce(_product, map(of, factors))
        case Quotient(over, under):
            top, bottom = of(over), of(under)
            if bottom.shape != (1, 1):
                raise LineError(f"You divide by {kind(bottom)}; only a number divides.")
            return _product(top, _inverse(bottom))
        case Power(base, exponent):
            return _power(of(base), exponent)
        case Transpose(inner):
            value = of(inner)
            return Value(np.swapaxes(value.numbers, 1, 2), np.swapaxes(value.size, 1, 2))
        case Wave(function, inner):
            value = of(inner)
            if value.shape != (1, 1):
                raise LineError(f"{function} is taken of a number, not of {kind(value)}.")
            made = np.sin(value.numbers) if function == "sin" else np.cos(value.numbers)
            return Value(made, np.maximum(1.0, value.size))
        case Unknown(inner, by):
            value = of(inner)
            return Value(
                unknown(value.numbers, by), abs(unknown(value.size, by)) + value.size.max()
            )
    raise TypeError(f"no value of {node!r}")


def _sum(terms: list[Value]) -> Value:
    terms = [term for term in terms if not term.is_zero] or terms[:1]
    total = terms[0]
    for term in terms[1:]:
        if term.shape != total.shape:
            raise LineError(f"You add {kind(term)} to {kind(total)}.")
        total = Value(total.numbers + term.numbers, total.size + term.size)
    return total


def _product(a: Value, b: Value) -> Value:
    if (1, 1) in (a.shape, b.shape):
        return Value(a.numbers * b.numbers, a.size * b.size)
    if a.shape[1] != b.shape[0]:
        hint = " A scalar product is a' b." if a.shape == b.shape and a.shape[1] == 1 else ""
        raise LineError(f"The product of {kind(a)} and {kind(b)} does not fit.{hint}")
    return Value(a.numbers @ b.numbers, a.size @ b.size)


def _power(base: Value, exponent: int) -> Value:
    if exponent == -1:
        return _inverse(base)
    if base.shape[0] != base.shape[1]:
        raise LineError(f"There is no power of {kind(base)}. The square of a length is a' a.")
    made = base
    for _ in range(exponent - 1):
        made = _product(made, base)
    return made


def _inverse(base: Value) -> Value:
    if base.shape[0] != base.shape[1]:
        raise LineError(f"There is no inverse of {kind(base)}.")
    try:
        made = np.linalg.inv(base.numbers)
    except np.linalg.LinAlgError:
        raise LineError("This line divides by zero, or inverts a singular matrix.") from None
    condition = np.abs(base.numbers).max((1, 2)) * np.abs(made).max((1, 2))
    return Value(made, abs(made) * np.maximum(1.0, condition)[:, None, None])


def kind(value: Value) -> str:
    """What it is, in words."""
    rows, columns = value.shape
    if value.shape == (1, 1):
        return "a number"
    if columns == 1:
        return f"a column of {rows}"
    if rows == 1:
        return f"a row of {columns}"
    return f"a {rows}×{columns} matrix"
