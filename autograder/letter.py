"""What the grader tells a student of the notebook as a whole: a cell that is put before all others."""

import re
from collections.abc import Iterable

from nbformat import NotebookNode
from nbformat.v4 import new_markdown_cell

MARKS = r"([\\`*_{}\[\]()<>#+!|~$&])"
HEAD = "**From the grader, about this notebook:**"


def letter(notes: Iterable[str]) -> NotebookNode:
    """A cell that lists the notes; what of them is a student's stays plain text."""
    lines = ["- " + re.sub(MARKS, r"\\\1", note) for note in notes]
    cell = new_markdown_cell("\n".join([HEAD, "", *lines]))
    del cell["id"]  # a random one
    return cell


def is_letter(cell: NotebookNode) -> bool:
    return cell.cell_type == "markdown" and cell.source.startswith(HEAD)
