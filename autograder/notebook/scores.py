"""Writes verdicts as outputs from which nbgrader reads the scores.

nbgrader reads a score from a grade cell's outputs: an error is zero, a result that is one number is
that many points, and almost anything else is full marks. So a verdict is written as the card and one
number; if the check failed, it is written as the card and an error.
"""

from nbformat import NotebookNode

from autograder.judging.verdict import State, Verdict
from autograder.notebook import outputs
from autograder.notebook.form import without_surrogates
from autograder.notebook.grade import Graded, is_judged
from autograder.notebook.recognise import grade_id
from autograder.notebook.suggestion import suggest

CHECK_FAILED = "CheckFailed"


def could_not_be_judged(cell: NotebookNode) -> bool:
    """Whether a judged cell's check failed, so that it has no score of its own."""
    return any(one.get("ename") == CHECK_FAILED for one in cell.get("outputs", []))


def with_verdicts(graded: Graded) -> NotebookNode:
    """The judged notebook, with outputs of its grade cells from which nbgrader reads the scores, and
    what its derivations suggest to the person who reads the rest.
    """
    for cell in graded.notebook.cells:
        suggest(cell, graded.marks.get(grade_id(cell) or "", []))
        if is_judged(cell):
            points = cell.metadata["nbgrader"]["points"]
            cell.execution_count = 1
            # Whatever stands behind the score, nbgrader does not read.
            cell.outputs = [
                *outputs_for(graded.verdicts[grade_id(cell) or ""], points),
                *cell.outputs,
            ]
        if "outputs" in cell:
            cell.outputs = without_surrogates(cell.outputs)  # else no file can hold them
    return graded.notebook


def outputs_for(verdict: Verdict, points: float) -> list[NotebookNode]:
    """The outputs from which nbgrader reads the verdict's score and people read the verdict."""
    shown = outputs.of_verdict(verdict)
    if verdict.state is State.CHECK_FAILED:
        text = "this cell could not be judged and has no score yet"
        error = outputs.error(CHECK_FAILED, text, [text])
        return [shown, error]
    credit = min(max(0.0, float(verdict.credit)), 1.0)  # in this order NaN is 0 as well
    score = repr(credit * float(points))
    return [shown, outputs.result(score)]
