"""Shows a call with so many digits that it gives what the card says, once it is pasted."""

import re
from dataclasses import replace

import numpy as np

from autograder.judging.call_text import EXACT, rounded, shown_call
from autograder.judging.check import Ask, Check
from autograder.judging.verdict import Verdict
from autograder.protocol import Call, Fault

SHOWN = 4  # significant digits of a number on a card
NOISE = 1e-9  # less than this share of the largest number is rounding


def as_pasted(verdict: Verdict, check: Check, ask: Ask) -> Verdict:
    """The verdict; where its shown call would give something else, with all digits of the arguments."""
    call = verdict.worst
    stopped = verdict.failed is not None and not verdict.failed.tried
    if call is None or stopped or _alike(ask, call, rounded(call)):
        return verdict
    exact = shown_call(call, check.signature, EXACT)
    if verdict.failed:
        return replace(verdict, failed=replace(verdict.failed, call=exact))
    assert verdict.witness is not None  # it has shown this call
    return replace(verdict, witness=replace(verdict.witness, call=exact))


def _alike(ask: Ask, one: Call, other: Call) -> bool:
    """Whether two calls give the same to the digits that a card shows, or fail in the same way."""
    (first, *_), (second, *_) = ask([one]), ask([other])
    if first.fault or second.fault:
        return _without_digits(first.fault) == _without_digits(second.fault)
    return _same(first.value, second.value)


def _without_digits(fault: Fault | None) -> Fault | None:
    """The fault, whatever numbers of the call its message quotes."""
    return fault and replace(fault, message=re.sub(r"[-+.\de]*\d", "0", fault.message))


def _same(one, other) -> bool:
    if isinstance(one, dict | list) or isinstance(other, dict | list):
        return type(one) is type(other) and _parts(one, other)
    if np.shape(one) != np.shape(other):
        return False
    size = np.max(np.abs(one), initial=0.0, where=np.isfinite(one))
    with np.errstate(all="ignore"):
        return all(
            f"{a:.{SHOWN}g}" == f"{b:.{SHOWN}g}" or abs(a - b) <= NOISE * size
            for a, b in zip(np.ravel(one), np.ravel(other), strict=True)
        )


def _parts(one, other) -> bool:
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(_same(one[k], other[k]) for k in one)
    return len(one) == len(other) and all(map(_same, one, other))
