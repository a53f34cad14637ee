"""What is handed in: the released notebook with its first answers, right or wrong, or no notebook."""

import copy
import json
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path

import nbformat
from nbformat import NotebookNode

from tests.rehearsal.mistakes import Mistake

DAMAGED = ("", "{", "%PDF-1.7 a scan", '{"cells": [], "metadata": {}', "null", "[1, 2]")


@dataclass
class Problem:
    """A problem as its source says it: what is asked, for how many points."""

    name: str
    source: NotebookNode
    release: NotebookNode
    tests: list[str] = field(init=False)
    points: dict[str, float] = field(init=False)
    proof: str = field(init=False)

    def __post_init__(self):
        graded = [about for about in map(_about, self.source.cells) if about.get("grade")]
        self.points = {about["grade_id"]: float(about["points"]) for about in graded}
        self.tests = [about["grade_id"] for about in graded if not about["solution"]]
        (self.proof,) = (about["grade_id"] for about in graded if about["solution"])

    def notebook(
        self, answered: int, proof: str = "", note: str = "", wrong: Mistake | None = None
    ) -> str:
        """The first `answered` answers are right but for what is wrong, as later ones may call them.
        note: a student's own.
        """
        notebook = copy.deepcopy(self.release)
        asked = [name.split("-", 1)[1] for name in self.tests[:answered]]
        right = import_module(f"tests.submissions.{self.name.replace('-', '_')}").RIGHT
        answers = right | (wrong.answers if wrong else {})
        for cell in notebook.cells:
            id = _about(cell).get("grade_id", "")
            if id.removeprefix("answer-") in asked and id.startswith("answer-"):
                cell.source = answers[id.removeprefix("answer-")].strip("\n")
                cell.source += f"\n# {note}" if note else ""
            elif id == self.proof and proof:
                cell.source = proof
        return json.dumps(notebook)


def problem(root: Path, name: str) -> Problem:
    """The problem as it is now in solutions/ and course/release/ of a course."""
    source, release = (
        nbformat.read(root / folder / name / f"{name}.ipynb", as_version=4)
        for folder in ("solutions", "course/release")
    )
    return Problem(name, source, release)


def hand_in(root: Path, student: str, name: str, text: str, time: str) -> Path:
    """Put it where nbgrader's collect does. time: as nbgrader writes it, in UTC."""
    folder = root / "course" / "submitted" / student / name
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.ipynb").write_text(text, encoding="utf-8")
    (folder / "timestamp.txt").write_text(time, encoding="utf-8")
    return folder


def _about(cell: NotebookNode) -> dict:
    return cell.metadata.get("nbgrader", {})
