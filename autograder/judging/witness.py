"""The worst case of a wrong answer, as a student would type the call, with what came back."""

from collections.abc import Callable

import numpy as np

from autograder.judging.call_text import shown_call
from autograder.judging.criterion import Criterion
from autograder.judging.verdict import Witness
from autograder.protocol import Call


def witness(
    call: Call, signature: str, right: np.ndarray, given: np.ndarray, criterion: Criterion,
    what: str = "", pose: Callable[[Call], list] | None = None,
) -> Witness:  # fmt: skip
    """The entry of one case that is furthest off. what: of which quantity, where it is not plain.

    pose: gives the joints of the arm in this call, one (x, y) in m each, to be drawn.
    """
    at = np.unravel_index(np.argmax(np.abs(given - right)), np.shape(right))
    joints = tuple((float(x), float(y)) for x, y in pose(call)) if pose else ()
    if criterion.is_truth:
        asked = f" ({what})" if what else ""
        said = f"{bool(given[at])}; the right answer is {bool(right[at])}{asked}"
        return Witness(shown_call(call, signature), said, "", joints)
    off, size = abs(float(given[at] - right[at])), abs(float(right[at]))
    share = f" ({_percent(off / size)} of the right value)" if size > 0 else ""
    unit = f" {criterion.unit}".rstrip()
    entry = "" if np.size(right) == 1 else f" in entry {', '.join(map(str, at))}"
    if len(criterion.entries) == np.size(right):
        entry, what = "", what.replace(criterion.text, criterion.entries[int(*at)])
    of = f" ({what})" if what else ""
    return Witness(
        shown_call(call, signature),
        f"{float(given[at]):.4g}{unit}{entry}{of}",
        f"{off:.3g}{unit}{share}",
        joints,
    )


def _percent(share: float) -> str:
    return f"{share:.0%}" if share >= 0.01 else f"{100 * share:.1g}%"
