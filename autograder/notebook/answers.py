"""The answers in a notebook, by the check that judges them: a student's, or the source's."""

import re
from collections.abc import Iterable

from nbformat import NotebookNode

from autograder.notebook.grade import is_judged
from autograder.notebook.recognise import grade_id
from autograder.problems import check_here
from autograder.proofs import derivation_of

MARK = re.compile(r"[ \t]*### (BEGIN|END) SOLUTION[ \t]*(\n|$)")


def answers_to(checks: Iterable[str], cells: list[NotebookNode]) -> dict[str, str]:
    """The source of the last code cell that defines each check's function, by check."""
    sources = [cell.source for cell in cells if cell.cell_type == "code"]
    found = {}
    for check in checks:
        known = check_here(check)
        name = re.escape(known.name if known else check.rpartition("-")[2])
        defines = re.compile(rf"^(def\s+{name}\s*\(|{name}\s*=[^=])", re.MULTILINE)
        defining = [source for source in sources if defines.search(source)]
        if defining:
            found[check] = defining[-1]
    return found


def model_answers(source: NotebookNode) -> dict[str, str]:
    """The answers of a source notebook, by the grade_id of the cell that has their points; the lines of
    a derivation, by its id.

    An answer that a person reads is Markdown; every other is code.
    """
    judged = [grade_id(cell) or "" for cell in source.cells if is_judged(cell)]
    found = answers_to(judged, source.cells)
    for cell in source.cells:
        claims = cell.metadata.get("nbgrader") or {}
        if claims.get("grade") and claims.get("solution"):
            found[grade_id(cell) or ""] = cell.source
        answer, _, derived = (grade_id(cell) or "").partition("-")
        if answer == "answer" and derivation_of(derived):
            found[derived] = cell.source
    return {id: MARK.sub("", text).strip("\n") for id, text in found.items()}
