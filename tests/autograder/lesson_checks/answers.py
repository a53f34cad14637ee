"""Answers to the lessons' checks, as students type them in place of the three dots.

A file a lesson, `lesson_05.py`, has the TABLE of its checks: id → Answers. The model answer of a check
is the first right one.
"""

from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path

import nbformat

from autograder import lesson_checks

ROOT = Path(__file__).parents[3]
NUMBERS = lesson_checks.numbers()
DOTS = "..."


@dataclass(frozen=True)
class Answers:
    """What students type, as Python.

    right: of a Choice its letter in quotes. wrong: by the mistake's name, or by the letter of a wrong
    option. other: wrong answers that no mistake explains.
    """

    right: tuple[str, ...]
    wrong: dict[str, str] = field(default_factory=dict)
    other: tuple[str, ...] = ()


def table(number: str) -> dict[str, Answers]:
    """The answers to a lesson's checks."""
    return import_module(f"tests.autograder.lesson_checks.lesson_{number}").TABLE


def path_of(number: str) -> Path:
    (path,) = (ROOT / "lessons").glob(f"{number}-*.ipynb")
    return path


def lesson(number: str):
    return nbformat.read(path_of(number), as_version=4)


def cell_of(notebook, id: str):
    """The cell of a check: it has the check's id."""
    (cell,) = (cell for cell in notebook.cells if cell.id == id)
    return cell


def filled(source: str, typed: str) -> str:
    """A check's cell with an answer in place of its dots."""
    assert source.count(DOTS) == 1
    return source.replace(DOTS, typed)
