"""Keeps on disk what has been graded: judged notebooks by their content, and what was recorded.

A result's name is a digest of everything that decides it: the submission, the source, the seed, the
settings and this code. So no result is ever out of date, and you may delete the cache at any time.
"""

import json
import sys
from collections.abc import Iterator
from functools import cache
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path

from autograder.digest import digest
from autograder.files import PART, put_in_place

SOURCES = {
    ".py",
    ".cpp",
    ".hpp",
    ".java",
    ".m",
}  # some are compiled together with students' answers
PACKAGES = ("ipython", "matplotlib", "nbformat", "numpy", "scipy", "sympy")


class Cache:
    """A folder of JSON files; each appears whole or not at all, even if a run is killed."""

    def __init__(self, folder: Path):
        self._folder = folder
        folder.mkdir(parents=True, exist_ok=True)
        for left in folder.rglob(f"*{PART}"):
            left.unlink()

    def load(self, name: str) -> dict | None:
        """The entry of this name; None if there is none that can be read."""
        try:
            entry = json.loads(self._path(name).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return None
        return entry if isinstance(entry, dict) else None

    def store(self, name: str, entry: dict) -> None:
        path = self._path(name)
        path.parent.mkdir(parents=True, exist_ok=True)
        put_in_place(path, json.dumps(entry))

    def _path(self, name: str) -> Path:
        return self._folder / f"{name}.json"


@cache
def code_version() -> str:
    """A digest of the code that grades: this package, armdyn, Python and the packages under them."""
    armdyn = find_spec("armdyn")  # importing it would load SciPy
    assert armdyn is not None
    assert armdyn.origin is not None
    parts = [sys.version, *(f"{name} {metadata.version(name)}" for name in PACKAGES)]
    for package in (Path(__file__).parents[1], Path(armdyn.origin).parent):
        parts += [f"{name}\0{text}" for name, text in _sources(package)]
    return digest(*parts)


def _sources(package: Path) -> Iterator[tuple[str, str]]:
    for path in sorted(path for path in package.rglob("*.*") if path.suffix in SOURCES):
        yield path.relative_to(package).as_posix(), path.read_text(encoding="utf-8")
