"""Reads what a student's function returned as plain numbers, and writes these as JSON."""

import numbers
from collections.abc import Mapping
from contextlib import suppress
from enum import StrEnum
from functools import lru_cache
from types import SimpleNamespace

import numpy as np

from .words import described

# A reply of 24 such answers is not yet too long for the sandbox to send.
MOST_NUMBERS = 50_000
MOST_ENTRIES = 100
DEEPEST = 4


class FaultKind(StrEnum):
    """Why a call gave no numbers."""

    MISSING = "missing"  # the notebook does not define the name
    CELL_FAILED = "cell failed"  # nor does it: the cell that should define it stopped with an error
    STALE = "stale"  # an earlier one was called: the cell that defines it again stopped
    NOT_CALLABLE = "not callable"
    NOT_IMPLEMENTED = "not implemented"  # the stub is still there
    RAISED = "raised"
    TIMED_OUT = "timed out"
    STARVED = "starved"  # at the clock's limit, not the processor's: asleep, or a busy machine
    SLOW_LOOP = "slow loop"  # the steps of a closed loop took too long together
    NO_TOOLS = "no tools"  # it is in a language whose compiler is not installed
    DIED = "died"  # the process ended during the call
    NOTHING = "nothing"  # returned None
    NOT_NUMBERS = "not numbers"
    GARBLED = "garbled"  # what came back is no reply


class NotNumbersError(Exception):
    """A value that a judge cannot read as numbers."""

    def __init__(self, kind: FaultKind, message: str):
        super().__init__(message)
        self.kind = kind


def read_numbers(value, truth: bool = False) -> np.ndarray:
    """`value` as a float array; NotNumbersError says what came instead.

    truth: whether True and False are asked for, and count as 1 and 0; elsewhere they are no numbers.
    """
    if value is None:
        raise NotNumbersError(FaultKind.NOTHING, "")
    if callable(value) and not hasattr(value, "__array__"):
        raise NotNumbersError(FaultKind.NOT_NUMBERS, described(value))
    if truth and getattr(value, "is_Boolean", False):
        with suppress(TypeError):  # SymPy's True or False is one, a relation of symbols is not
            value = bool(value)
    try:
        array = np.asarray(value)
    except ValueError:
        several = f"a tuple of {len(value)} unlike parts" if isinstance(value, tuple) else ""
        text = several or "rows of different lengths"
        raise NotNumbersError(FaultKind.NOT_NUMBERS, text) from None
    if array.size > MOST_NUMBERS:
        text = f"an array of {array.size} entries, which is far too large"
        raise NotNumbersError(FaultKind.NOT_NUMBERS, text)
    if array.dtype.kind == "O":
        array = np.array([_number(entry) for entry in array.flat]).reshape(array.shape)
    if array.dtype.kind not in ("biuf" if truth else "iuf"):
        raise NotNumbersError(FaultKind.NOT_NUMBERS, described(value))
    return array.astype(float)


def is_finite(value) -> bool:
    """Whether all numbers of a value are, an array or parts of it."""
    if isinstance(value, dict | list):
        return all(map(is_finite, value.values() if isinstance(value, dict) else value))
    return bool(np.all(np.isfinite(value)))


def _is_part(value) -> bool:
    """Whether it is more than a number; a SymPy matrix has a shape, too."""
    plain = isinstance(value, Mapping | SimpleNamespace | tuple | list)
    return plain or bool(getattr(value, "shape", ()))


def read_parts(value, depth: int = DEEPEST):
    """A result of several parts, named or in order, as dicts and lists of arrays."""
    if isinstance(value, SimpleNamespace):
        value = vars(value)
    if isinstance(value, Mapping | tuple | list) and depth and len(value) <= MOST_ENTRIES:
        if isinstance(value, Mapping):
            return {str(name): read_parts(entry, depth - 1) for name, entry in value.items()}
        if any(map(_is_part, value)):
            return [read_parts(part, depth - 1) for part in value]
    return read_numbers(value)


def _number(entry) -> float:
    free = getattr(entry, "free_symbols", None)
    if free and not getattr(entry, "is_Relational", False):
        names = ", ".join(sorted(str(symbol) for symbol in free))
        raise NotNumbersError(FaultKind.NOT_NUMBERS, f"an expression that still contains {names}")
    if isinstance(entry, numbers.Real) or hasattr(entry, "__float__"):
        try:
            return float(entry)
        except (TypeError, ValueError, OverflowError):
            pass
    raise NotNumbersError(FaultKind.NOT_NUMBERS, described(entry))


def evaluate(expression, points) -> np.ndarray:
    """A SymPy expression's numbers, or a matrix's, at each point: a mapping from name to number."""
    import sympy  # here, so that only symbolic answers wait for it

    given = np.asarray(expression) if isinstance(expression, np.matrix) else expression
    try:
        if isinstance(given, list | tuple | np.ndarray):
            if any(isinstance(entry, str) for entry in np.array(given, dtype=object).flat):
                raise sympy.SympifyError(given)
            expression = sympy.Array(given)
        expression = sympy.sympify(expression, strict=True)
    except (sympy.SympifyError, AttributeError, TypeError, ValueError):
        read_numbers(given)
        raise NotNumbersError(FaultKind.NOT_NUMBERS, described(given)) from None
    entries = [expression]
    if isinstance(expression, sympy.MatrixBase | sympy.NDimArray):
        entries = list(np.array(expression.tolist(), dtype=object).flat)
    for entry in entries:
        if not isinstance(entry, sympy.Expr):  # an equation, a truth value, a set, a dict …
            raise NotNumbersError(
                FaultKind.NOT_NUMBERS, described(given if entry is expression else entry)
            )
    if expression.is_Matrix:
        expression = expression.as_immutable()
    symbols = tuple(sorted(expression.free_symbols, key=lambda symbol: symbol.name))
    try:
        return np.array([read_numbers(_value_at(expression, symbols, point)) for point in points])
    except RecursionError:  # in SymPy, for an expression that has no value
        raise NotNumbersError(FaultKind.NOT_NUMBERS, described(given)) from None


def _value_at(expression, symbols, point):
    """The expression's value at a point; compiled if possible, as `subs` takes 100 times as long."""
    known = {symbol: point[symbol.name] for symbol in symbols if symbol.name in point}
    if len(known) == len(symbols):
        with suppress(Exception):  # NumPy may lack a function that SymPy can evaluate
            return _compiled(symbols, expression)(*known.values())
    return expression.doit().subs(known)  # it may hold a derivative that is not taken yet


@lru_cache(maxsize=64)
def _compiled(symbols, expression):
    import sympy

    return sympy.lambdify(symbols, expression, "numpy")


def encode_value(value):
    """What `read_numbers` or `read_parts` gave, in JSON's terms."""
    if isinstance(value, dict):
        return {"map": {name: encode_value(entry) for name, entry in value.items()}}
    if isinstance(value, list):
        return {"list": [encode_value(entry) for entry in value]}
    return value.tolist()


def decode_value(message, depth: int = DEEPEST):
    """What `encode_value` wrote; TypeError, ValueError or OverflowError where it did not."""
    match message:
        case {"map": dict(entries)} if depth:
            return {str(name): decode_value(entry, depth - 1) for name, entry in entries.items()}
        case {"list": list(entries)} if depth:
            return [decode_value(entry, depth - 1) for entry in entries]
    return np.asarray(message, dtype=float)
