"""Waits while another program has locked the gradebook, as the formgrader does for a moment."""

import sys
import time
from collections.abc import Callable
from typing import TypeVar

from sqlalchemy.exc import OperationalError

from autograder.busy import BusyError
from autograder.terminal import say

WAIT_SECONDS = 120.0
PAUSE_SECONDS = 0.5
WAITING = "the gradebook is locked by another program; waiting for it, for two minutes at most"
STAYS = (
    "the gradebook stays locked by another program, such as the formgrader or another nbgrader command: "
    "end that program, then run the same command again; it goes on from here, and nothing is lost"
)
Found = TypeVar("Found")


def patiently(work: Callable[[], Found], undo: Callable[[], object] = lambda: None) -> Found:
    """What `work` gives; while the database is locked, `undo` and try again.

    BusyError if it stays locked for WAIT_SECONDS.
    """
    ends, told = time.monotonic() + WAIT_SECONDS, False
    while True:
        try:
            return work()
        except OperationalError as error:
            if not is_locked(error):
                raise
            undo()
        if time.monotonic() > ends:
            raise BusyError(STAYS)
        if not told:
            say(WAITING, sys.stderr)
            told = True
        time.sleep(PAUSE_SECONDS)


def is_locked(error: OperationalError) -> bool:
    """Whether SQLite says that another program has locked the file."""
    return "locked" in str(error.orig)
