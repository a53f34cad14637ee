"""Finds out whether the units of an answer's terms come out: in other units of mass, length and speed.

In other units the right values are all multiplied by one number, and so are those of any sum of terms
whose units are right. Nothing is asked of a right answer that does not do so, as where a length stands
among the coordinates, nor of arguments that are told by other names.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np

from autograder.judging.criterion import TOLERANCE
from autograder.judging.quantities import Numbers
from autograder.protocol import Call


@dataclass(frozen=True)
class Change:
    """of: in words what is done to the arguments. factors: by patterns of their names, of which all that
    are there apply. question: what to ask where an answer does not behave as the right one.
    """

    of: str
    factors: dict[str, float]
    question: str = "Do all its terms have the same unit?"


INERTIAS = r"[IJ](\d*|_com)"
CHANGES = (
    Change(
        "every mass and inertia doubled, and all else that holds kilograms",
        {rf"m[\dcp]*|{INERTIAS}|k\d*|viscous|coulomb|u": 2.0},
    ),
    Change(
        "every length doubled and every inertia four times as large",
        {r"lc?\d*|r\d*": 2.0, INERTIAS: 4.0},
    ),
    Change(
        "every velocity doubled", {"qd": 2.0}, "How many velocities does each of its terms hold?"
    ),
)
BEHAVE = {
    0: "stay the same",
    1: "double",
    2: "become four times as large",
    3: "become eight times as large",
}
# Equal to this share, they are one multiple: the right values, which are exact.
EXACT = 1e-9


@dataclass(frozen=True)
class Scaled:
    """A call in other units."""

    change: Change
    call: Call


def scalings(signature: str, call: Call) -> list[Scaled]:
    """One for each of CHANGES that changes an argument."""
    if call.parts:
        return []
    names = signature.partition("(")[2].removesuffix(")").split(", ")
    found = []
    for change in CHANGES:
        by = change.factors
        args = tuple(_scaled(names, call.args, by))
        at = tuple({n: v * _factor(n, by) for n, v in point.items()} for point in call.at)
        if _differ(args, call.args) or at != call.at:
            found.append(Scaled(change, replace(call, args=args, at=at)))
    return found


@dataclass(frozen=True)
class InOtherUnits:
    """right, theirs: the quantities of a call, then of the same in other units."""

    scaled: list[Scaled]
    right: Numbers
    theirs: Numbers


def sentence(text: str, k: int, tried: InOtherUnits) -> str:
    """In which units quantity k, called `text`, does not behave as the right one; "" for none."""
    for one, expected, given in zip(tried.scaled, tried.right[1:], tried.theirs[1:], strict=True):
        power = _power(np.asarray(tried.right[0][k]), np.asarray(expected[k]))
        if power is None:
            continue
        before, after = np.asarray(tried.theirs[0][k]), np.asarray(given[k])
        if before.shape != after.shape:
            continue
        size = max(2.0**power * np.max(np.abs(before)), np.max(np.abs(after)))
        if np.any(np.abs(after - 2.0**power * before) > TOLERANCE * size):
            return (
                f"With {one.change.of}, the right values {BEHAVE[power]}, and those of your {text} do "
                f"not. {one.change.question}"
            )
    return ""


def _power(before: np.ndarray, after: np.ndarray) -> int | None:
    """The power of 2 that all values are multiplied by; None where there is none, or all are 0, or how
    many there are depends on the units.
    """
    if not np.any(before) or before.shape != after.shape:
        return None
    for power in BEHAVE:
        if np.all(np.abs(after - 2.0**power * before) <= EXACT * np.max(np.abs(after))):
            return power
    return None


def _scaled(names: list[str], args: tuple, factors: dict[str, float]) -> Iterator[object]:
    for name, value in zip(names, args, strict=False):
        if isinstance(value, SimpleNamespace):
            yield SimpleNamespace(**{f: v * _factor(f, factors) for f, v in vars(value).items()})
        elif name == "x" and isinstance(value, np.ndarray):  # a state, of which half are velocities
            q, qd = np.split(value, [value.shape[-1] // 2], axis=-1)
            yield np.concatenate([q, qd * _factor("qd", factors)], axis=-1)
        elif isinstance(value, float | np.ndarray):
            yield value * _factor(name, factors)
        else:
            yield value


def _factor(name: str, factors: dict[str, float]) -> float:
    return next((by for of, by in factors.items() if re.fullmatch(of, name)), 1.0)


def _differ(args: tuple, others: tuple) -> bool:
    """Whether some number in the arguments is another one."""
    return any(
        _differ(tuple(vars(a).values()), tuple(vars(b).values()))
        if isinstance(a, SimpleNamespace)
        else isinstance(a, float | np.ndarray) and not np.array_equal(a, b)
        for a, b in zip(args, others, strict=True)
    )
