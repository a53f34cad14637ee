"""The file beside a notebook that holds how many hints of each check its student has seen."""

import json
from pathlib import Path

from autograder.files import put_in_place

FILE = ".hints-seen.json"
MOST_BYTES = 100_000


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


def write(file: Path, counts: dict[str, int]) -> None:
    """Put the counts into a file. OSError if it cannot be written."""
    put_in_place(file, json.dumps(counts))
