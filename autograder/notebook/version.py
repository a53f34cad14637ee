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


ARM = ""  # among the questions: from what a student's own arm is drawn


def version_of(source: NotebookNode, files: Mapping[str, str]) -> str:
    """The version of a problem by its source. files: the course's own mechanisms, as `check_for` takes
    them."""
    return digest(json.dumps(questions_of(source, files), sort_keys=True))[:8]


def questions_of(source: NotebookNode, files: Mapping[str, str]) -> dict[str, str]:
    """By the id of a graded cell, a short digest of how its function is called; and that of ARM."""
    drawn = set_up(source)
    arm = [drawn.problem, drawn.year, drawn.same_for_all] if drawn else []
    asked = {ARM: digest(json.dumps(arm))[:8]}
    for cell in source.cells:
        claims = cell.metadata.get("nbgrader") or {}
        if claims.get("grade"):
            id = str(claims["grade_id"])
            check = None if claims.get("solution") else check_for(id, None, files)
            asked[id] = digest(check.signature)[:8] if check else ""
    return asked


def stamp(notebook: NotebookNode, problem: str, version: str, questions: Mapping[str, str]) -> None:
    """Write into a notebook of which problem it is, and in which version it is handed out."""
    notebook.metadata[KEY] = {
        "problem": problem,
        "version": version,
        "questions": dict(questions),
    }


def other_version(submission: NotebookNode, source: NotebookNode, files: Mapping[str, str]) -> str:
    """Why a submission cannot be graded by this source; "" where it can, or has no version.

    It can where a question was only added or removed since it was handed out.
    """
    stamped = submission.metadata.get(KEY)
    stamped = stamped if isinstance(stamped, dict) else {}
    given, theirs = stamped.get("version"), stamped.get("questions")
    if not isinstance(given, str):
        return ""
    try:
        now, ours = version_of(source, files), questions_of(source, files)
    except ValueError:  # a broken file of the course's own, of which each check will tell
        return ""
    if given == now:
        return ""
    if isinstance(theirs, dict):
        common = theirs.keys() & ours.keys()
        if ARM in common and len(common) > 1 and all(theirs[id] == ours[id] for id in common):
            return ""
    return (
        f"is of another version of this problem ({one_line(given, 20)}; the course has {now}), whose "
        "questions are others: ask the student to put the answers into the present notebook, or grade "
        "it in the course's folder as it was then"
    )
