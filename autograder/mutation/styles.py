"""The forms in which right answers come: what people's functions return for one and the same numbers."""

from collections.abc import Callable

import mpmath
import numpy as np
import sympy as sp


def _column(value):
    """A vector as (n, 1), and a number as (1,); a matrix has no other form."""
    array = np.asarray(value)
    return array if array.ndim > 1 else array.reshape((-1, 1) if array.ndim else 1)


def _of_numbers(kind: Callable) -> Callable:
    """An array of objects, of another library's numbers."""
    return lambda value: np.vectorize(kind, otypes=[object])(np.asarray(value, dtype=float))


def _matrix(kind: Callable) -> Callable:
    """A matrix of a class that knows no other arrays; a number stays one."""
    return lambda value: kind(np.asarray(value)) if np.ndim(value) in (1, 2) else value


STYLES: dict[str, Callable] = {
    "as an array": np.asarray,
    "in single precision": np.float32,
    "in extended precision": np.longdouble,
    "as nested lists": lambda value: np.asarray(value).tolist(),
    "as an np.matrix": _matrix(lambda array: array.view(np.matrix)),
    "as a column": _column,
    "as a SymPy matrix": _matrix(sp.Matrix),
    "as SymPy's numbers": _of_numbers(sp.Float),
    "as mpmath's numbers": _of_numbers(mpmath.mpf),
    "rounded in the last digits": lambda value: np.asarray(value) * (1 + 1e-13),
    "rounded to nine digits": lambda value: np.vectorize(_nine_digits)(np.asarray(value, float)),
    "as an array of objects": lambda value: np.asarray(value, dtype=object),
    "in the other memory order": lambda value: np.asfortranarray(value),
}


def _nine_digits(number: float) -> float:
    return float(f"{number:.9g}")
