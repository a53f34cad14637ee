"""Where a judged number stands in what a student's function returned, as the student writes it.

A number is judged either as it came, as M12 is `M[0, 1]`; or it is made of several entries, as one of
C q̇ is of `C[0, :]`. Which they are is found by changing one entry at a time and forming the number anew.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import groupby

import numpy as np

from autograder.judging.quantities import Quantities, UnfitError, each
from autograder.protocol import Call

# An entry is changed by this share of the largest one; a threshold is not likely to lie so near.
CHANGE = 1e-3
# What moves by less than this share of the change is rounding.
LEAST_MOVE = 1e-9
Index = tuple[int, ...]


@dataclass(frozen=True)
class Place:
    """The entries of a returned array, called `name`, of which a number is made.

    shape: the array's. is_entry: whether the number is one of them as it came.
    """

    name: str
    entries: tuple[Index, ...]
    shape: tuple[int, ...]
    is_entry: bool

    def __str__(self) -> str:
        """ "M[0, 1]", "C[0, :]", "C[0, 1] and C[1, 0]", "all of C"; "" where no entry is known."""
        if len(self.entries) > 1 and len(self.entries) == np.prod(self.shape):
            return f"all of {self.name}"
        parts: list[str] = []
        for row, found in groupby(self.entries, lambda entry: entry[:-1]):
            columns = [entry[-1] for entry in found]
            if row and 1 < len(columns) == self.shape[-1]:
                parts.append(f"{self.name}[{', '.join(map(str, row))}, :]")
            else:
                parts += [f"{self.name}[{', '.join(map(str, (*row, c)))}]" for c in columns]
        *first, last = parts or [""]
        return f"{', '.join(first)} and {last}" if first else last


NOWHERE = Place("", (), (), False)


def place(
    name: str, quantities: Quantities, calls: list[Call], values: list, case: int, k: int, at: Index
) -> Place:
    """Of the number `at` of quantity k of a case. values: what came back for each call.

    A function of symbols gave one array for each point; a function that returned one number, or several
    things at once, has no entries.
    """
    value = values[case]
    call = calls[case]
    if not isinstance(value, np.ndarray) or not value.size:
        return NOWHERE
    points = value.shape[:1] if call.at else ()
    shape = value.shape[len(points) :]
    if np.prod(shape) < 2:
        return NOWHERE
    number = _number(quantities, calls, values, case, k, at)
    before, step = number(value), CHANGE * (float(np.max(np.abs(value))) or 1.0)
    found, as_it_came = [], False
    for entry in np.ndindex(shape):
        changed = np.array(value, dtype=float)
        own = (slice(None),) * len(points) + entry
        changed[own] += step
        try:
            move = number(changed) - before
        except UnfitError:
            continue
        if abs(move) > LEAST_MOVE * step:
            found.append(entry)
            as_it_came = bool(np.any(value[own] == before)) and abs(move / step - 1) < 1e-6
    return Place(name, tuple(found), shape, as_it_came and len(found) == 1)


def _number(
    quantities: Quantities, calls: list[Call], values: list, case: int, k: int, at: Index
) -> Callable[[np.ndarray], float]:
    """The judged number, if this came back in that case, and in the others what did."""

    def number(value: np.ndarray) -> float:
        if isinstance(quantities, each):
            parts = quantities.parts(calls[case], value)
        else:
            every = [*values[:case], value, *values[case + 1 :]]
            parts = quantities(calls, every)[case]
        return float(np.asarray(parts[k])[at])

    return number
