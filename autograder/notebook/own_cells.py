"""An answer for a person to read, written beside the cell that was meant for it.

nbgrader gives an untouched answer 0 unread. So it gets a sentence that says where the answer is: then
it is not untouched, and who grades it finds what to read.
"""

from collections.abc import Sequence

from nbformat import NotebookNode

from autograder.notebook.letter import is_letter, plain
from autograder.notebook.recognise import grade_id
from autograder.notebook.released import essence, released
from autograder.protocol import one_line

POINTER = "(From the grader: this cell holds no answer; it may be in the student's own {where}.)"


def point_to_own_cells(
    notebook: NotebookNode, source: NotebookNode, documents: Sequence[str] = ()
) -> list[str]:
    """Put the sentence into each empty answer that has something of the student's beside it; notes.

    That is text or a picture in cells directly above, or below, before the next graded cell; or else
    documents, which were handed in beside the notebook.
    """
    given = {essence(text) for cell in source.cells for text in (cell.source, released(cell))}
    untouched = {
        grade_id(cell): {essence(released(cell)), ""} for cell in source.cells if _is_read(cell)
    }
    notes = []
    for index, cell in enumerate(notebook.cells):
        name = grade_id(cell)
        if name not in untouched or essence(cell.source) not in untouched[name]:
            continue
        above = _run_of(reversed(notebook.cells[:index]), lambda other: _is_own(other, given))
        below = _run_of(notebook.cells[index + 1 :], lambda other: not grade_id(other))
        own = {
            "cell above": any(_is_own(other, given) for other in above),
            "cell below": any(_is_own(other, given) for other in below),
            "picture, attached to it": bool(cell.get("attachments")),
            f"file {one_line(next(iter(documents), ''), 100)}": bool(documents),
        }
        where = next((where for where, there in own.items() if there), None)
        if where:
            text = POINTER.format(where=where)
            text = f"# {text}" if cell.cell_type == "code" else f"*{plain(text)}*"
            cell.source = "\n\n".join(filter(None, [cell.source.rstrip(), text]))
            notes.append(f"{name} holds no answer; it may be in the student's own {where}")
    return notes


def _is_read(cell) -> bool:
    """Whether a person grades what a student writes there."""
    claims = cell.metadata.get("nbgrader", {})
    return bool(claims.get("grade") and claims.get("solution"))


def _run_of(cells, belongs) -> list:
    """The first cells, up to one that does not belong."""
    run = []
    for cell in cells:
        if not belongs(cell):
            break
        run.append(cell)
    return run


def _is_own(cell, given) -> bool:
    """Whether it holds something, and that is not the source's."""
    if grade_id(cell) or is_letter(cell):
        return False
    return bool(cell.get("attachments")) or (
        bool(cell.source.strip()) and essence(cell.source) not in given
    )
