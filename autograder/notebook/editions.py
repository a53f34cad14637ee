"""The editions of a problem: as it was handed out, before and after its source was changed.

A submission is held against the edition that its student got, so that nobody is told of changes that the
instructor made.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import nbformat
from nbformat import NotebookNode

from autograder.notebook.recognise import grade_id, known_cells
from autograder.notebook.released import essence, released

OF_NBGRADER = ("checksum", "cell_type")  # settings that it writes into a released cell by itself


@dataclass(frozen=True)
class Edition:
    """One of them. By grade_id: the cells' nbgrader settings, types and texts. others: the essences of
    the other cells' texts.
    """

    settings: dict[str, dict]
    types: dict[str, str]
    texts: dict[str, str]
    others: frozenset[str]

    def has_text_of(self, cell: NotebookNode) -> bool:
        """Whether a graded cell's text is as it was handed out."""
        name = grade_id(cell) or ""
        return name in self.texts and essence(cell.source) == essence(self.texts[name])

    def has_settings_of(self, cell: NotebookNode) -> bool:
        """Whether a graded cell's nbgrader settings are as they were handed out."""
        name, claims = grade_id(cell) or "", settings_of(cell)
        wanted = self.settings.get(name, {})
        return name in self.settings and all(claims.get(key) == wanted[key] for key in wanted)


def of_source(source: NotebookNode) -> Edition:
    """The edition that a source notebook makes now."""
    return _edition(source, released)


@lru_cache(maxsize=64)
def of_release(text: str) -> Edition:
    """The edition of a released notebook, as JSON."""
    return _edition(nbformat.reads(text, as_version=4), lambda cell: cell.source)


def settings_of(cell: NotebookNode) -> dict:
    """A cell's nbgrader settings, but for those that nbgrader adds to a released one."""
    claims = cell.metadata.get("nbgrader") or {}
    return {name: value for name, value in claims.items() if name not in OF_NBGRADER}


def begun_with(notebook: NotebookNode, editions: Sequence[Edition]) -> Edition:
    """The edition that a notebook has most in common with; of several, the first.

    editions: at least one.
    """
    claimed = {name: cell for cell in notebook.cells if (name := grade_id(cell))}
    texts = {essence(cell.source) for cell in notebook.cells if isinstance(cell.get("source"), str)}
    return max(editions, key=lambda edition: _likeness(claimed, texts, edition))


def _likeness(claimed: dict[str, NotebookNode], texts: set[str], edition: Edition) -> int:
    """How many settings, types and texts are this edition's, less the cells that only one has."""
    common = claimed.keys() & edition.settings.keys()
    alike = sum(settings_of(claimed[name]) == edition.settings[name] for name in common)
    alike += sum(claimed[name].cell_type == edition.types[name] for name in common)
    alike += len(texts & {*map(essence, edition.texts.values()), *edition.others})
    return alike - len(claimed.keys() ^ edition.settings.keys())


def _edition(notebook: NotebookNode, text_of) -> Edition:
    known = known_cells(notebook)
    return Edition(
        {name: settings_of(cell) for name, cell in known.items()},
        {name: cell.cell_type for name, cell in known.items()},
        {name: text_of(cell) for name, cell in known.items()},
        frozenset(essence(text_of(cell)) for cell in notebook.cells if not grade_id(cell)),
    )


def texts_of(editions: Iterable[Edition]) -> set[str]:
    """The essences of all texts that were handed out."""
    found: set[str] = set()
    for edition in editions:
        found |= edition.others | set(map(essence, edition.texts.values()))
    return found
