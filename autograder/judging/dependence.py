"""Finds out on which of its arguments an answer depends and should not, or should and does not.

The function is called again with one number changed at a time. What may be said follows from its
numbers alone: nothing where a call fails, or where an argument is no number, array of numbers or
namespace of them.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np

from autograder.judging.criterion import TOLERANCE
from autograder.judging.quantities import Numbers
from autograder.protocol import Call

# What moves by no more than this share of the size does not move.
ROUNDING = 1e-9
# With more numbers than these, as of a motion's samples, one alone says nothing.
MOST = 30
# Of more arguments than so many, three are named.
MOST_LISTED = 5
# Of a state: its size and its sign, as Coulomb friction knows the sign alone.
EITHER_SIGN: tuple[Callable, ...] = (lambda x: 1.25 * x + 0.1, lambda x: -x)
# Of a length or a mass.
POSITIVE: tuple[Callable, ...] = (lambda x: 1.25 * x + 0.1,)


@dataclass(frozen=True)
class Probe:
    """A call with one number changed, or one matrix. of: that as a student writes it, "arm.I2", "q[1]",
    "gains.KD".
    """

    of: str
    call: Call


def probes(signature: str, call: Call, matrices: bool = False) -> list[Probe]:
    """One or two for each number in the arguments; none where they are too many, or not all numbers.

    matrices: whether an array of two axes or more is changed too, as a whole; else one leaves none.
    """
    names = signature.partition("(")[2].removesuffix(")").split(", ")
    found: list[Probe] = []
    if call.at or call.parts:
        return []
    for place, (name, value) in enumerate(zip(names, call.args, strict=False)):
        if not _is_plain(value, matrices):
            return []
        for of, other in _changed(name, value, EITHER_SIGN):
            args = (*call.args[:place], other, *call.args[place + 1 :])
            found.append(Probe(of, replace(call, args=args)))
    return found if len({probe.of for probe in found}) <= MOST else []


@dataclass(frozen=True)
class Tried:
    """A call and its probes. right, theirs: the quantities of the unchanged call, then of the probes."""

    probes: list[Probe]
    right: Numbers
    theirs: Numbers

    def within(self, k: int) -> "Tried":
        """Without the probes that quantity k does not judge, or not as it judges the call."""
        before = np.shape(self.right[0][k])
        kept = [i for i, case in enumerate(self.right) if np.shape(case[k]) == before]
        probes = [self.probes[i - 1] for i in kept[1:]]
        return Tried(probes, [self.right[i] for i in kept], [self.theirs[i] for i in kept])


def sentence(text: str, k: int, at: Tried, elsewhere: Callable[[], Tried | None]) -> str:
    """What an answer's quantity k, called `text`, depends on unlike the right one; "" for nothing.

    elsewhere: the probes of another call, None where they gave no numbers. An answer that is right in
    some calls only may depend on an argument there and not here, so "does not depend" needs both.
    """
    tried, right, theirs = at.probes, at.right, at.theirs
    # What moves a little, as friction of a joint that creeps, is said neither to move nor not to.
    needed, used = (moving(k, tried, numbers, TOLERANCE) for numbers in (right, theirs))
    may_need, may_use = (moving(k, tried, numbers, ROUNDING) for numbers in (right, theirs))
    extra = [of for of in used if of not in may_need]
    missing = [of for of in needed if of not in may_use]
    if missing:
        other = elsewhere()
        may_use += moving(k, other.probes, other.theirs, ROUNDING) if other else missing
        missing = [of for of in missing if of not in may_use]
    fields = {of for of in needed if "." in of}
    if fields and not any("." in of for of in may_use):
        (owner, *_) = {of.partition(".")[0] for of in fields}
        return (
            f"In your {text}, the values do not depend on {owner} at all. Did you write the numbers of "
            "one example into the function?"
        )
    said = []
    if extra:
        said.append(f"the values depend on {listed(extra)}; the right ones do not")
    if missing:
        own = "they" if said else "the values"
        said.append(f"{own} do not depend on {listed(missing)}; the right ones do")
    return f"In your {text}, {', and '.join(said)}." if said else ""


def moving(k: int, tried: list[Probe], numbers: Numbers, least: float) -> list[str]:
    """The arguments whose change moves quantity k by more than this share, each once, in their order."""
    before = np.asarray(numbers[0][k])
    found: dict[str, None] = {}
    for probe, after in zip(tried, numbers[1:], strict=True):
        now = np.asarray(after[k])
        size = max(np.max(np.abs(before), initial=0.0), np.max(np.abs(now), initial=0.0))
        if now.shape != before.shape or np.any(np.abs(now - before) > least * size):
            found[probe.of] = None
    return list(found)


def _is_plain(value, matrices: bool) -> bool:
    if isinstance(value, SimpleNamespace):
        return all(_is_plain(entry, matrices) for entry in vars(value).values())
    if isinstance(value, np.ndarray):
        return value.ndim == 1 or (matrices and value.ndim > 1)
    return isinstance(value, float)


def _changed(name: str, value, changes: tuple[Callable, ...]) -> Iterator[tuple[str, object]]:
    """The value with each of its numbers changed in turn."""
    if isinstance(value, SimpleNamespace):
        for field, entry in vars(value).items():
            for of, other in _changed(f"{name}.{field}", entry, POSITIVE):
                yield of, SimpleNamespace(**vars(value) | {field: other})
    elif isinstance(value, np.ndarray) and value.ndim > 1:
        for change in POSITIVE:  # a symmetric matrix stays one, and positive definite
            yield name, change(value)
    elif isinstance(value, np.ndarray):
        for i in range(len(value)):
            for change in changes:
                other = value.copy()
                other[i] = change(other[i])
                yield f"{name}[{i}]", other
    else:
        for change in changes:
            yield name, change(value)


def listed(names: list[str]) -> str:
    """Their names in a sentence; of too many the first few."""
    if len(names) > MOST_LISTED:
        return f"{', '.join(names[:3])} and {len(names) - 3} other numbers"
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last
