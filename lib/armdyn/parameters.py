"""Checks on parameters and states: each error names the argument, what came and what is needed."""

import math
from numbers import Real

import numpy as np


def finite(name: str, value: float, unit: str) -> float:
    """`value` as a float; ValueError unless it is one finite real number."""
    if isinstance(value, bool) or not isinstance(value, Real) or not math.isfinite(value):
        raise ValueError(f"{name} = {value!r}: needs one finite number, in {unit}")
    return float(value)


def positive(name: str, value: float, unit: str) -> float:
    """`value` as a float; ValueError unless it is > 0."""
    number = finite(name, value, unit)
    if number <= 0:
        raise ValueError(f"{name} = {value!r}: must be greater than 0 {unit}")
    return number


def nonnegative(name: str, value: float, unit: str) -> float:
    """`value` as a float; ValueError unless it is ≥ 0."""
    number = finite(name, value, unit)
    if number < 0:
        raise ValueError(f"{name} = {value!r}: must not be negative ({unit})")
    return number


def per_joint(name: str, value, n: int, unit: str) -> tuple[float, ...]:
    """`value` as a tuple of `n` floats ≥ 0, one per joint; a single number is allowed for n = 1."""
    values = (value,) if n == 1 and isinstance(value, Real) else value
    try:
        entries = tuple(values)
    except TypeError:
        entries = ()
    if len(entries) != n:
        raise ValueError(f"{name} = {value!r}: needs {n} numbers, one per joint, in {unit}")
    return tuple(nonnegative(f"{name}[{i}]", entry, unit) for i, entry in enumerate(entries))


def state_vector(name: str, value, size: int) -> np.ndarray:
    """`value` as a float array of shape (..., size); otherwise ValueError with both shapes."""
    try:
        array = np.asarray(value, dtype=float)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name}: needs numbers of shape (..., {size}); {error}") from None
    if array.ndim == 0 or array.shape[-1] != size:
        raise ValueError(f"{name}: got shape {array.shape}, needs (..., {size})")
    return array
