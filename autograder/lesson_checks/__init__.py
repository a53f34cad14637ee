"""The checks in the lessons: a file a lesson, `lesson_05.py`, with its CHECKS and its GOALS.

A lesson's check is a small task: a `Number` or a `Choice` that a student types into a variable, or a
`Check` of a function, as in the problems. It shows a card, earns no points, and never stops the lesson.
"""

import difflib
import importlib
import re
from functools import cache
from pathlib import Path
from types import ModuleType

from autograder.judging.check import Check
from autograder.lesson_checks.choice import Choice
from autograder.lesson_checks.number import Number
from autograder.problems import UnknownCheckError

LessonCheck = Number | Choice | Check


def numbers() -> list[str]:
    """The lessons that have checks, as "05"."""
    return sorted(path.stem[-2:] for path in Path(__file__).parent.glob("lesson_[0-9][0-9].py"))


def of_lesson(number: str) -> ModuleType:
    """The module with the CHECKS and GOALS of a lesson that has some."""
    return importlib.import_module(f"{__name__}.lesson_{number}")


@cache
def checks_of(number: str) -> dict[str, LessonCheck]:
    """The checks of a lesson by their ids, in its order; {} where it has none."""
    if number not in numbers():
        return {}
    return {check.id: check for check in of_lesson(number).CHECKS}


def known(id: object) -> LessonCheck | None:
    """The lesson's check of this id; None where no lesson with checks has ids like it.

    UnknownCheckError, with those that are nearest, where the lesson has checks and this is none.
    """
    begins = re.match(r"\d\d(?=-)", id) if isinstance(id, str) else None
    checks = checks_of(begins[0]) if begins else {}
    if not checks:
        return None
    if id not in checks:
        names = {own[3:]: own for own in checks}
        close = difflib.get_close_matches(str(id)[3:], names, n=1, cutoff=0.5)
        said = f"did you mean {names[close[0]]!r}?" if close else f"they are {', '.join(checks)}"
        raise UnknownCheckError(f"there is no check {id!r} in this lesson; {said}")
    return checks[str(id)]
