"""Finds two mistakes of which one turns the sign of the whole answer, and the other is found beneath it.

Their errors do not add up, as those of two wrong terms do: E(0) − E has the wrong sign in every term,
also in one that lacks its ½. Other factors of the whole are no such sign: half of a double angle is the
sine times the cosine of the angle, in which nobody halved anything.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from autograder.judging.claims import ON_TOP
from autograder.judging.criterion import Criterion
from autograder.judging.stacked import Layout

if TYPE_CHECKING:
    from autograder.judging.diagnosis import Wrong


def on_top(
    wrong: Wrong,
    criteria: tuple[Criterion, ...],
    layout: list[Layout],
    right: list[np.ndarray],
    given: list[np.ndarray],
    met: list[bool],
) -> list[tuple[str, ...]]:
    """What to say of each criterion; [] where no two mistakes explain the answer so.

    right, given: the numbers of each criterion in a row.
    """
    if any(criterion.is_truth or criterion.is_bound or criterion.in_loop for criterion in criteria):
        return []
    if (found := _of_the_sign(wrong, criteria, layout, right)) is None:
        return []
    place, turned = found
    if any(ok and turns for ok, turns in zip(met, turned, strict=True)):
        return []  # it would spoil what is right
    mended = [-own if turns else own for own, turns in zip(given, turned, strict=True)]
    if (beneath := wrong.explaining(criteria, layout, mended, met)) is None:
        return []
    said: list[tuple[str, ...]] = []
    for k, (ok, turns) in enumerate(zip(met, turned, strict=True)):
        is_right = layout[k].same(right[k], mended[k], criteria[k].tolerance)
        sign = [wrong.mistakes[place].sentence] if turns else []
        other = [] if is_right else [ON_TOP + beneath.sentence]
        said.append(() if ok else (*sign, *other))
    return said


def _of_the_sign(
    wrong: Wrong, criteria: tuple[Criterion, ...], layout: list[Layout], right: list[np.ndarray]
) -> tuple[int, list[bool]] | None:
    """The place of the first mistake that turns the sign of what is right; and in which criteria it
    does, which are not all, as of velocities in ẋ.
    """
    left = np.arange(len(wrong.mistakes))
    turned = np.zeros((len(left), len(criteria)), dtype=bool)
    for k, criterion in enumerate(criteria):
        rows = wrong.rows[k][left]
        same = layout[k].same(right[k], rows, criterion.tolerance)
        turns = layout[k].same(-right[k], rows, criterion.tolerance)
        turned[left, k] = turns & ~same
        left = left[same | turns]
    found = [place for place in left if np.any(turned[place])]
    # One that turns a part alone, as the sign of P, is no sign of the whole.
    whole = [
        place for place in found if np.sum(turned[place]) == np.max(np.sum(turned[found], axis=1))
    ]
    return (int(whole[0]), turned[whole[0]].tolist()) if whole else None
