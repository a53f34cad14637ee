"""Makes any notebook valid for nbformat: complete cells, text that a file can hold, unique ids."""

import copy
import json
import re
from itertools import count

from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_markdown_cell, new_raw_cell

NEW_CELL = {"code": new_code_cell, "markdown": new_markdown_cell, "raw": new_raw_cell}


def without_surrogates(value):
    """The same JSON value, with \ufffd for each half of a surrogate pair, which no file can hold.

    If there is none, `value` itself.
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


# nbformat has rules for these settings; a cell that breaks one would stop the grading.
RULED = (
    *("collapsed", "deletable", "editable", "execution", "format", "jupyter", "name"),
    *("scrolled", "source_hidden", "tags", "title"),
)
PARTS = ("cell_type", "id", "metadata", "source")
PARTS_OF: dict[str, tuple[str, ...]] = {
    "code": ("outputs", "execution_count"),
    "markdown": ("attachments",),
}
PARTS_OF["raw"] = PARTS_OF["markdown"]


def give_form(notebook, source, notes) -> None:
    """Make it a valid notebook with the source's settings and without outputs, which grading makes."""
    notebook.metadata = copy.deepcopy(source.metadata)
    for index, cell in enumerate(notebook.cells):
        kind = cell.get("cell_type")
        whole = kind in NEW_CELL and isinstance(cell.get("source"), str)
        if not (whole and isinstance(cell.get("metadata"), dict)):
            notes.append(f"cell {index + 1} was damaged: its type, text or settings were missing")
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


def tell_apart(notebook) -> None:
    """Give each cell its own id, as nbformat 4.5 asks for: a copied cell has the id of the first."""
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
