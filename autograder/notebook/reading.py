"""Reads a notebook that was handed in, whatever the file holds."""

import nbformat
from nbformat import NotebookNode


class UnreadableError(ValueError):
    """A file is no notebook that can be graded; the message says why, behind the file's name."""


def read(content: bytes) -> tuple[NotebookNode, list[str]]:
    """The notebook in nbformat 4, and notes on it. UnreadableError if there is none in the file."""
    try:
        notebook = nbformat.reads(content.decode("utf-8-sig"), as_version=nbformat.NO_CONVERT)
        has_metadata = isinstance(notebook.get("metadata"), dict)
    except (UnicodeDecodeError, nbformat.reader.NotJSONError):
        raise UnreadableError("is not valid JSON: ask the student for it again") from None
    except (AttributeError, KeyError, TypeError):  # JSON, but of something else
        has_metadata = False
    if not has_metadata:
        raise UnreadableError("is not a notebook: ask the student for it again")
    notes = []
    if notebook.nbformat != 4:
        notes.append(f"the notebook was in format {notebook.nbformat}; it was converted")
        notebook = nbformat.convert(notebook, 4)
    return notebook, notes
