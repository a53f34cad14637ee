"""Stops an nbgrader command before it changes anything, if something that it needs is missing.

nbgrader first removes what a run with --force, or a later hand-in, will replace, and what failed.
"""

import tempfile
from collections.abc import Callable

from nbgrader.converters.base import NbGraderException

from autograder.protocol import one_line

SPACE = 4 << 20  # bytes: a notebook, its page and its rows may take as much


def can_start(converter, other: Callable[[], None] = lambda: None) -> None:
    """NbGraderException if the course's disk is full, or if calling `other` raises OSError."""
    try:
        with tempfile.TemporaryFile(dir=converter.coursedir.root) as file:
            file.write(bytes(SPACE))
        other()
    except OSError as error:
        reason = f"{one_line(str(error))}; the command did not start, and nothing has changed"
        converter.log.error(reason)
        raise NbGraderException(reason) from None
