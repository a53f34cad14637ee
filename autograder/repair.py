"""Puts a submitted notebook's graded cells right, from the source version, before it is judged.

Students copy, delete, rename and retype cells, by accident or not. nbgrader trusts the cells'
metadata as submitted; here it is rebuilt from the source, and every change is reported.
"""

import copy
import json
import re
from itertools import count

from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_markdown_cell, new_raw_cell

from autograder.wall import one_line

NEW_CELL = {"code": new_code_cell, "markdown": new_markdown_cell, "raw": new_raw_cell}
MOST_NOTES = 50


def repair(submission: NotebookNode, source: NotebookNode) -> tuple[NotebookNode, list[str]]:
    """The submission with each graded cell of `source` in it exactly once, and what was mended.

    A locked cell gets the source's text again. An editable cell keeps the student's text; where it
    was deleted, an empty one is put in. Of several copies the last one counts, as it does when the
    notebook is run; the others stay as ordinary cells. Cells that only claim to be graded stay too,
    without the claim.
    """
    notebook, notes = copy.deepcopy(submission), []
    for cell in notebook.cells:
        cell.pop("outputs", None)  # made anew
    clean = without_surrogates(notebook)
    if clean is not notebook:
        notes.append("characters that no text can hold were replaced by \ufffd")
        notebook = clean
    _give_form(notebook, source, notes)
    known = {grade_id(cell): cell for cell in source.cells if grade_id(cell)}
    at = _last_places(notebook, known, notes)
    for index, cell in enumerate(notebook.cells):
        claimed = grade_id(cell)
        if "nbgrader" in cell.metadata and (claimed is None or at.get(claimed) != index):
            del cell.metadata["nbgrader"]
            if claimed and claimed not in known:
                notes.append(
                    f"a cell that claims to be {one_line(claimed, 60)}, which the source does not have"
                )
    placed = {name: notebook.cells[index] for name, index in at.items()}
    for name, original in known.items():
        if name in placed:
            _put_right(placed[name], original, notes)
    _put_back(notebook, known, placed, notes)
    _tell_apart(notebook)
    if len(notes) > MOST_NOTES:
        notes = [*notes[:MOST_NOTES], f"and {len(notes) - MOST_NOTES} more such notes"]
    return notebook, notes


def without_surrogates(value):
    """The same JSON value, in it \ufffd for each half of a surrogate pair: JSON can write one, no file.

    Where there is none, `value` itself.
    """
    try:
        json.dumps(value, ensure_ascii=False).encode()
    except UnicodeEncodeError:
        return _replaced(value)
    return value


def _replaced(value):
    if isinstance(value, str):
        return re.sub("[\ud800-\udfff]", "\ufffd", value)
    if isinstance(value, dict):
        return type(value)({_replaced(key): _replaced(part) for key, part in value.items()})
    if isinstance(value, list):
        return [_replaced(part) for part in value]
    return value


# What nbformat has rules for; a cell's settings that break them would stop its student's grading.
RULED = ("collapsed", "deletable", "editable", "execution", "format", "jupyter", "name")
RULED += ("scrolled", "source_hidden", "tags", "title")
PARTS = ("cell_type", "id", "metadata", "source")
PARTS_OF = {"code": ("outputs", "execution_count"), "markdown": ("attachments",)}
PARTS_OF["raw"] = PARTS_OF["markdown"]


def _give_form(notebook, source, notes) -> None:
    """Make it a valid notebook, of the source's settings, without outputs: they are made anew."""
    notebook.metadata = copy.deepcopy(source.metadata)
    for index, cell in enumerate(notebook.cells):
        kind = cell.get("cell_type")
        whole = kind in NEW_CELL and isinstance(cell.get("source"), str)
        if not (whole and isinstance(cell.get("metadata"), dict)):
            notes.append(f"cell {index + 1} was no whole cell")
            cell.cell_type = kind = kind if kind in NEW_CELL else "raw"
            cell.source = cell.source if isinstance(cell.get("source"), str) else ""
            cell.metadata = NotebookNode()
        for part in set(cell) - {*PARTS, *PARTS_OF[kind]}:
            del cell[part]
        for setting in RULED:
            cell.metadata.pop(setting, None)
        if kind == "code":
            cell.outputs, cell.execution_count = [], None
        elif "attachments" in cell and not _are_attachments(cell.attachments):
            del cell["attachments"]


def _are_attachments(files) -> bool:
    return isinstance(files, dict) and all(
        isinstance(bundle, dict) and all(isinstance(data, str) for data in bundle.values())
        for bundle in files.values()
    )


def grade_id(cell: NotebookNode) -> str | None:
    """The cell's grade_id, or None where it has none that can be one."""
    claims = cell.metadata.get("nbgrader")
    name = claims.get("grade_id") if isinstance(claims, dict) else None
    return name if isinstance(name, str) else None


def is_locked(cell: NotebookNode) -> bool:
    """Whether the source's text counts in this cell, not the student's."""
    claims = cell.metadata["nbgrader"]
    return not claims.get("solution") and bool(claims.get("grade") or claims.get("locked"))


def _last_places(notebook, known, notes) -> dict[str, int]:
    at: dict[str, int] = {}
    for index, cell in enumerate(notebook.cells):
        name = grade_id(cell)
        if name in known:
            if name in at:
                notes.append(f"{name} was there more than once; the last one counts")
            at[name] = index
    return at


def _put_right(cell, original, notes) -> None:
    name = grade_id(original)
    if cell.cell_type != original.cell_type:
        notes.append(f"{name} had been made a {cell.cell_type} cell")
        cell.cell_type = original.cell_type
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = [], None
            cell.pop("attachments", None)
        else:
            cell.pop("outputs", None)
            cell.pop("execution_count", None)
    checksum = cell.metadata["nbgrader"].get("checksum")
    claims = {
        k: v for k, v in cell.metadata["nbgrader"].items() if k not in ("checksum", "cell_type")
    }
    wanted = dict(original.metadata["nbgrader"])
    if any(claims.get(key) != value for key, value in wanted.items()):
        notes.append(f"the nbgrader settings of {name} had been changed")
    cell.metadata["nbgrader"] = NotebookNode(
        wanted | ({"checksum": checksum} if isinstance(checksum, str) else {})
    )
    if is_locked(original):
        cell.source = original.source


def _put_back(notebook, known, placed, notes) -> None:
    """Each missing cell goes behind the graded cell that precedes it in the source."""
    before = None
    for name, original in known.items():
        if name not in placed:
            notes.append(f"{name} was missing; it was put back")
            text = original.source if is_locked(original) else ""
            cell = NEW_CELL[original.cell_type](source=text)
            cell.metadata = copy.deepcopy(original.metadata)
            del cell["id"]  # a random one
            position = 0 if before is None else _index(notebook.cells, before) + 1
            notebook.cells.insert(position, cell)
            placed[name] = cell
        before = placed[name]


def _tell_apart(notebook) -> None:
    """Each cell an id of its own, as nbformat 4.5 asks for: a copied cell has that of the first."""
    if notebook.nbformat_minor < 5:
        return
    ids = {cell["id"] for cell in notebook.cells if isinstance(cell.get("id"), str)}
    new = (name for number in count() if (name := f"cell-{number}") not in ids)
    taken = set()
    for cell in notebook.cells:
        name = cell.get("id")
        whole = isinstance(name, str) and re.fullmatch("[A-Za-z0-9_-]{1,64}", name)
        if not whole or name in taken:
            cell.id = name = next(new)
        taken.add(name)


def _index(cells, wanted) -> int:
    return next(index for index, cell in enumerate(cells) if cell is wanted)
