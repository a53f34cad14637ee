"""Lets one run grade at a time: a lock that ends with its process, however that ends."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

if sys.platform == "win32":
    import msvcrt

    def _take(file: int) -> None:
        msvcrt.locking(file, msvcrt.LK_NBLCK, 1)
else:
    import fcntl

    def _take(file: int) -> None:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


@contextmanager
def locked(path: Path, otherwise: str) -> Iterator[None]:
    """Hold the lock on a file, which stays; BlockingIOError(otherwise) if another process holds it."""
    path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    file = os.open(path, os.O_RDWR | os.O_CREAT, 0o600)  # not inherited by programs started here
    try:
        try:
            _take(file)
        except (BlockingIOError, PermissionError):
            raise BlockingIOError(otherwise) from None
        yield
    finally:
        os.close(file)
