"""Writes the first cell of a graded notebook: the grader's notes to the student about the notebook."""

import re
from collections.abc import Iterable

from nbformat import NotebookNode
from nbformat.v4 import new_markdown_cell

MARKS = r"([\\`*_{}\[\]<>#+!|~$&])"
HEAD = "**From the grader, about this notebook:**"


def letter(notes: Iterable[str]) -> NotebookNode:
    """A cell that lists the notes."""
    cell = new_markdown_cell("\n".join([HEAD, "", *(f"- {plain(note)}" for note in notes)]))
    del cell["id"]  # a random one
    return cell


def plain(text: str) -> str:
    """Markdown that shows the text as it is: a student may have chosen parts of it."""
    return re.sub(MARKS, r"\\\1", text)


def is_letter(cell: NotebookNode) -> bool:
    return cell.cell_type == "markdown" and cell.source.startswith(HEAD)
