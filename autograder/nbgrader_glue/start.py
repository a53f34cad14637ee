"""Before an nbgrader command changes anything: is there what it needs?

nbgrader removes what a run with --force, or a later hand-in, is to replace, and what failed.
"""

import tempfile
from collections.abc import Callable

from nbgrader.converters.base import NbGraderException

from autograder.protocol import one_line

SPACE = 4 << 20  # bytes that a notebook, its page and its rows may well take


def can_start(converter, other: Callable[[], None] = lambda: None) -> None:
    """NbGraderException where the course's disk is full, or `other`, which is called, raises OSError."""
    try:
        with tempfile.TemporaryFile(dir=converter.coursedir.root) as file:
            file.write(bytes(SPACE))
        other()
    except OSError as error:
        reason = f"{one_line(str(error))}: not started, and nothing is changed"
        converter.log.error(reason)
        raise NbGraderException(reason) from None
