"""Tells which argument is 0 in the calls that gave no finite number, and in no other call."""

from collections.abc import Callable, Iterator
from itertools import combinations
from types import SimpleNamespace

import numpy as np

from autograder.protocol import Call


def sentence(signature: str, calls: list[Call], bad: list[int]) -> str:
    """Of the first of the bad calls; "" where no argument tells them from others, or there are none."""
    failing = [dict(_numbers(signature, calls[k])) for k in bad]
    works = [dict(_numbers(signature, call)) for k, call in enumerate(calls) if k not in bad]

    def tells(holds: Callable[..., bool], *names: str) -> bool:
        """Whether it holds of these arguments in the bad calls, and in no other."""
        some, others = ([holds(*map(one.get, names)) for one in of] for of in (failing, works))
        return bool(works) and all(some) and not any(others)

    first = failing[0]
    for name, value in first.items():
        if tells(_has_zero, name):
            other = f"no entry of {name} is" if value.ndim else "it is not"
            return f"In this call {_place(name, value)} is 0; in the calls that work {other}."
    for a, b in combinations(first, 2):
        if tells(_are_equal, a, b):
            return f"In this call {a} and {b} are equal; in the calls that work they are not."
    return ""


def _numbers(signature: str, call: Call) -> Iterator[tuple[str, np.ndarray]]:
    """Each number or array of numbers among the arguments, as a student writes it."""
    names = signature.partition("(")[2].removesuffix(")").split(", ")
    for name, value in zip(names, call.args, strict=False):
        if isinstance(value, SimpleNamespace):
            for field, entry in vars(value).items():
                if isinstance(entry, float | int | np.ndarray):
                    yield f"{name}.{field}", np.asarray(entry)
        elif isinstance(value, float | np.ndarray):
            yield name, np.asarray(value)


def _has_zero(value: np.ndarray | None) -> bool:
    return value is not None and bool(np.any(value == 0))


def _place(name: str, value: np.ndarray) -> str:
    at = ", ".join(map(str, np.argwhere(value == 0)[0].tolist()))
    return f"{name}[{at}]" if at else name


def _are_equal(a: np.ndarray | None, b: np.ndarray | None) -> bool:
    """Whether two arrays are; two numbers may be so by chance."""
    return a is not None and b is not None and a.ndim > 0 and np.array_equal(a, b)
