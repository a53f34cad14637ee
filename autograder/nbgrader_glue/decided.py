"""Which answers are still those that a person has marked, when a submission is graded again.

Whatever changed elsewhere (a setting, this code, another cell), the points that a person gave to such an
answer need no second look.
"""

import nbformat
from nbformat import NotebookNode
from nbgrader import utils

from autograder.notebook.letter import is_letter
from autograder.notebook.own_cells import without_pointer
from autograder.notebook.recognise import grade_id


def same_answers(before: bytes, now: NotebookNode) -> set[str]:
    """The graded cells whose answers are what they were in the notebook that was graded before.

    A cell that is no answer itself has those of the whole notebook. Empty where `before` cannot be read.
    """
    try:
        old = _answers(nbformat.reads(before.decode(), as_version=4))
    except Exception:  # whatever lies there in the place of a notebook
        return set()
    new = _answers(now)
    same = {name for name, answer in new.items() if old.get(name) == answer}
    if old != new:
        return same
    return same | {name for cell in now.cells if (name := grade_id(cell))}


def _answers(notebook: NotebookNode) -> dict[str, tuple]:
    """What students write or draw in, by grade_id; and all cells of their own, by none.

    What the grader wrote into a notebook is no part of it. Where it pointed from an empty answer to a
    cell of the student's own, all of these are the answer.
    """
    answers: dict[str, tuple] = {"": ()}
    elsewhere = []
    for cell in notebook.cells:
        if is_letter(cell):
            continue
        text = without_pointer(cell.source)
        content = (cell.cell_type, text.rstrip(), cell.get("attachments", {}))
        name = grade_id(cell)
        if not utils.is_locked(cell) and not name:
            answers[""] += (content,)
        elif name and (utils.is_solution(cell) or utils.is_task(cell)):
            answers[name] = content
            if text != cell.source:
                elsewhere.append(name)
    return answers | {name: (answers[name], answers[""]) for name in elsewhere}
