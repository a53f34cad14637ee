"""How many of a notebook's points the visible checks have found right, and which are left."""

import json
from dataclasses import dataclass
from pathlib import Path

from autograder.judging.verdict import Verdict

MOST_BYTES = 50 << 20
_credit: dict[str, float] = {}  # by check, as it ran last in this kernel
_graded: dict[Path, dict[str, "Graded"]] = {}  # by folder, as its notebook says


@dataclass(frozen=True)
class Graded:
    """A graded cell: its points, and whether a person reads it."""

    points: float
    by_person: bool


@dataclass(frozen=True)
class Progress:
    """A notebook's points. right: those that checks have found right. total: all of them.

    left, by_person: the rest, by grade_id.
    """

    right: float
    total: float
    left: dict[str, float]
    by_person: dict[str, float]

    def __str__(self):
        said = f"{_number(self.right)} of {_number(self.total)} points checked"
        read = sum(self.by_person.values())
        return f"{said}; a person gives {_number(read)} more." if read else f"{said}."

    @property
    def rest(self) -> list[str]:
        """What is not checked yet and what a person reads, with the points of each."""
        kinds = (("left to check", self.left), ("read by a person", self.by_person))
        return [f"{kind}: {_listed(points)}" for kind, points in kinds if points]


def note(verdict: Verdict) -> None:
    """Take a verdict into account."""
    _credit[verdict.check] = verdict.credit


def of(id: str) -> Progress | None:
    """The points of the notebook that this check is in; None where it cannot be found.

    It is looked for in the folder in which the kernel runs: there JupyterLab starts it.
    """
    graded = _of_notebook_with(id, Path.cwd())
    if not graded:
        return None
    judged = {name: cell.points for name, cell in graded.items() if not cell.by_person}
    right = {name: points * _credit.get(name, 0.0) for name, points in judged.items()}
    left = {name: points - right[name] for name, points in judged.items()}
    return Progress(
        sum(right.values()),
        sum(cell.points for cell in graded.values()),
        {name: points for name, points in left.items() if points > 1e-9},
        {name: cell.points for name, cell in graded.items() if cell.by_person},
    )


def notebook_with(id: str, folder: Path) -> Path | None:
    """The first notebook of a folder that has this check; None where none has it."""
    return next((path for path in sorted(folder.glob("*.ipynb")) if id in read_graded(path)), None)


def _of_notebook_with(id: str, folder: Path) -> dict[str, Graded]:
    """The graded cells of the notebook that has this check; {} where none has it."""
    if id not in _graded.get(folder, {}):
        path = notebook_with(id, folder)
        if path is None:
            return {}
        _graded[folder] = read_graded(path)
    return _graded[folder]


def read_graded(notebook: Path) -> dict[str, Graded]:
    """The graded cells of a notebook in their order, by grade_id; {} if it cannot be read."""
    try:
        if notebook.stat().st_size > MOST_BYTES:
            return {}
        cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
        claims = [cell["metadata"].get("nbgrader", {}) for cell in cells]
        return {
            one["grade_id"]: Graded(float(one["points"]), bool(one["solution"]))
            for one in claims
            if one.get("grade")
        }
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return {}


def _number(points: float) -> str:
    return f"{points:.2f}".rstrip("0").rstrip(".")


def _listed(points: dict[str, float]) -> str:
    return ", ".join(f"{name} ({_number(worth)})" for name, worth in points.items())
