"""Empties course/ for the next year, of what an archive holds and of nothing else."""

import os
import shutil
import tomllib
from collections.abc import Mapping
from pathlib import Path

from autograder import term_calendar
from autograder.year.archive import sum_of
from autograder.year.holdings import COURSE, MADE_AGAIN

LAST_CALENDAR = Path(COURSE) / "calendar-of-last-year.toml"


def empty(root: Path, kept: Mapping[str, str], stays: set[str]) -> list[str]:
    """Remove each file of course/ that is still as it was archived; what stays unasked, in lines.

    kept: SHA-256 sums by the path in `root`. stays: what is not to be removed.
    """
    left = []
    for name, found in kept.items():
        path = root / name
        if name.split("/")[0] != COURSE or name in stays or not path.exists():
            continue
        try:
            if sum_of(path) == found:
                path.unlink()
            else:
                left.append(f"{name} has changed since it was archived, and stays")
        except OSError as error:
            left.append(f"{name} stays: {error.strerror}")
    for name in MADE_AGAIN:
        shutil.rmtree(root / COURSE / name, ignore_errors=True)
    for above, _, _ in os.walk(root / COURSE, topdown=False):
        if not os.listdir(above) and above != str(root / COURSE):
            os.rmdir(above)
    return left


def last_calendar(root: Path) -> str:
    """The calendar's text without anybody's extension, to write the next one by; "" if there is none.

    ValueError if the calendar is wrong, or an extension stands in it in a way that is not found.
    """
    path = root / term_calendar.FILE
    if not path.is_file():
        return ""
    text = path.read_text("utf-8-sig")
    for one in term_calendar.read_if_there(root).assignments.values():
        for student in one.extensions:
            text, _ = term_calendar.without_extensions(text, student)
    if any(said.get("extensions") for said in tomllib.loads(text).values() if type(said) is dict):
        raise ValueError(
            f"{path}: extensions are to stand on lines of their own below [….extensions], so that "
            "the calendar can be kept without the students' names"
        )
    return text
