"""Finds out where in a student's code a number came up that is not finite: where NumPy first warned.

NumPy's warnings are heard, never printed. What crosses to the judge is which cause it is, and the line;
the sentence is made of them on the other side.
"""

import re
import sys
import traceback
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np

from .own_code import line_of
from .words import one_line

# By its name, what NumPy's warning holds, and the sentence, in which {} is for the line. The first
# that fits counts.
CAUSES = {
    "0/0": (
        r"^invalid value .*divide",
        "NumPy met 0/0 or ∞/∞{}. Where is the divisor 0, and what should come out there?",
    ),
    "division by 0": (
        r"^divide by zero .*(divide|reciprocal)",
        "NumPy divided by 0{}. Where is the divisor 0, and what should come out there?",
    ),
    "root": (
        r"^invalid value .*sqrt",
        "NumPy took the square root of a negative number{}. How does it come to be negative?",
    ),
    "logarithm": (
        r"^(invalid value|divide by zero) .*log",
        "NumPy took the logarithm of 0 or of a negative number{}. How does it come to be one?",
    ),
    "arc": (
        r"^invalid value .*(arcsin|arccos)",
        "NumPy took the inverse sine or cosine of a number beyond 1{}. Is it beyond 1 by rounding, or "
        "by more?",
    ),
    "power": (
        r"^(invalid value|divide by zero) .*power",
        "NumPy met a power of 0, or of a negative number, that has no value{}. Which base and which "
        "exponent meet there?",
    ),
    "overflow": (
        r"^overflow ",
        "A number became too large for NumPy{}. What makes it grow?",
    ),
    "wave of infinity": (
        r"^invalid value .*(sin|cos|tan)",
        "NumPy took a sine, cosine or tangent of ∞{}. How does the angle come to be ∞?",
    ),
    "infinities": (
        r"^invalid value ",
        "NumPy met ∞ − ∞ or 0 · ∞{}. Where does the ∞ come from?",
    ),
}
MOST_HEARD = 20
LATE = "infinities"  # something else made the infinity, which may have been heard as well


@dataclass(frozen=True)
class Cause:
    """Why a number is not finite: one of CAUSES, and the student's line, "" where it is not known."""

    kind: str
    line: str = ""

    @property
    def sentence(self) -> str:
        _, said = CAUSES[self.kind]
        return said.format(f" ({self.line})" if self.line else "")


@contextmanager
def heard() -> Iterator[list[Cause]]:
    """In the block NumPy's warnings become causes, in their order, each once."""
    found: list[Cause] = []

    def hear(message, *_, **__) -> None:
        text = str(message)
        kind = next((kind for kind, (holds, _) in CAUSES.items() if re.search(holds, text)), None)
        if kind is not None and len(found) < MOST_HEARD:
            cause = Cause(kind, one_line(line_of(traceback.extract_stack(sys._getframe(1)))))
            if cause not in found:
                found.append(cause)

    with warnings.catch_warnings(), np.errstate(all="warn", under="ignore"):
        warnings.simplefilter("ignore")
        warnings.simplefilter("always", RuntimeWarning)
        warnings.showwarning = hear
        yield found


def likeliest(found: list[Cause]) -> Cause | None:
    """The first that is no mere consequence of an infinity; None for none."""
    return next((cause for cause in found if cause.kind != LATE), found[0] if found else None)


def encode_cause(cause: Cause | None) -> list | None:
    """In JSON's terms."""
    return [cause.kind, cause.line] if cause else None


def decode_cause(message) -> Cause | None:
    """What `encode_cause` wrote; None for anything else, as the sandbox may send it."""
    match message:
        case [str(kind), str(line)] if kind in CAUSES:
            return Cause(kind, one_line(line))
    return None
