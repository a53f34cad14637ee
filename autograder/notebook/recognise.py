"""Finds the source's graded cells in a notebook: by nbgrader's settings, by id, or by text."""

import copy
from collections import Counter
from dataclasses import dataclass

from nbformat import NotebookNode

from autograder.notebook.form import give_form
from autograder.notebook.released import essence, released


def grade_id(cell: NotebookNode) -> str | None:
    """The cell's grade_id, or None where it has none that can be one."""
    claims = cell.metadata.get("nbgrader")
    name = claims.get("grade_id") if isinstance(claims, dict) else None
    return name if isinstance(name, str) else None


def known_cells(source: NotebookNode) -> dict[str, NotebookNode]:
    """The source's cells that have a grade_id, by it, in order."""
    return {name: cell for cell in source.cells if (name := grade_id(cell))}


@dataclass(frozen=True)
class Places:
    """Where the source's graded cells are in a notebook.

    at: grade_id → index. bare: those that have lost nbgrader's settings. doubled: a grade_id for each
    further copy.
    """

    at: dict[str, int]
    bare: list[str]
    doubled: list[str]


def places(notebook: NotebookNode, source: NotebookNode) -> Places:
    """Find the graded cells; if several have one grade_id, the last counts.

    An editor or a converter may drop nbgrader's settings; it leaves the cells' ids, or at least the
    text of those that nobody edits.
    """
    known = known_cells(source)
    at: dict[str, int] = {}
    doubled = []
    for index, cell in enumerate(notebook.cells):
        name = grade_id(cell)
        if name in known:
            if name in at:
                doubled.append(name)
            at[name] = index
    bare: dict[str, int] = {}
    for key, names in ((_id, _by_id(known)), (_text, _by_text(known))):
        if len(at) + len(bare) < len(known):
            bare |= _found(notebook, key, names, at | bare)
    return Places(at | bare, [name for name in known if name in bare], doubled)


@dataclass(frozen=True)
class Likeness:
    """Whether a notebook is one of the source's, and whether anything was answered in it."""

    known: bool
    answered: bool


def likeness(notebook: NotebookNode, source: NotebookNode) -> Likeness:
    """A third of the graded cells is enough to know a notebook: many people delete some."""
    notebook = copy.deepcopy(notebook)
    give_form(notebook, source, [])
    known, at = known_cells(source), places(notebook, source).at
    answers = [name for name, cell in known.items() if cell.metadata["nbgrader"].get("solution")]
    untouched = sum(
        essence(notebook.cells[at[name]].source) in ("", essence(released(known[name])))
        for name in answers
        if name in at
    )
    return Likeness(0 < len(known) <= 3 * len(at), untouched < len(answers))


def _found(notebook, key, names: dict, at: dict[str, int]) -> dict[str, int]:
    """The cells without settings whose key is in `names`, except for the names in `at`."""
    taken, found = set(at.values()), {}
    for index, cell in enumerate(notebook.cells):
        if "nbgrader" not in cell.metadata and index not in taken:
            name = names.get(key(cell))
            if name and name not in at:
                found[name] = index
    return found


def _id(cell):
    name = cell.get("id") or cell.metadata.get("id")  # Google's Colab keeps it among the settings
    return name if isinstance(name, str) else None


def _by_id(known) -> dict:
    return {cell["id"]: name for name, cell in known.items() if "id" in cell}


def _text(cell):
    return cell.cell_type, essence(cell.source)


def _by_text(known) -> dict:
    """The texts that only one cell has."""
    texts = {name: (cell.cell_type, essence(released(cell))) for name, cell in known.items()}
    times = Counter(texts.values())
    return {text: name for name, text in texts.items() if times[text] == 1}
