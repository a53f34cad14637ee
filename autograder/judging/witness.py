"""The worst case of a wrong answer, as a student would type the call, with what came back."""

from collections.abc import Callable
from types import SimpleNamespace

import numpy as np

from autograder.judging.criterion import Criterion
from autograder.judging.verdict import Witness
from autograder.protocol import Call, Expressions, Function, Symbol

LONGEST_ARRAY = 12  # entries; a longer one is shown by its shape


def witness(
    call: Call, right: np.ndarray, given: np.ndarray, criterion: Criterion,
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
        if not call.truth:  # it is the check that asks, of what came back
            said = f"a result for which “{criterion.text}” has the answer {_yes_or_no(given[at])}"
        return Witness(shown_call(call), said, "", joints)
    off, size = abs(float(given[at] - right[at])), abs(float(right[at]))
    share = f" ({_percent(off / size)} of the right value)" if size > 0 else ""
    place = int(np.ravel_multi_index(at, np.shape(right))) if at else 0
    unit = f" {criterion.unit_of(place, np.size(right))}".rstrip()
    entry = "" if np.size(right) == 1 else f" in entry {', '.join(map(str, at))}"
    if len(criterion.entries) == np.size(right):
        entry, what = "", what.replace(criterion.text, criterion.entries[int(*at)])
    of = f" ({what})" if what else ""
    return Witness(
        shown_call(call),
        f"{float(given[at]):.4g}{unit}{entry}{of}",
        f"{off:.3g}{unit}{share}",
        joints,
    )


def _yes_or_no(truth: float) -> str:
    return "yes" if truth else "no"


def shown_call(call: Call) -> str:
    """A call as a student would type it, numbers shortened."""
    names = {name: f"{at:.4g}" for name, at in call.at[-1].items()} if call.at else {}
    return f"{call.name}({', '.join(_shown(value, names) for value in call.args)})"


def _percent(share: float) -> str:
    return f"{share:.0%}" if share >= 0.01 else f"{100 * share:.1g}%"


def _shown(value, names) -> str:
    match value:
        case Symbol(name):
            return f"{name}={names.get(name, name)}"
        case Expressions(rows):
            return f"[{', '.join('[' + ', '.join(row) + ']' for row in rows)}]"
        case Function(arguments, returns):
            return f"lambda {arguments}: {returns}"
        case SimpleNamespace():
            inside = ", ".join(f"{name}={_shown(v, names)}" for name, v in vars(value).items())
            return f"({inside})"
        case tuple():
            return f"[{', '.join(_shown(entry, names) for entry in value)}]"
        case np.ndarray() if value.size > LONGEST_ARRAY:
            return f"an array of shape {value.shape}"
        case np.ndarray():
            return np.array2string(value, precision=4, separator=", ").replace("\n", "")
    return f"{value:.4g}"
