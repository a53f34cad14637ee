"""Writes a problem whose checks are the course's own: checks/NAME.py, and from it the notebook."""

from pathlib import Path
from string import ascii_uppercase

import nbformat
from nbformat.v4 import new_code_cell, new_markdown_cell

from autograder.authoring.checks_template import of_a_problem, of_the_kit
from autograder.authoring.course import is_as_written, own_file
from autograder.authoring.problem import ProblemError, as_notebook, cell_of
from autograder.files import put_in_place
from autograder.judging.check import Check
from autograder.notebook.recognise import grade_id
from autograder.problems import CHECKS, own_checks
from autograder.problems.own_checks import OwnChecksError

__all__ = ["OwnChecksError", "checks_file", "write_checks", "write_own_problem"]

POINTS = 3  # of each check, to be changed


def checks_file(root: Path, name: str) -> Path:
    """Where the checks of this problem are, or shall be."""
    return root / own_checks.FOLDER / f"{name}.py"


def write_checks(root: Path, name: str) -> Path:
    """Write the file of a problem's own checks, to be filled in. ProblemError where it is there, or
    where a mechanism's file is to give the checks. One that nobody has filled in goes.
    """
    path = checks_file(root, name)
    if path.exists():
        raise ProblemError(f"{path.relative_to(root).as_posix()} is there already")
    source, mechanism = _source(root, name), own_file(root, name)
    if source is None and mechanism.is_file():
        if not is_as_written(mechanism, name):
            shown = mechanism.relative_to(root).as_posix()
            raise ProblemError(
                f"{shown} is a mechanism, and gives the checks: `autograder new-problem {name}` writes "
                "its problem. For checks without a mechanism, move that file away first"
            )
        mechanism.unlink()
    known = {id: CHECKS[id].signature for id in _ids(source) if id in CHECKS} if source else {}
    path.parent.mkdir(mode=0o700, exist_ok=True)  # it holds answers
    put_in_place(path, of_the_kit(name, known) if known else of_a_problem(name), 0o600)
    return path


def write_own_problem(root: Path, name: str) -> Path:
    """Write the notebook of a problem from its checks. OwnChecksError where their file is broken,
    ProblemError where it has none, or where the notebook is there.
    """
    shown = checks_file(root, name).relative_to(root).as_posix()
    text = checks_file(root, name).read_text(encoding="utf-8", errors="replace")
    checks = list(own_checks.read(text, shown).checks.values())
    path = root / "solutions" / name / f"{name}.ipynb"
    if not checks:
        raise ProblemError(f"{shown} has no CHECKS to write a problem of")
    if path.exists():
        raise ProblemError(
            f"{path.relative_to(root).as_posix()} is there already; for a check that it lacks, copy an "
            "answer and the cell below it, and change their grade_ids"
        )
    path.parent.mkdir(parents=True, exist_ok=True)
    put_in_place(path, nbformat.writes(_notebook(name, checks)) + "\n")
    return path


def _notebook(name: str, checks: list[Check]) -> nbformat.NotebookNode:
    """The problem in nbgrader's source form; its texts and model answers are left to the lecturer."""
    said = f"# Problem: {name.replace('-', ' ')}\n\nThe story. {POINTS * len(checks)} points."
    setup = """\
from types import SimpleNamespace

import numpy as np

from autograder import check, hint"""
    cells = [
        new_markdown_cell(said, id=f"{name}-title"),
        new_code_cell(setup, id=f"{name}-setup", metadata=cell_of(f"{name}-setup", locked=True)),
    ]
    for letter, check in zip(ascii_uppercase, checks, strict=False):
        asked = "; ".join(
            f"{criterion.text}, {criterion.unit}" if criterion.unit else criterion.text
            for criterion in check.criteria
        )
        head = f"## {letter}. `{check.signature}` ({POINTS} points)"
        task = f"{head}\n\nWrite `{check.signature}`: {asked}."
        if check.hints:
            task += f'\n\n`hint("{check.id}")` gives a hint; the next call gives a stronger one.'
        answer = (
            f"def {check.signature}:\n    ### BEGIN SOLUTION\n"
            "    raise NotImplementedError  # your model answer\n    ### END SOLUTION"
        )
        grading = (
            f'# Checks {check.signature} with random numbers.\ncheck("{check.id}")\n'
            f'### BEGIN HIDDEN TESTS\ncheck("{check.id}", fresh=True)\n### END HIDDEN TESTS'
        )
        own = f"answer-{check.id}"
        cells += [
            new_markdown_cell(task, id=f"{check.id}-task"),
            new_code_cell(answer, id=f"{check.id}-answer", metadata=cell_of(own, solution=True)),
            new_code_cell(
                grading,
                id=f"{check.id}-check",
                metadata=cell_of(check.id, locked=True, grade=True, points=POINTS),
            ),
        ]
    return as_notebook(cells)


def _source(root: Path, name: str) -> nbformat.NotebookNode | None:
    path = root / "solutions" / name / f"{name}.ipynb"
    return nbformat.read(path, as_version=4) if path.is_file() else None


def _ids(source: nbformat.NotebookNode) -> list[str]:
    return [id for id in map(grade_id, source.cells) if id]
