"""Which calls a visible check may need right numbers for, and by what a call is known."""

import json

import numpy as np

from autograder.digest import digest
from autograder.judging import dependence, scaling
from autograder.judging.call_text import FEW, rounded
from autograder.judging.check import VISIBLE_CASES, VISIBLE_SEED, Check
from autograder.judging.loops import Loop
from autograder.judging.quantities import each
from autograder.protocol import Call, encode_call


def visible_calls(check: Check) -> list[Call]:
    """The calls that a visible check tries."""
    return check.calls(np.random.default_rng(VISIBLE_SEED), VISIBLE_CASES)


def shown_calls(check: Check) -> list[Call]:
    """Those that a card may show: the visible ones, and where each is judged by itself, these in fewer
    digits.
    """
    calls = visible_calls(check)
    if not isinstance(check.quantities, each) or any(call.truth for call in calls):
        return calls
    return [*calls, *(rounded(call, digits) for digits in FEW for call in calls)]


def all_calls(check: Check) -> list[Call]:
    """These, and those by which more is found out of a wrong answer: one number of a call changed at a
    time, or all of one unit.
    """
    calls = shown_calls(check)
    if not isinstance(check.quantities, each):
        return calls
    # A whole run is asked for once.
    alone = [call for call in calls if not isinstance(call, Loop)]
    probes = [
        probe.call
        for call in alone
        for probe in dependence.probes(check.signature, call, matrices=True)
    ]
    scaled = [one.call for call in alone for one in scaling.scalings(check.signature, call)]
    return [*calls, *probes, *scaled]


def key(call: Call) -> str:
    """A name for the call; one with other arguments has another."""
    return digest(json.dumps(encode_call(call), sort_keys=True))[:24]
