"""Reading what a student's function returned as plain numbers, and writing these for the wall."""

import numbers
from collections.abc import Mapping
from contextlib import suppress
from enum import StrEnum
from functools import lru_cache
from types import SimpleNamespace

import numpy as np

# 24 such answers are a reply that the room may still send.
MOST_NUMBERS = 50_000
MOST_CHARACTERS = 300
MOST_ENTRIES = 100
DEEPEST = 4


class FaultKind(StrEnum):
    """Why a call gave no numbers."""

    MISSING = "missing"  # no such name in the notebook
    CELL_FAILED = "cell failed"  # no such name, and a cell that holds it stopped with an error
    STALE = "stale"  # an earlier one was called: the cell of the last stopped with an error
    NOT_CALLABLE = "not callable"
    NOT_IMPLEMENTED = "not implemented"  # the stub is still there
    RAISED = "raised"
    TIMED_OUT = "timed out"
    STARVED = "starved"  # the clock's limit came before the processor's: asleep, or a busy machine
    NO_TOOLS = "no tools"  # another language's, whose compiler is not installed
    DIED = "died"  # the process ended during the call
    NOTHING = "nothing"  # returned None
    NOT_NUMBERS = "not numbers"
    GARBLED = "garbled"  # what came back through the wall is no reply


class NotNumbersError(Exception):
    """A value that a judge cannot read as numbers."""

    def __init__(self, kind: FaultKind, message: str):
        super().__init__(message)
        self.kind = kind


def read_numbers(value) -> np.ndarray:
    """`value` as a float array; NotNumbersError says what came instead."""
    if value is None:
        raise NotNumbersError(FaultKind.NOTHING, "")
    if callable(value) and not hasattr(value, "__array__"):
        raise NotNumbersError(FaultKind.NOT_NUMBERS, "a function")
    try:
        array = np.asarray(value)
    except ValueError:
        raise NotNumbersError(FaultKind.NOT_NUMBERS, "rows of different lengths") from None
    if array.size > MOST_NUMBERS:
        raise NotNumbersError(FaultKind.NOT_NUMBERS, f"{array.size} entries, far too many")
    if array.dtype.kind == "O":
        array = np.array([_number(entry) for entry in array.flat]).reshape(array.shape)
    if array.dtype.kind not in "biuf":
        raise NotNumbersError(FaultKind.NOT_NUMBERS, _described(value))
    return array.astype(float)


def read_parts(value, depth: int = DEEPEST):
    """A result of several named or ordered parts: dicts and lists of arrays, as far as they go."""
    if isinstance(value, SimpleNamespace):
        value = vars(value)
    if isinstance(value, Mapping | tuple | list) and depth and len(value) <= MOST_ENTRIES:
        if isinstance(value, Mapping):
            return {str(name): read_parts(entry, depth - 1) for name, entry in value.items()}
        if any(isinstance(part, Mapping | SimpleNamespace | tuple | list | np.ndarray)
               for part in value):  # fmt: skip
            return [read_parts(part, depth - 1) for part in value]
    return read_numbers(value)


def _number(entry) -> float:
    free = getattr(entry, "free_symbols", None)
    if free:
        names = ", ".join(sorted(str(symbol) for symbol in free))
        raise NotNumbersError(FaultKind.NOT_NUMBERS, f"an expression that still holds {names}")
    if isinstance(entry, numbers.Real) or hasattr(entry, "__float__"):
        try:
            return float(entry)
        except (TypeError, ValueError, OverflowError):
            pass
    raise NotNumbersError(FaultKind.NOT_NUMBERS, _described(entry))


def _described(value) -> str:
    return f"{type(value).__name__} {shortened(repr(value), 60)}"


def evaluate(expression, points) -> np.ndarray:
    """A SymPy expression's numbers, or a matrix's, at each point: a mapping from name to number."""
    import sympy  # only a symbolic answer pays for it

    try:
        if isinstance(expression, list | tuple | np.ndarray):
            if any(isinstance(entry, str) for entry in np.array(expression, dtype=object).flat):
                raise sympy.SympifyError(expression)
            expression = sympy.Array(expression)
        expression = sympy.sympify(expression, strict=True)
    except (sympy.SympifyError, AttributeError, TypeError, ValueError):
        read_numbers(expression)
        raise NotNumbersError(FaultKind.NOT_NUMBERS, _described(expression)) from None
    if expression.is_Matrix:
        expression = expression.as_immutable()
    symbols = tuple(sorted(expression.free_symbols, key=lambda symbol: symbol.name))
    return np.array([read_numbers(_value_at(expression, symbols, point)) for point in points])


def _value_at(expression, symbols, point):
    """The expression's value there; compiled where that works, for a hundredth of what `subs` costs."""
    known = {symbol: point[symbol.name] for symbol in symbols if symbol.name in point}
    if len(known) == len(symbols):
        with suppress(Exception):  # what NumPy has no word for, SymPy may still evaluate
            return _compiled(symbols, expression)(*known.values())
    return expression.doit().subs(known)  # a derivative may have been written, but not taken


@lru_cache(maxsize=64)
def _compiled(symbols, expression):
    import sympy

    return sympy.lambdify(symbols, expression, "numpy")


def shortened(text: str, most: int = MOST_CHARACTERS) -> str:
    return text if len(text) <= most else text[: most - 1] + "…"


def one_line(text: str, most: int = MOST_CHARACTERS) -> str:
    """Printable and shortened, so that no text of a student's passes for more than one line of ours."""
    if not text.isprintable():
        text = repr(text[:most])[1:-1]
    return shortened(text, most)


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
