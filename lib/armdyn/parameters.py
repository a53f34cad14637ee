"""Checks parameters and states; each error names the argument, what was given and what is needed."""

import reprlib
from collections.abc import Sequence
from numbers import Real

import numpy as np

# Inertias are products of three parameters; within this bound their squares stay finite.
LARGEST = 1e50


def finite(name: str, value: float, unit: str) -> float:
    """`value` as a float; ValueError unless it is one finite real number, at most 1e50 in size."""
    try:
        number = float(value) if isinstance(value, Real) else np.nan
    except OverflowError:
        number = np.inf
    if isinstance(value, bool) or not abs(number) <= LARGEST:
        raise ValueError(
            f"{name} = {reprlib.repr(value)}: needs one finite number, in {unit} "
            f"(at most {LARGEST:.0e})"
        )
    return number


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


def numbers(name: str, value, shape: tuple[int, ...], unit: str) -> np.ndarray:
    """`value` as a float array of this shape; ValueError unless all are finite, at most 1e50 in size."""
    needs = f"real numbers of shape {shape}, in {unit}"
    array = all_finite(name, real_array(name, value, needs))
    if array.shape != shape:
        raise ValueError(f"{name}: got shape {array.shape}, needs {needs}")
    if np.max(np.abs(array), initial=0) > LARGEST:
        raise ValueError(f"{name} = {reprlib.repr(value)}: needs at most {LARGEST:.0e} {unit}")
    return array


def per_joint(name: str, value, n: int, unit: str) -> tuple[float, ...]:
    """`value`, a sequence or an array, as a tuple of `n` floats ≥ 0, one per joint."""
    # Strings are sequences too; sets and mappings have no order that joints could follow.
    listed = isinstance(value, Sequence | np.ndarray) and not isinstance(value, str | bytes)
    if not listed or np.shape(value)[:1] != (n,):
        raise ValueError(
            f"{name} = {reprlib.repr(value)}: needs {n} numbers, one per joint, in {unit}"
        )
    return tuple(nonnegative(f"{name}[{i}]", entry, unit) for i, entry in enumerate(value))


def real_array(name: str, value, needs: str = "real numbers") -> np.ndarray:
    """`value` as a float array; ValueError for what is not real numbers: None, text, bool, complex.

    NaN and infinity pass here; `all_finite` refuses them.
    """
    try:
        array = np.asarray(value)
    except ValueError:
        raise ValueError(
            f"{name} = {reprlib.repr(value)}: rows of different lengths; needs {needs}"
        ) from None
    if array.dtype.kind not in "iuf":
        raise ValueError(f"{name} = {reprlib.repr(value)}: needs {needs}, not {array.dtype} values")
    return array.astype(float, copy=False)


def all_finite(name: str, array: np.ndarray) -> np.ndarray:
    """The array itself; ValueError, with the first offending index, if it holds NaN or infinity."""
    if not np.isfinite(array).all():
        at = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        where = f"{name}[{', '.join(map(str, at))}]" if at else name
        raise ValueError(f"{where} = {array[at]}: needs finite numbers")
    return array


def vector(name: str, value, size: int) -> np.ndarray:
    """`value` as a float array of shape (..., size); otherwise ValueError with both shapes.

    NaN and infinity pass here; `all_finite` refuses them.
    """
    needs = f"real numbers of shape (..., {size})"
    array = real_array(name, value, needs)
    if array.ndim == 0 or array.shape[-1] != size:
        raise ValueError(f"{name}: got shape {array.shape}, needs {needs}")
    return array


def state_vector(name: str, value, size: int) -> np.ndarray:
    """The same, and finite; otherwise ValueError with both shapes or the first offending index."""
    return all_finite(name, vector(name, value, size))


def vectors(size: int, **named) -> list[np.ndarray]:
    """Each value as by `vector`; ValueError if their batch axes do not broadcast."""
    arrays = [vector(name, value, size) for name, value in named.items()]
    try:
        if any(array.shape != arrays[0].shape for array in arrays):
            np.broadcast_shapes(*(array.shape for array in arrays))
    except ValueError:
        shapes = ", ".join(
            f"{name} {array.shape}" for name, array in zip(named, arrays, strict=True)
        )
        raise ValueError(f"{shapes}: needs batch axes that broadcast to one shape") from None
    return arrays


def state_vectors(size: int, **named) -> list[np.ndarray]:
    """The same, and finite; otherwise ValueError with the shapes or the first offending index."""
    arrays = vectors(size, **named)
    return [all_finite(name, array) for name, array in zip(named, arrays, strict=True)]
