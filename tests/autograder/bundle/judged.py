"""Judges answers with whatever `autograder` is installed: the course's, or a student's package.

As a program it reads tasks in JSON from stdin, and writes what was found to stdout.
"""

import contextlib
import io
import json
import sys

import numpy as np
import scipy
import scipy.linalg
import scipy.optimize
import sympy as sp

from autograder.judging import card
from autograder.lesson_checks import known as known_in_lesson
from autograder.problems.material.conventions import FAMILY
from autograder.protocol import calls
from autograder.student import below, cell, lesson, own_arm

ARMS = {own.name: own for own in FAMILY}
SLOW = 1e9  # s: a slow machine must not change a verdict


def judged(task: dict) -> list[str]:
    """The verdict and its card, as text and as HTML. task: id, code, and the name of an arm or ""."""
    id, problem = task["id"], task["id"].partition("-")[0]
    namespace: dict = {"__name__": "__main__", "np": np, "sp": sp, "scipy": scipy}
    with contextlib.redirect_stdout(io.StringIO()):
        exec(task["code"], namespace)
    own_arm._drawn.pop(problem, None)
    if task["arm"]:
        own_arm._drawn[problem] = ARMS[task["arm"]]
    if check := known_in_lesson(id):
        verdict = lesson.verdict_on(check, namespace)
        shown = card.mimebundle(verdict, lesson._below(check, verdict))
    else:
        verdict = cell.verdict_on(id, namespace)
        shown = card.mimebundle(verdict, below.lines(verdict), below.points(verdict))
    own_arm._drawn.pop(problem, None)
    return [repr(verdict), shown["text/plain"], shown["text/html"]]


def patient() -> None:
    """Let no clock decide."""
    calls.CALL_SECONDS, cell.SLOW = 60.0, SLOW
    sys.modules["autograder.judging.check"].SLOW = SLOW


if __name__ == "__main__":
    patient()
    json.dump([judged(task) for task in json.load(sys.stdin)], sys.stdout)
