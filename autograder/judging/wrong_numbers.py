"""What each of a check's mistakes gives for its calls, in the layout in which answers are compared."""

from collections.abc import Sequence
from itertools import groupby

import numpy as np

from autograder.judging.diagnosis import Catalogue, Mistake, Wrong
from autograder.judging.models import evaluated
from autograder.judging.quantities import Quantities
from autograder.judging.stacked import Layout, rows, stacked, unlike
from autograder.protocol import Call


def wrong_numbers(
    mistakes: Sequence[Mistake],
    catalogue: Catalogue | None,
    quantities: Quantities,
    layout: list[Layout],
    calls: list[Call],
) -> Wrong:
    """The numbers of every mistake: of those that are written, then of the catalogue's."""
    named = list(mistakes)
    found = [rows(layout, quantities(calls, list(evaluated(m.wrong, calls)))) for m in named]
    parts = [
        np.array([own[k] for own in found]).reshape(len(found), of.length)
        for k, of in enumerate(layout)
    ]
    made = catalogue(calls) if catalogue else []
    named += [mistake for mistake, _ in made]
    for shape, group in groupby((values for _, values in made), _shape):
        alike = list(group)
        if shape is None:
            more = unlike(layout, quantities, calls, alike)
        else:
            numbers = np.array([np.asarray(own, dtype=float) for own in alike])
            more = stacked(layout, quantities, calls, numbers)
        parts = [np.vstack(both) for both in zip(parts, more, strict=True)]
    return Wrong(named, parts)


def _shape(values) -> tuple[int, ...] | None:
    """Of what came for all calls; None where calls differ in it, as motions do."""
    if isinstance(values, np.ndarray) and values.dtype != object:
        return values.shape
    shapes = {np.shape(value) for value in values}
    return (len(values), *shapes.pop()) if len(shapes) == 1 else None
