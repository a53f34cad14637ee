"""Tells the quantities of an answer that are finite from those that hang on a NaN or an infinity.

A function may return three right numbers and a NaN. The criteria that do not hang on the NaN are judged;
the others are not met. Whether one hangs on it is tried, with other numbers in its place, so that no
comparison, maximum or sorting in a check can hide it: an answer never gets more than it would with one
of these numbers.
"""

from dataclasses import dataclass

import numpy as np

from autograder.judging.quantities import Numbers, Quantities, UnfitError
from autograder.protocol import Call, is_finite, one_line

MOST_NAMED = 3  # places of an array
MOST_KEY = 40  # characters of a name that a student gave to a part


@dataclass(frozen=True)
class Partial:
    """Quantities of which some are NaN.

    spoilt: for each criterion, whether its numbers hang on one that is not finite; they are NaN then.
    """

    numbers: Numbers
    spoilt: tuple[bool, ...]


def where_not_finite(value, at_points: bool = False) -> str:
    """The first number of a value that is not finite, and its place: "nan at [2]".

    at_points: whether the value is an expression's at several points, one row each; the place is then
    that in the expression, at the first point where it is not finite.
    """
    if at_points:
        return where_not_finite(value[first_bad_point(value)])
    if isinstance(value, dict | list):
        named = value.items() if isinstance(value, dict) else enumerate(value)
        key, part = next((key, part) for key, part in named if not is_finite(part))
        first, _, place = where_not_finite(part).partition(" at ")
        return f"{first} at [{one_line(repr(key), MOST_KEY)}]{place}"
    bad = np.argwhere(~np.isfinite(value))
    first = f"{value[tuple(bad[0])]}"
    if np.size(value) == 1:
        return first
    places = [f"[{', '.join(map(str, place))}]" for place in bad[:MOST_NAMED].tolist()]
    if left := len(bad) - len(places):
        places.append(f"{left} more")
    *others, last = places
    return f"{first} at {', '.join(others)} and {last}" if others else f"{first} at {last}"


def first_bad_point(value: np.ndarray) -> int:
    """The first row of a value in which a number is not finite."""
    return next(k for k, row in enumerate(value) if not is_finite(row))


def partial(quantities: Quantities, calls: list[Call], values: list) -> Partial | None:
    """The quantities of values that are not all finite; None where none of them can be judged.

    UnfitError where the values do not have the shape that is asked for.
    """
    if any(isinstance(value, dict | list) for value in values):
        return None
    bad = [k for k, value in enumerate(values) if not is_finite(value)]
    with np.errstate(all="ignore"):
        try:
            as_given = quantities(calls, values)
        except UnfitError:
            raise
        except Exception:  # such as a decomposition that refuses a NaN
            return None
        try:
            spoilt = _hanging_on(quantities, calls, values, bad)
            # A value of which no criterion takes notice is not judged to be none.
            each = [_hanging_on(quantities, calls, values, [k]) for k in bad]
        except Exception:  # nor need they take other numbers
            return None
    if all(spoilt) or not all(map(any, each)):
        return None
    numbers = [
        tuple(
            np.full(np.shape(part), np.nan) if hangs else part
            for part, hangs in zip(case, spoilt, strict=True)
        )
        for case in as_given
    ]
    return Partial(numbers, spoilt)


def _hanging_on(
    quantities: Quantities, calls: list[Call], values: list, bad: list[int]
) -> tuple[bool, ...]:
    """For each criterion, whether it hangs on what is not finite in the values at these places.

    What is not finite in others is 0 meanwhile.
    """
    zero, *others = _fills(values)
    rest = [v if k in bad else _filled(v, zero) for k, v in enumerate(values)]
    found = [
        quantities(calls, [_filled(v, fill) if k in bad else v for k, v in enumerate(rest)])
        for fill in (zero, *others)
    ]
    as_given = quantities(calls, rest)
    return tuple(
        not all(_same(k, as_given, other) for other in found) for k in range(len(as_given[0]))
    )


def _fills(values: list):
    """What stands for numbers that are not finite, each time another."""
    finite = np.concatenate([np.ravel(value)[np.isfinite(np.ravel(value))] for value in values])
    size = float(np.max(np.abs(finite), initial=0.0)) or 1.0
    rng = np.random.default_rng(0)
    yield lambda count: np.zeros(count)
    yield lambda count: size * rng.uniform(0.5, 1.5, count)
    yield lambda count: -size * rng.uniform(0.5, 1.5, count)


def _filled(value: np.ndarray, fill) -> np.ndarray:
    value = np.array(value, dtype=float)
    bad = ~np.isfinite(value)
    value[bad] = fill(np.count_nonzero(bad))
    return value


def _same(k: int, one: Numbers, other: Numbers) -> bool:
    """Whether the numbers of criterion k are the same in every case; a NaN is not even itself."""
    return all(np.array_equal(a[k], b[k]) for a, b in zip(one, other, strict=True))
