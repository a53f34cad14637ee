"""The numbers of many mistakes at once, so that an answer is compared with all of them in one step.

The numbers of a criterion stand in one row a mistake, case after case, with a 0 before each case: so
every case has a largest number, and cases may differ in shape.
"""

from dataclasses import dataclass
from functools import reduce
from typing import Any

import numpy as np

from autograder.judging.criterion import LEAST_SCALE
from autograder.judging.quantities import Numbers, Quantities, each
from autograder.protocol import Call

# Of the right numbers, what is as good as 0.
NEGLIGIBLE = 1e-6
# Quantities of more values than these are formed mistake by mistake.
MOST_VALUES = 128
# Quantities are linear in the values where that holds to this, in three mistakes.
LINEAR = 1e-9
ZERO = np.zeros(1)
# Of cases with so few numbers, the first of all are compared with the second of all, and so on.
AS_SLICES = 12


@dataclass(frozen=True)
class Layout:
    """Of one criterion: the shape of each case, and where it begins in a row. floor: what is less than
    this is as good as 0, as a power that vanishes to rounding.
    """

    shapes: tuple[tuple[int, ...], ...]
    sizes: tuple[int, ...]
    starts: np.ndarray
    floor: float = 0.0

    @property
    def length(self) -> int:
        """Of a row."""
        return sum(self.sizes)

    @classmethod
    def of(cls, values: list, expected: list) -> "Layout":
        shapes = tuple(np.shape(value) for value in values)
        sizes = tuple(1 + int(np.prod(shape)) for shape in shapes)
        largest = max(np.max(np.abs(value), initial=0.0) for value in expected)
        return cls(shapes, sizes, np.cumsum([0, *sizes[:-1]]), NEGLIGIBLE * float(largest))

    def row(self, values: list) -> np.ndarray:
        """One row; a value that is one number for several stands for each of them."""
        if len(set(self.shapes)) == 1 and all(np.shape(v) == self.shapes[0] for v in values):
            row = np.zeros((len(values), self.sizes[0]))
            row[:, 1:] = np.reshape(values, (len(values), -1))
            return row.ravel()
        parts: list[Any] = []
        for value, shape in zip(values, self.shapes, strict=True):
            same = np.shape(value) == shape
            parts += [ZERO, np.ravel(value if same else np.broadcast_to(value, shape))]
        return np.concatenate(parts)

    def some(self, cases: list[int]) -> tuple["Layout", np.ndarray]:
        """That of some cases, and where their numbers stand in a row of all."""
        shapes = tuple(self.shapes[case] for case in cases)
        sizes = tuple(self.sizes[case] for case in cases)
        columns = [np.arange(self.sizes[case]) + self.starts[case] for case in cases]
        starts = np.cumsum([0, *sizes[:-1]])
        return Layout(shapes, sizes, starts, self.floor), np.concatenate(columns)

    def errors(self, expected: np.ndarray, given: np.ndarray) -> np.ndarray:
        """As `relative_errors`, of rows (…, numbers): (…, cases)."""
        size = self._largest(expected)
        scale = np.maximum(size, LEAST_SCALE * np.max(size, axis=-1, keepdims=True))
        scale = np.maximum(scale, self.floor)
        error = self._largest(given - expected)
        return error / np.where(scale > 0, scale, 1.0)

    def _largest(self, numbers: np.ndarray) -> np.ndarray:
        """The largest size in each case."""
        sizes = np.abs(numbers)
        (size, *others) = set(self.sizes)
        if others or size > AS_SLICES:
            return np.maximum.reduceat(sizes, self.starts, axis=-1)
        return reduce(np.maximum, (sizes[..., k::size] for k in range(size)))

    def same(self, expected: np.ndarray, given: np.ndarray, tolerance: float) -> np.ndarray:
        """Whether the rows are equal to the tolerance in every case: (…)."""
        return np.all(self.errors(expected, given) <= tolerance, axis=-1)


def layouts(numbers: Numbers, expected: Numbers) -> list[Layout]:
    """One for each criterion."""
    return [
        Layout.of([case[k] for case in numbers], [case[k] for case in expected])
        for k in range(len(numbers[0]))
    ]


def rows(layout: list[Layout], numbers: Numbers) -> list[np.ndarray]:
    """For each criterion the row of its numbers."""
    return [own.row([case[k] for case in numbers]) for k, own in enumerate(layout)]


def unlike(
    layout: list[Layout], quantities: Quantities, calls: list[Call], values: list
) -> list[np.ndarray]:
    """As `stacked`, where calls differ in the shape of what came back. values: for each answer that of
    each call. Where each call is judged by itself, those of one shape are taken together.
    """
    places: dict[tuple, list[int]] = {}
    for case, alike in enumerate(zip(*values, strict=True)):
        shape, *others = {np.shape(value) for value in alike}
        places.setdefault(() if others else (shape,), []).append(case)
    if () in places or not isinstance(quantities, each):
        formed = [rows(layout, quantities(calls, list(own))) for own in values]
        return [np.array(own) for own in zip(*formed, strict=True)]
    found = [np.zeros((len(values), own.length)) for own in layout]
    for cases in places.values():
        some = np.array([[own[case] for case in cases] for own in values], dtype=float)
        parts = [own.some(cases) for own in layout]
        numbers = stacked(
            [part for part, _ in parts], quantities, [calls[case] for case in cases], some
        )
        for whole, own, (_, columns) in zip(found, numbers, parts, strict=True):
            whole[:, columns] = own
    return found


def stacked(
    layout: list[Layout], quantities: Quantities, calls: list[Call], values: np.ndarray
) -> list[np.ndarray]:
    """For each criterion the rows of many answers, (answers, numbers). values: (answers, calls, …).

    What is judged is most often linear in what came back, as C q̇ is. Then it follows for all answers
    from that of unit values; this is tried, and all are formed one by one where it is not so.
    """
    many, cases = values.shape[:2]
    flat = values.reshape(many, cases, -1)

    def formed(answer: np.ndarray) -> np.ndarray:
        found = quantities(calls, list(answer.reshape(values.shape[1:])))
        return np.concatenate(rows(layout, found))

    ends = np.cumsum([own.length for own in layout])[:-1]
    whole = _linear(layout, quantities, flat, formed)
    if whole is None:
        whole = np.array([formed(answer) for answer in flat])
    return np.split(whole, ends, axis=1)


def _linear(layout: list[Layout], quantities: Quantities, flat: np.ndarray, formed):
    """The rows of all answers by those of unit values; None where they do not follow from these."""
    many, cases, size = flat.shape
    finite = np.flatnonzero(np.all(np.isfinite(flat), axis=(1, 2)))
    apart = isinstance(quantities, each)  # then a call's numbers follow from its own value alone
    if many < 8 or len(finite) < 3 or (size if apart else cases * size) > MOST_VALUES:
        return None
    zero = np.zeros((cases, size))
    try:
        base = formed(zero)
        if apart:
            units = np.array([formed(zero + np.eye(size)[e]) - base for e in range(size)])
            # In which case each number stands.
            of = np.concatenate([np.repeat(np.arange(cases), own.sizes) for own in layout])
            found = np.broadcast_to(base, (many, len(base))).copy()
            for c in range(cases):
                where = np.flatnonzero(of == c)
                found[:, where] += flat[:, c] @ units[:, where]
        else:
            every = np.eye(cases * size).reshape(-1, cases, size)
            units = np.array([formed(unit) - base for unit in every])
            found = base + flat.reshape(many, -1) @ units
        tried = finite[[0, len(finite) // 2, -1]]
        exact = np.array([formed(answer) for answer in flat[tried]])
    except Exception:  # these values need not be ones that a check can judge
        return None
    size_of = np.max(np.abs(exact), axis=1, keepdims=True)
    return found if np.all(np.abs(found[tried] - exact) <= LINEAR * size_of) else None
