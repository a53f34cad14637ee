"""Checks what students handed in before it is read: plain files, and no links to elsewhere."""

import os
import stat
from datetime import datetime
from pathlib import Path

from autograder.nbgrader_glue import times
from autograder.protocol import one_line


class RefusedError(ValueError):
    """The grader does not read a submission; the message says why."""


def check(folder: Path, top: Path) -> None:
    """RefusedError if a submission's folder contains a link that leads out of it, or no plain file.

    top: the folder of all submissions. No folder below it may be a link, as that could lead to another
    student's.
    """
    if folder.is_relative_to(top):
        for above in (folder, *folder.parents):
            if above == top:
                break
            if above.is_symlink():
                raise RefusedError(
                    f"the folder {one_line(above.name)} is a link: ask the student for the files"
                )
    real = folder.resolve()
    for name, folders, files in os.walk(folder):
        for entry in sorted(folders + files):
            path = Path(name, entry)
            _check_entry(path, one_line(str(path.relative_to(folder)), 100), real)


def _check_entry(path: Path, shown: str, folder: Path) -> None:
    again = "ask the student for the file itself"
    if path.is_symlink() and not Path(os.path.realpath(path)).is_relative_to(folder):
        raise RefusedError(f"{shown} is a link out of the submission: {again}")
    try:
        mode = path.stat().st_mode
    except OSError as error:
        raise RefusedError(f"{shown} leads nowhere ({error.strerror}): {again}") from None
    if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
        raise RefusedError(f"{shown} is a pipe, a device or the like: {again}")
    if path.suffix == ".ipynb" and not stat.S_ISREG(mode):
        raise RefusedError(f"{shown} is a folder: {again}")


def timestamp(folder: Path) -> datetime | None:
    """When a submission was handed in, in UTC; None if that is not known.

    RefusedError if its timestamp.txt holds no time, and cannot be put aside.
    """
    try:
        return times.of(folder)
    except OSError as error:
        raise RefusedError(
            f"{times.FILE} cannot be read, or written as {times.AS} ({error.strerror}): "
            "put the time of the submission into it, or delete it"
        ) from None
