"""Counts the hints that a student has seen, by check, in a file beside the notebook.

So the count outlives the kernel, and each student has an own one in each course. It is handed in with
the notebook, and a class's report shows it. Where no file can be written, the kernel keeps it.
"""

import os
from contextlib import suppress
from pathlib import Path

from autograder import hints_seen

_here: dict[str, int] = {}  # in this kernel


def seen(id: str) -> int:
    """How many hints of this check were shown beside this notebook; 0 where that is not known."""
    return max(_here.get(id, 0), hints_seen.read(Path(hints_seen.FILE)).get(id, 0))


def is_first_call(id: str) -> bool:
    """Whether this kernel has shown no hint of this check yet."""
    return id not in _here


def keep(id: str, count: int, beside: bool = True) -> None:
    """Remember that so many were shown. `nbgrader validate` runs a notebook too, and reads none.

    beside: whether also in the file beside the notebook; a lesson is not handed in.
    """
    _here[id] = count
    if not beside or os.environ.get("NBGRADER_EXECUTION") or not any(Path().glob("*.ipynb")):
        return
    known = hints_seen.read(Path(hints_seen.FILE))
    if known.get(id, 0) < count:
        with suppress(OSError):  # a folder that nobody may write to: the kernel knows
            hints_seen.write(Path(hints_seen.FILE), known | {id: count})
