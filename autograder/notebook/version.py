"""Which version of a problem a notebook was handed out in, and whether the course still has it.

The version is that of the questions: which cells are graded, how their functions are called, and from
what a student's own arm is drawn. A check that is put right, other points or another text do not change
it, so that what was handed in can be graded again.
"""

import json
from collections.abc import Mapping

from nbformat import NotebookNode

from autograder.digest import digest
from autograder.notebook.own_arm import set_up
from autograder.problems import check_for
from autograder.protocol import one_line

KEY = "armdyn"  # in a notebook's metadata


def version_of(source: NotebookNode, files: Mapping[str, str]) -> str:
    """The version of a problem by its source. files: the course's own mechanisms, as `check_for` takes
    them."""
    asked = {}
    for cell in source.cells:
        claims = cell.metadata.get("nbgrader") or {}
        if claims.get("grade"):
            id = str(claims["grade_id"])
            check = None if claims.get("solution") else check_for(id, None, files)
            asked[id] = check.signature if check else ""
    drawn = set_up(source)
    arm = [drawn.problem, drawn.year, drawn.same_for_all] if drawn else []
    return digest(json.dumps([asked, arm], sort_keys=True))[:8]


def stamp(notebook: NotebookNode, version: str, problem: str) -> None:
    """Write into a notebook of which problem it is, and in which version it is handed out."""
    notebook.metadata[KEY] = {"problem": problem, "version": version}


def other_version(submission: NotebookNode, source: NotebookNode, files: Mapping[str, str]) -> str:
    """Why a submission cannot be graded by this source; "" where it can, or has no version."""
    stamped = submission.metadata.get(KEY)
    given = stamped.get("version") if isinstance(stamped, dict) else None
    if not isinstance(given, str) or given == (now := version_of(source, files)):
        return ""
    return (
        f"is of another version of this problem ({one_line(given, 20)}; the course has {now}), whose "
        "questions are others: ask the student to put the answers into the present notebook, or grade "
        "it in the course's folder as it was then"
    )
