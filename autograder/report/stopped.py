"""Answers that gave no numbers: how many, and why most of them did not."""

import re
from collections import Counter, defaultdict
from collections.abc import Iterable
from dataclasses import dataclass

from autograder.judging.verdict import State
from autograder.report.students import Student

PLACE = re.compile(r" \((?:the cell of \S+, )?line \d")


@dataclass(frozen=True)
class Stopped:
    """The answers to a check that gave no numbers: of so many students; and why, for so many of them.

    often: "" where only an earlier version of the course graded them, which did not keep it.
    """

    check: str
    students: int
    often: str
    by: int


def stopped(students: Iterable[Student]) -> list[Stopped]:
    """By check, that with the most first."""
    reasons: dict[str, Counter[str]] = defaultdict(Counter)
    for student in students:
        for check, verdict in student.verdicts.items():
            if verdict["state"] == State.ERROR.value:
                reasons[check][_without_place(verdict.get("problem", ""))] += 1
    found = [
        Stopped(check, counts.total(), *max(counts.items(), key=lambda one: (one[0] != "", one[1])))
        for check, counts in reasons.items()
    ]
    return sorted(found, key=lambda one: (-one.students, one.check))


def _without_place(problem: str) -> str:
    """What went wrong, without the line in this student's code."""
    place = PLACE.search(problem)
    return f"{problem[: place.start()]}." if place else problem
