"""Writes a check in numbers: what is asked, and what right answers and wrong models give."""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from autograder.bundle.describing import Describing, DescribingError
from autograder.bundle.left_to_grader import form_of, plain, why_left_out
from autograder.judging.check import Check
from autograder.judging.diagnosis import Mistake
from autograder.judging.models import evaluated
from autograder.stored.asking import all_calls, key, shown_calls, visible_calls

# What of a check is asked, and holds no answer.
ASKED = (
    "id",
    "signature",
    "quantities",
    "criteria",
    "hints",
    "section",
    "further",
    "returns",
)


@dataclass(frozen=True)
class InNumbers:
    """asked: what `stored.checks` makes the check of. numbers: what `stored.numbers.Numbers` reads."""

    asked: dict
    numbers: dict


def in_numbers(check: Check, name: str, describing: Describing) -> InNumbers:
    """The check in numbers, under this name. DescribingError where something of it cannot be stored."""
    try:
        return _in_numbers(check, name, describing)
    except DescribingError as error:
        raise DescribingError(f"check {name}: {error}") from error


def _in_numbers(check: Check, name: str, describing: Describing) -> InNumbers:
    why = why_left_out(check)
    defaults = {field.name: field.default for field in fields(Check)}
    left = ("quantities",) if why else ()
    describing.beside.clear()
    asked = {
        own: describing.of(value)
        for own in ASKED
        if own not in left and (value := getattr(check, own)) is not defaults[own]
    }
    if check.follows:  # how an answer follows from another would give it away
        asked["follows"] = describing.of(tuple(replace(own, way=None) for own in check.follows))
    said = {"asked": asked, "numbers": name, "left_out": why, "mistakes": [], "generated": False}
    calls = visible_calls(check)
    if why:
        said["fits"] = describing.of(form_of(check))
        return InNumbers(said, {"calls": [describing.of(plain(call)) for call in calls]})
    every = all_calls(check)
    made = check.catalogue(calls) if check.catalogue else []
    said |= {
        "mistakes": [_said(own) for own in check.mistakes],
        "generated": bool(check.catalogue),
        "pose": bool(check.pose),
    }
    drawn = shown_calls(check) if check.pose else []
    terms = check.terms if isinstance(check.terms, tuple) else check.terms()

    def of(model, calls):
        return describing.of(list(evaluated(model, calls)))

    return InNumbers(
        said,
        {
            "calls": [describing.of(call) for call in calls],
            "asked": [key(call) for call in every],
            "shown": [key(call) for call in drawn],
            "pose": [describing.of(list(check.pose(call))) for call in drawn if check.pose],
            "reference": of(check.reference, every),
            "beside": [of(own.model, every) for own in describing.beside],
            "mistakes": [of(own.wrong, calls) for own in check.mistakes],
            "terms": [[own.name, of(own.model, calls)] for own in terms],
            "generated": [[_said(own), describing.of(_alike(values))] for own, values in made],
        },
    )


def _alike(values: Sequence | np.ndarray) -> Sequence | np.ndarray:
    """Numbers of calls that differ in their shape are a list."""
    return list(values) if isinstance(values, np.ndarray) and values.dtype == object else values


def _said(mistake: Mistake) -> dict:
    return {
        "name": mistake.name,
        "sentence": mistake.sentence,
        "claim": mistake.claim.name,
        "combines": mistake.combines,
        "seldom": mistake.seldom,
    }
