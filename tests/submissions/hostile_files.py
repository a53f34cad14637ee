"""Files in the place of a submission to p3-pendulum, that are hardly a notebook or not one at all.

FILES: for each, a function from the released notebook to the bytes of the file; what its docstring
says is what the file is. READABLE are those that hold answers all the same, and what they earn.
"""

import copy
import json

import nbformat

from tests.submissions.answers import cell_of
from tests.submissions.hostile import ATTACKS
from tests.submissions.p3_pendulum import POINTS, right

HALF = "\ud83e"  # of a pair
FILES = {}
READABLE = {}


def file(points=None):
    def enter(make):
        FILES[make.__name__] = make
        if points is not None:
            READABLE[make.__name__] = points
        return make

    return enter


def _json(notebook) -> bytes:
    return json.dumps(notebook).encode()


@file(POINTS)
def byte_order_mark(release):
    """A right notebook as editors on Windows save it."""
    return b"\xef\xbb\xbf" + _json(right(release))


@file(POINTS)
def half_characters(release):
    """Right answers, with half a character in a comment, in what is printed and in the metadata."""
    notebook = copy.deepcopy(right(release))
    cell = cell_of(notebook, "answer-M")
    cell.source += f"\n# {HALF}\nprint('\\ud83e')"
    cell.metadata[HALF] = HALF
    return _json(notebook)


@file(POINTS)
def half_a_name(release):
    """A settings' name that is half a character, in a cell that counts."""
    notebook = copy.deepcopy(right(release))
    cell_of(notebook, "p3-M").metadata.nbgrader.grade_id = HALF
    return _json(notebook)


@file()
def invalid_json(release):
    """Ends in the middle."""
    return _json(right(release))[:5000]


@file()
def empty(release):
    """No byte at all."""
    return b""


@file()
def not_text(release):
    """Bytes that are no text."""
    return bytes(range(256)) * 40


@file()
def deep_json(release):
    """A hundred thousand lists in each other."""
    return b"[" * 100_000 + b"]" * 100_000


@file()
def deep_settings(release):
    """A right notebook with a cell's settings nested deeper than it could be copied."""
    notebook = copy.deepcopy(right(release))
    notebook.cells[0].metadata["deep"] = None
    return _json(notebook).replace(b'"deep": null', b'"deep": ' + b"[" * 900 + b"]" * 900)


@file()
def utf_16(release):
    """A right notebook in UTF-16, which no Jupyter writes."""
    return json.dumps(right(release)).encode("utf-16")


@file()
def version_in_words(release):
    """Its version is text."""
    return _json({**right(release), "nbformat": "4"})


@file()
def a_list(release):
    """JSON, but no object."""
    return b"[1, 2, 3]"


@file()
def future_version(release):
    """A version of the format that does not exist."""
    return _json({**right(release), "nbformat": 99})


@file(POINTS)
def version_3(release):
    """nbformat 3, as IPython wrote it before Jupyter."""
    old = nbformat.convert(right(release), 3)
    return _json(old)


@file(dict.fromkeys(POINTS, 0.0))
def no_cells(release):
    """A notebook without cells."""
    return _json({**right(release), "cells": []})


@file(POINTS)
def broken_cells(release):
    """Right answers among cells that lack what a cell has, and are of no known kind."""
    notebook = copy.deepcopy(right(release))
    notebook.cells += [
        {"cell_type": "code", "metadata": {}},
        {"cell_type": "heading", "source": "x", "metadata": {}, "level": 1},
        {"cell_type": "code", "source": 3, "metadata": {"tags": 1}, "outputs": [{}], "id": "!"},
        {"cell_type": "markdown", "source": "a", "metadata": {}, "attachments": {"a": {"b": 3}}},
    ]
    return _json(notebook)


@file()
def no_metadata(release):
    """A cell without metadata, over which nbformat stumbles."""
    notebook = copy.deepcopy(right(release))
    del notebook.cells[0]["metadata"]
    return _json(notebook)


@file()
def broken_outputs(release):
    """A cell whose outputs are a number, over which nbformat stumbles."""
    notebook = copy.deepcopy(right(release))
    notebook.cells[-2].update(cell_type="code", outputs=3)
    return _json(notebook)


@file(POINTS)
def great(release):
    """Fifty megabytes, nearly all of it in outputs."""
    notebook = copy.deepcopy(right(release))
    notebook.cells[0].source += "x" * 1_000_000
    notebook.cells[2].outputs = [nbformat.v4.new_output("stream", text="y" * 49_000_000)]
    return _json(notebook)


@file(ATTACKS["broken_claims"].points)
def broken_claims(release):
    """nbgrader settings of every wrong kind."""
    return _json(ATTACKS["broken_claims"].edit(release))


@file(ATTACKS["duplicated_cells"].points)
def duplicated_cells(release):
    """Copied cells, on which nbgrader alone ended the whole batch."""
    return _json(ATTACKS["duplicated_cells"].edit(release))


@file(POINTS)
def forged_metadata(release):
    """Names a kernel and a title that pages show, and settings that break nbformat's rules."""
    notebook = copy.deepcopy(right(release))
    notebook.metadata["title"] = "</title><script>forged()</script>"
    notebook.metadata["nbgrader"] = {"grade": 1e6}
    notebook.metadata["kernelspec"] = {"name": "no-such-kernel", "display_name": "None"}
    notebook.metadata["language_info"] = {"name": "cobol"}
    notebook.metadata["authors"] = "nobody"
    return _json(notebook)
