"""Whole classes: a course with one released assignment, and as many submissions as wanted."""

import json
import shutil
from itertools import cycle
from pathlib import Path

import nbformat
from nbformat import NotebookNode

from tests.autograder.courses import ROOT, SEED, run
from tests.submissions.answers import blank

# Of five students four are these, where a module has them; one hands in the release.
MIX = ("right", "partly_right", "wrong", "right")


def new_course(root: Path, assignment: str, source: Path | NotebookNode) -> Path:
    """A course in the folder `root`, which is made, with the assignment released.

    source: the assignment's folder, or its source notebook.
    """
    folder = root / "solutions" / assignment
    if isinstance(source, Path):
        shutil.copytree(source, folder)
    else:
        folder.mkdir(parents=True)
        nbformat.write(source, folder / f"{assignment}.ipynb")
    for path in folder.glob("*.ipynb"):  # what is right for one is right for all
        text = path.read_text(encoding="utf-8")
        path.write_text(text.replace("year=2026)", "same_for_all=True)"), encoding="utf-8")
    shutil.copy(ROOT / "nbgrader_config.py", root)
    run(root, "nbgrader", "generate_assignment", assignment)
    (root / "course" / "seed").write_text(SEED)
    return root


def hand_in(root: Path, assignment: str, submissions, count: int) -> None:
    """`count` submissions of the module's kinds; each student's code has a line of its own."""
    path = root / "course" / "release" / assignment / f"{assignment}.ipynb"
    release = nbformat.read(path, as_version=4)
    kinds = [getattr(submissions, name) for name in MIX if hasattr(submissions, name)]
    made = [kind(release) for kind in (*kinds, blank)]
    for number, notebook in zip(range(count), cycle(made), strict=False):
        answers = [cell for cell in notebook.cells if _is_answer(cell)]
        kept = answers[0].source
        answers[0].source = f"{kept}\n# handed in by student {number}"
        folder = root / "course" / "submitted" / f"student{number:04}" / assignment
        folder.mkdir(parents=True)
        (folder / f"{assignment}.ipynb").write_text(json.dumps(notebook), encoding="utf-8")
        answers[0].source = kept


def _is_answer(cell: NotebookNode) -> bool:
    return cell.cell_type == "code" and bool(cell.metadata.get("nbgrader", {}).get("solution"))
