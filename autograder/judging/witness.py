"""The worst case of a wrong answer, as a student would type the call, with what came back."""

from collections.abc import Callable
from functools import partial

import numpy as np

from autograder.judging.call_text import by_name, shown_call
from autograder.judging.criterion import LEAST_SCALE, Criterion, scales
from autograder.judging.percent import percent
from autograder.judging.places import Place
from autograder.judging.quantities import Numbers
from autograder.judging.verdict import Witness
from autograder.protocol import Call

# An error of more times the right value is told in its unit alone.
MOST_TIMES = 3


def worst_entry(right: np.ndarray, given: np.ndarray) -> tuple[int, ...]:
    """The index of the number that is furthest off."""
    at = np.unravel_index(np.argmax(np.abs(given - right)), np.shape(right))
    return tuple(int(i) for i in at)


def wrong_places(
    criterion: Criterion, expected: Numbers, given: Numbers, k: int
) -> set[tuple[int, ...]]:
    """The indices that are off in any case, of criterion k; none where it is of one number, or where
    cases differ in their shapes, as then an index means another thing in each.
    """
    right, theirs = (
        [case[k] for case in numbers if np.size(case[k])] for numbers in (expected, given)
    )
    if len({np.shape(value) for value in (*right, *theirs)}) != 1 or np.size(right[0]) == 1:
        return set()
    scale = scales(right)
    off = [
        np.abs(t - r) > criterion.tolerance * s
        for r, t, s in zip(right, theirs, scale, strict=True)
    ]
    return {tuple(int(i) for i in at) for at in np.argwhere(np.any(off, axis=0))}


def witness(
    call: Call, signature: str, right: np.ndarray, given: np.ndarray, criterion: Criterion,
    largest: float, place: Place, what: str = "", pose: Callable[[Call], list] | None = None,
) -> Witness:  # fmt: skip
    """The entry of one case that is furthest off. what: of which quantity, where it is not plain.

    largest: the size of the criterion's largest right number, in all cases. place: where the entry
    stands in what came back. pose: gives the joints of the arm in this call, one (x, y) in m each, to
    be drawn.
    """
    at = worst_entry(right, given)
    joints = tuple((float(x), float(y)) for x, y in pose(call)) if pose else ()
    named = by_name(call, signature)
    made = partial(Witness, shown_call(call, signature), pose=joints, by_name=named, of=call)
    if criterion.is_truth:
        asked = f" ({what})" if what else ""
        said = f"{bool(given[at])}; the right answer is {bool(right[at])}{asked}"
        if not call.truth:  # it is the check that asks, of what came back
            said = f"a result for which “{criterion.text}” has the answer {_yes_or_no(given[at])}"
        return made(said, "")
    off, size = abs(float(given[at] - right[at])), abs(float(right[at]))
    shares = has_share(off, size, largest, criterion)
    share = f" ({percent(off / size)} of the right value)" if shares else ""
    flat = int(np.ravel_multi_index(at, np.shape(right))) if at else 0
    unit = f" {criterion.unit_of(flat, np.size(right))}".rstrip()
    if len(criterion.entries) == np.size(right):
        what = what.replace(criterion.text, criterion.entries[int(*at)])
    where = str(place)
    entry = f" at {where}" if place.is_entry else ""
    made_of = f"made of {where}" if where and not entry else ""
    of = ", ".join(filter(None, [what, made_of]))
    return made(
        f"{float(given[at]):.4g}{unit}{entry}{f' ({of})' if of else ''}",
        f"{off:.3g}{unit}{share}",
        where=where if entry else "",
    )


def _yes_or_no(truth: float) -> str:
    return "yes" if truth else "no"


def has_share(off: float, size: float, largest: float, criterion: Criterion) -> bool:
    """Whether an error is rightly told as a share of a right number of this size.

    Not near zero, where any error is many times the value; not where it is many times the value anyway;
    and not where other numbers are right too.
    """
    says = size >= LEAST_SCALE * largest and off < MOST_TIMES * size
    return says and not criterion.is_bound
