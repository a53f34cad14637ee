"""What a check may give a student's function: numbers, and stand-ins for what JSON cannot hold.

The judge sends the stand-ins. The sandbox makes the real thing of them, so that a function or a SymPy
matrix arrives as a student's own code would pass it.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from numbers import Number
from types import FunctionType, SimpleNamespace

import numpy as np


@dataclass(frozen=True)
class Symbol:
    """Stands for a real SymPy symbol."""

    name: str


@dataclass(frozen=True)
class Expressions:
    """Stands for a SymPy matrix: its rows, each entry as SymPy writes it, in real symbols."""

    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Function:
    """Stands for a function of numbers: its arguments, and the list it returns as a float array.

    Both are Python source that may use NumPy's names: Function("x, u", "[x[1], u[0] - sin(x[0])]").
    """

    arguments: str
    returns: str


def real(value):
    """What the student's function gets: a new copy for each call, which it may change."""
    match value:
        case Symbol(name):
            import sympy  # only a symbolic question pays for it

            return sympy.Symbol(name, real=True)
        case Expressions(rows):
            return _matrix(rows).as_mutable()
        case Function(arguments, returns):
            compute = _compiled(arguments, returns)
            return lambda *given: np.array(compute(*given), dtype=float)
        case SimpleNamespace():
            return SimpleNamespace(**{name: real(entry) for name, entry in vars(value).items()})
        case tuple():
            return [real(entry) for entry in value]
        case np.ndarray():
            return value.copy()
    return value


def changed(value, given) -> list[str]:
    """What a call changed in an argument, which was `real(value)` and is now `given`.

    The names of a namespace's entries, or "" for the argument itself; empty where it changed nothing.
    """
    if not isinstance(value, SimpleNamespace):
        return [] if _is_still(value, given) else [""]
    entries, now = vars(value), vars(given)
    names = [name for name in entries if name not in now or not _is_still(entries[name], now[name])]
    return names or ([] if entries.keys() == now.keys() else [""])


def _is_still(value, given) -> bool:
    """Whether an argument is as `real(value)` made it, to the bit."""
    match value:
        case Symbol():
            return given == real(value)
        case Function():  # its numbers are its own; another may stand in its place
            return isinstance(given, FunctionType)
        case Expressions(rows):
            return list(given) == list(_matrix(rows)) and given.shape == _matrix(rows).shape
        case SimpleNamespace():
            return isinstance(given, SimpleNamespace) and not changed(value, given)
        case tuple():
            return isinstance(given, list) and len(given) == len(value) and all(
                map(_is_still, value, given)
            )  # fmt: skip
        case np.ndarray():
            return (
                isinstance(given, np.ndarray)
                and (given.shape, given.dtype) == (value.shape, value.dtype)
                and given.tobytes() == value.tobytes()
            )
    if not isinstance(given, Number):
        return False
    return bool(given == value or (given != given and value != value))


@lru_cache(maxsize=64)
def _compiled(arguments, returns):
    return eval(f"lambda {arguments}: {returns}", vars(np) | {"pi": np.pi})


@lru_cache(maxsize=64)  # a judge asks for the same one again for each known mistake
def _matrix(rows):
    import sympy

    # One text for all entries, as each call of the parser costs time. Its symbols are not real ones yet.
    text = ", ".join(f"[{', '.join(row)}]" for row in rows)
    matrix = sympy.ImmutableMatrix(sympy.sympify(f"[{text}]"))
    return matrix.xreplace({s: sympy.Symbol(s.name, real=True) for s in matrix.free_symbols})


def numbers_at(expressions: Expressions, point: Mapping[str, complex]) -> np.ndarray:
    """A matrix's numbers at a point, complex where that is: without SymPy, which takes long to read."""
    rows = ", ".join(f"[{', '.join(row)}]" for row in expressions.rows)
    return np.array(_compiled(", ".join(point), f"[{rows}]")(**point))


def encode(value):
    """An argument in JSON's terms."""
    match value:
        case Symbol(name):
            return {"symbol": name}
        case Expressions(rows):
            return {"expressions": rows}
        case Function(arguments, returns):
            return {"function": [arguments, returns]}
        case SimpleNamespace():
            return {"namespace": {name: encode(entry) for name, entry in vars(value).items()}}
        case tuple():
            return {"list": [encode(entry) for entry in value]}
        case np.ndarray():
            return {"array": value.tolist(), "shape": value.shape}
    return value


def decode(value):
    """The argument that `encode` wrote."""
    match value:
        case {"symbol": name}:
            return Symbol(name)
        case {"expressions": rows}:
            return Expressions(tuple(map(tuple, rows)))
        case {"function": [arguments, returns]}:
            return Function(arguments, returns)
        case {"namespace": entries}:
            return SimpleNamespace(**{name: decode(entry) for name, entry in entries.items()})
        case {"list": entries}:
            return tuple(decode(entry) for entry in entries)
        case {"array": entries, "shape": shape}:
            return np.array(entries, dtype=float).reshape(shape)
    return value
