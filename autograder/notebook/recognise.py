"""Finds the source's graded cells in a notebook: by nbgrader's settings, by id, or by text."""

import copy
from collections import Counter
from dataclasses import dataclass

from nbformat import NotebookNode

from autograder.notebook.form import give_form
from autograder.notebook.released import essence, is_as_released, released


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

    at: grade_id → index. bare: those that have lost nbgrader's settings. copies: grade_id → the indices
    of all its copies, where there are several.
    """

    at: dict[str, int]
    bare: list[str]
    copies: dict[str, list[int]]


def places(notebook: NotebookNode, source: NotebookNode) -> Places:
    """Find the graded cells. If an answer is there several times, the last counts of those that differ
    from what was handed out; of other cells, and where none differs, the last.

    An editor or a converter may drop nbgrader's settings; it leaves the cells' ids, or at least the
    text of those that nobody edits.
    """
    known = known_cells(source)
    all_at = _found(dict(enumerate(notebook.cells)), grade_id, {name: name for name in known}, {})
    bare: dict[str, list[int]] = {}
    for key, names in ((_id, _by_id(known)), (_text, _by_text(known))):
        if len(all_at) + len(bare) < len(known):
            bare |= _found(_without_settings(notebook), key, names, all_at | bare)
    all_at |= bare
    at = {
        name: _that_counts([(index, notebook.cells[index]) for index in indices], known[name])
        for name, indices in all_at.items()
    }
    copies = {name: indices for name, indices in all_at.items() if len(indices) > 1}
    return Places(at, [name for name in known if name in bare], copies)


def is_untouched(cell: NotebookNode, original: NotebookNode) -> bool:
    """Whether an answer is as it was handed out, or empty; original: its cell in the source."""
    return is_as_released(cell, original) and not cell.get("attachments")


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
        is_as_released(notebook.cells[at[name]], known[name]) for name in answers if name in at
    )
    return Likeness(0 < len(known) <= 3 * len(at), untouched < len(answers))


def _that_counts(copies: list[tuple[int, NotebookNode]], original: NotebookNode) -> int:
    answers = []
    if original.metadata["nbgrader"].get("solution"):
        answers = [index for index, cell in copies if not is_untouched(cell, original)]
    return answers[-1] if answers else copies[-1][0]


def _without_settings(notebook) -> dict[int, NotebookNode]:
    """By its index: each cell that has no settings of nbgrader's, or none that name a cell."""
    return {index: cell for index, cell in enumerate(notebook.cells) if not grade_id(cell)}


def _found(cells: dict[int, NotebookNode], key, names: dict, known: dict) -> dict[str, list[int]]:
    """The indices of the cells whose key is in `names`, by name; except for what is known already."""
    taken = {index for indices in known.values() for index in indices}
    found: dict[str, list[int]] = {}
    for index, cell in cells.items():
        name = names.get(key(cell)) if index not in taken else None
        if name and name not in known:
            found.setdefault(name, []).append(index)
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
