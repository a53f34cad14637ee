"""Keeps the course's folder from the other accounts of this machine."""

import os
import stat
import sys
from functools import cache
from pathlib import Path
from shlex import quote

from autograder.entering import why_closed
from autograder.terminal import say


def make_private(folder: Path) -> None:
    """Make a folder that its owner alone can enter; where it is there and others can, say so, and where
    this account cannot.

    What is there keeps its permissions: graders may share it as a group.
    """
    try:
        folder.mkdir(mode=0o700)
    except FileExistsError:
        if why := why_closed(folder):  # nbgrader shows what follows as a traceback
            _tell(f"Nothing can be done: {why}.")
        elif _open_to_others(folder):
            _tell(
                f"Everybody who has an account on this machine can enter {folder}, which holds your "
                f"students' work and grades. To close it: chmod o-rwx {quote(str(folder))}"
            )


@cache  # nbgrader reads its settings three times a command
def _tell(what: str) -> None:
    say(what, sys.stderr)


def _open_to_others(folder: Path) -> bool:
    """Whether accounts beside owner and group get into the folder, through those that it lies in."""
    if os.name != "posix":
        return False
    inside, *above = (stat.S_IMODE(path.stat().st_mode) for path in (folder, *folder.parents))
    return bool(inside & stat.S_IRWXO) and all(mode & stat.S_IXOTH for mode in above)
