"""Points from an empty answer to the student's own cells beside it, for the person who grades it.

nbgrader gives an untouched answer 0 points, and nobody reads it. So the cell gets a sentence that says
where the answer may be: then the cell is no longer untouched, and the person finds what to read.
"""

import re
from collections.abc import Sequence

from nbformat import NotebookNode

from autograder.notebook.editions import Edition, texts_of
from autograder.notebook.letter import is_letter, plain
from autograder.notebook.recognise import grade_id
from autograder.notebook.released import essence, released
from autograder.protocol import one_line

POINTER = "(From the grader: this cell has no answer; it may be in the student's own {where}.)"

POINTS = re.compile(r"[#*]? ?\\?\(From the grader: this cell has no answer;.*\)\*?\s*$")


def without_pointer(text: str) -> str:
    """An answer's text without the sentence, if it has one."""
    return POINTS.sub("", text)


def point_to_own_cells(
    notebook: NotebookNode,
    source: NotebookNode,
    documents: Sequence[str] = (),
    editions: Sequence[Edition] = (),
    put_back: Sequence[NotebookNode] = (),
) -> list[str]:
    """Put the sentence into each empty answer with something of the student's beside it; give notes.

    That is text or a picture in the cells directly above, or in those below up to the next graded cell;
    or else one of the documents, which were handed in beside the notebook. No text that one of the
    editions had is a student's own. put_back: the cells that the student had deleted, which part nothing
    from its answer.
    """
    deleted = set(map(id, put_back))
    given = {essence(text) for cell in source.cells for text in (cell.source, released(cell))}
    given |= texts_of(editions)
    untouched = {
        grade_id(cell): {essence(released(cell)), ""} for cell in source.cells if _is_read(cell)
    }
    notes = []
    for index, cell in enumerate(notebook.cells):
        name = grade_id(cell)
        if name not in untouched or essence(cell.source) not in untouched[name]:
            continue
        above, below = (
            [other for other in cells if id(other) not in deleted]
            for cells in (reversed(notebook.cells[:index]), notebook.cells[index + 1 :])
        )
        above = _run_of(above, lambda other: _is_own(other, given))
        below = _run_of(below, lambda other: not grade_id(other))
        own = {
            "cell above": any(_is_own(other, given) for other in above),
            "cell below": any(_is_own(other, given) for other in below),
            "picture in this cell": bool(cell.get("attachments")),
            f"file {one_line(next(iter(documents), ''), 100)}": bool(documents),
        }
        where = next((where for where, there in own.items() if there), None)
        if where:
            text = POINTER.format(where=where)
            text = f"# {text}" if cell.cell_type == "code" else f"*{plain(text)}*"
            cell.source = "\n\n".join(filter(None, [cell.source.rstrip(), text]))
            notes.append(f"{name} has no answer; it may be in the student's own {where}")
    return notes


def _is_read(cell) -> bool:
    """Whether a person grades what a student writes there."""
    claims = cell.metadata.get("nbgrader", {})
    return bool(claims.get("grade") and claims.get("solution"))


def _run_of(cells, belongs) -> list:
    """The first cells, up to one that does not belong to them."""
    run = []
    for cell in cells:
        if not belongs(cell):
            break
        run.append(cell)
    return run


def _is_own(cell, given) -> bool:
    """Whether the cell holds something that is not from the source."""
    if grade_id(cell) or is_letter(cell):
        return False
    return bool(cell.get("attachments")) or (
        bool(cell.source.strip()) and essence(cell.source) not in given
    )
