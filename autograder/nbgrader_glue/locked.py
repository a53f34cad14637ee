"""Waits while another program has locked the gradebook, as the formgrader does for a moment."""

import sqlite3
import sys
import time
from collections.abc import Callable
from typing import TypeVar

from sqlalchemy.exc import DBAPIError, OperationalError

from autograder.busy import BusyError
from autograder.protocol import one_line
from autograder.terminal import say

WAIT_SECONDS = 120.0
PAUSE_SECONDS = 0.5
WAITING = "the gradebook is locked by another program; waiting for it, for two minutes at most"
LOCKED = (
    "the gradebook stays locked by another program, such as the formgrader or another nbgrader command: "
    "end that program, and try again"
)
STAYS = f"{LOCKED}; the same command then goes on from here, and nothing is lost"
UNUSABLE = (
    "the gradebook cannot be read or written: {said}. Look at db_url in nbgrader_config.py and at the "
    "database that it names; if a file is damaged, put a copy of it back"
)
Found = TypeVar("Found")


def patiently(
    work: Callable[[], Found],
    undo: Callable[[], object] = lambda: None,
    seconds: float | None = None,
) -> Found:
    """What `work` gives; while the database is locked, `undo` and try again.

    seconds: how long, without a word; None for WAIT_SECONDS, of which a line tells at the first wait.
    BusyError if it stays locked for longer.
    """
    told = seconds is not None
    ends = time.monotonic() + (WAIT_SECONDS if seconds is None else seconds)
    while True:
        try:
            return work()
        except OperationalError as error:
            if not is_locked(error):
                raise
            undo()
        if time.monotonic() > ends:
            raise BusyError(STAYS if seconds is None else LOCKED)
        if not told:
            say(WAITING, sys.stderr)
            told = True
        time.sleep(PAUSE_SECONDS)


def is_locked(error: Exception) -> bool:
    """Whether SQLite says that another program has locked the file."""
    return "locked" in _said(error)


def why_unusable(error: Exception) -> str:
    """What to say of an error that the database reports; "" for any other error."""
    if not isinstance(error, DBAPIError | sqlite3.Error):
        return ""
    return LOCKED if is_locked(error) else UNUSABLE.format(said=one_line(_said(error)))


def _said(error: Exception) -> str:
    return str(error.orig if isinstance(error, DBAPIError) else error)
