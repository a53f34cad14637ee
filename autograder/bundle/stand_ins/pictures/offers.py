"""No card offers a picture of two motions: a student's package has only one's own."""

from collections.abc import Mapping

from autograder.judging.card import Line
from autograder.judging.check import Check
from autograder.judging.verdict import Verdict


def offer(verdict: Verdict, check: Check, namespace: Mapping) -> list[Line]:
    """No line."""
    return []
