"""Shows a call as a student can paste it: in few digits, with what the card says as its result.

The arguments that `worst_case` gives are those that are shown.
"""

import re
from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from autograder.judging.call_text import (
    EXACT,
    FEW,
    SHORT,
    arguments,
    by_name,
    given_by,
    rounded,
    shapes,
    shown_call,
)
from autograder.judging.check import Ask, Check
from autograder.judging.quantities import each
from autograder.judging.verdict import Failed, Verdict, Witness
from autograder.protocol import Call, Fault

SHOWN = 4  # of a number that came back
NOISE = 1e-9  # less than this share of the largest number is rounding


def as_pasted(
    verdict: Verdict, check: Check, ask: Ask, calls: list[Call], namespace: Mapping
) -> Verdict:
    """The verdict; its call in as few digits as give what it says, or else in all of them.

    calls: all that the check has made. namespace: the student's, whose functions the names of arguments
    leave alone.
    """
    signature = _beside(namespace, check.signature)
    if verdict.failed:
        return replace(verdict, failed=_failed(verdict.failed, check, signature, ask))
    if not verdict.witness or verdict.witness.of is None:
        return verdict
    witness = _judged_again(verdict, check, ask, calls) or _of_digits(verdict.witness, check, ask)
    call = witness.of
    assert call is not None  # both keep it
    named = by_name(call, signature)
    # A call with symbols or long arrays stands by the names.
    text = named if witness.call == by_name(call, check.signature) else witness.call
    lines = given_by(call, signature, check.id)
    return replace(verdict, witness=replace(witness, call=text, by_name=named, given_by=lines))


def _beside(namespace: Mapping, signature: str) -> str:
    """The signature; a name that is a function of the student's, as f in rk4_step(f, x, u, dt), is
    changed, so that what is pasted does not replace the function.
    """
    names = [f"{n}_given" if callable(namespace.get(n)) else n for n in arguments(signature)]
    return f"{signature.partition('(')[0]}({', '.join(names)})"


def _judged_again(verdict: Verdict, check: Check, ask: Ask, calls: list[Call]) -> Witness | None:
    """The worst case of rounded calls that leave all criteria as they are; None for none.

    Where several calls are judged together, or a truth may turn at a number, none are rounded.
    """
    if not isinstance(check.quantities, each) or any(call.truth for call in calls):
        return None
    bare = replace(check, mistakes=(), catalogue=None, terms=())
    for digits in FEW:
        found = bare.on([rounded(call, digits) for call in calls], ask)
        if _outline(found) == _outline(verdict):
            return found.witness
    return None


def _outline(verdict: Verdict) -> tuple:
    where = verdict.witness and verdict.witness.where
    met = [row.met for row in verdict.rows]
    return verdict.state, met, verdict.problem, verdict.remark, where


def _of_digits(witness: Witness, check: Check, ask: Ask) -> Witness:
    """The worst case with its call rounded, if that gives the same to the digits of the card."""
    call = witness.of
    assert call is not None
    few = rounded(call)
    if _alike(ask, call, few, _same):
        return replace(witness, of=few)
    return replace(witness, call=shown_call(call, check.signature, EXACT))


def _failed(failed: Failed, check: Check, signature: str, ask: Ask) -> Failed:
    """With its calls in as few digits as fail, and work, in the same way."""

    def digits_for(call: Call) -> int:
        enough = (n for n in (*FEW, SHORT) if _alike(ask, call, rounded(call, n), _lack_the_same))
        return next(enough, EXACT)

    call, works = failed.of, failed.works
    if call is None:
        return failed
    digits = digits_for(call) if failed.tried else SHORT  # the call may never end
    few = rounded(call, digits)
    if works and failed.of_works is not None:
        own = digits_for(failed.of_works)
        works = shown_call(failed.of_works, signature, own) + shapes(failed.of_works, signature)
    return replace(
        failed,
        call=shown_call(few, signature, digits),
        works=works,
        of=few,
        by_name=by_name(few, signature),
        given_by=given_by(few, signature, check.id),
    )


def _alike(ask: Ask, one: Call, other: Call, same: Callable) -> bool:
    """Whether two calls give the same, or fail in the same way. same: whether two values are."""
    (first, *_), (second, *_) = ask([one]), ask([other])
    if first.fault or second.fault:
        return _without_digits(first.fault) == _without_digits(second.fault)
    return same(first.value, second.value)


def _without_digits(fault: Fault | None) -> Fault | None:
    """The fault, whatever numbers of the call its message quotes."""
    return fault and replace(fault, message=re.sub(r"[-+.\de]*\d", "0", fault.message))


def _lack_the_same(one, other) -> bool:
    """Whether two values that cannot be judged have one shape, and are not finite in the same places."""
    if isinstance(one, dict | list) or isinstance(other, dict | list):
        return _same(one, other)
    return np.shape(one) == np.shape(other) and np.array_equal(np.isfinite(one), np.isfinite(other))


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
