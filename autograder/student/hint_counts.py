"""Counts the hints that a student has seen, by check, in a file beside the notebook.

So the count outlives the kernel, and each student has an own one in each course. It is handed in with
the notebook, and a class's report shows it. Where no file can be written, the kernel keeps it.
"""

import json
import os
from contextlib import suppress
from pathlib import Path

from autograder.files import put_in_place

FILE = ".hints-seen.json"
MOST_BYTES = 100_000
_here: dict[str, int] = {}  # in this kernel


def seen(id: str) -> int:
    """How many hints of this check were shown beside this notebook; 0 where that is not known."""
    return max(_here.get(id, 0), read(Path(FILE)).get(id, 0))


def is_first_call(id: str) -> bool:
    """Whether this kernel has shown no hint of this check yet."""
    return id not in _here


def keep(id: str, count: int) -> None:
    """Remember that so many were shown. `nbgrader validate` runs a notebook too, and reads none."""
    _here[id] = count
    if os.environ.get("NBGRADER_EXECUTION") or not any(Path().glob("*.ipynb")):
        return
    known = read(Path(FILE))
    if known.get(id, 0) < count:
        with suppress(OSError):  # a folder that nobody may write to: the kernel knows
            put_in_place(Path(FILE), json.dumps(known | {id: count}))


def read(file: Path) -> dict[str, int]:
    """The counts in a file, by check; empty where there is none, or where it is damaged.

    A student's file may hold anything: what is no count between 1 and 99 is left out.
    """
    try:
        if file.is_symlink() or file.stat().st_size > MOST_BYTES:
            return {}
        counts = json.loads(file.read_text(encoding="utf-8"))
        return {
            id: count
            for id, count in counts.items()
            if type(count) is int and 0 < count < 100 and len(id) < 100
        }
    except (OSError, ValueError, AttributeError, RecursionError):
        return {}
