"""Whether a notebook is of the version of its problem that a student's package has the checks of."""

import json
import os
from functools import cache
from pathlib import Path

from autograder.problems import check_for
from autograder.student.progress import notebook_with

# Beside the lessons and problems that a student's package brings; `autograder bundle` writes it.
VERSIONS = Path(__file__).parents[1] / "handed_out" / "armdyn.json"
OLDER = (
    "This notebook is of an older version of {problem} than your course package, and asks other "
    "questions. Put your answers into the present notebook, which is in problems/{problem}/ of the "
    "course's newest archive; on a class server, rename the folder of this one and fetch the problem "
    "again."
)
UNKNOWN = (
    "This notebook is of a version of {problem} that your course package does not have: a newer one, or "
    "another course's. So the checks may ask for something else than the notebook. Get the course's "
    "newest archive and start it; on a class server, tell your instructor."
)


def remark(id: str) -> str:
    """What a student should know of the versions before this check; "" where all is well.

    It is said once of a notebook in a kernel. Where the package has no list of versions, as an
    instructor's, or the notebook is not found or not stamped, nothing is said.
    """
    held = _versions()
    notebook = _open_one() or notebook_with(id, Path.cwd())
    if not held or notebook is None or notebook in _told:
        return ""
    problem, version = _stamp(notebook)
    if not problem or held["versions"].get(problem) == version:
        return ""
    if problem not in held["versions"] and check_for(id):
        return ""  # another notebook of an assignment
    _told.add(notebook)
    older = version in held["earlier"].get(problem, ())
    return (OLDER if older else UNKNOWN).format(problem=problem)


_told: set[Path] = set()


@cache
def _versions() -> dict:
    if not VERSIONS.is_file():
        return {}
    return json.loads(VERSIONS.read_text(encoding="utf-8"))


def _open_one() -> Path | None:
    """The notebook that this kernel runs, where Jupyter says it."""
    said = Path(os.environ.get("JPY_SESSION_NAME", ""))
    return said if said.suffix == ".ipynb" and said.is_file() else None


def _stamp(notebook: Path) -> tuple[str, str]:
    """Which problem a notebook is, in which version; "" for each where it does not say."""
    try:
        found = json.loads(notebook.read_text(encoding="utf-8"))["metadata"]["armdyn"]
        return str(found["problem"]), str(found["version"])
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return "", ""
