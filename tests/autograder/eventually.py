"""Waiting for what happens soon, on however busy a machine."""

import time
from collections.abc import Callable

SECONDS = 120.0


def eventually(met: Callable[[], object]) -> bool:
    """Whether it is met, at the latest after some seconds."""
    deadline = time.monotonic() + SECONDS
    while not met():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.05)
    return True
