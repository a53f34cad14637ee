"""Every process that a command left: on Linux, orphans come to the process that adopts them."""

import ctypes
import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

PR_SET_CHILD_SUBREAPER = 36  # from <linux/prctl.h>
PATIENCE = 60.0


class Adopted:
    """The processes below this one that were not there when the block began."""

    def __init__(self):
        self._before = below()

    def living(self) -> set[int]:
        """Their ids; orphans that have ended are reaped, which adds their time to our children's."""
        for process in below() - self._before:
            with suppress(ChildProcessError):
                os.waitpid(process, os.WNOHANG)
        return below() - self._before

    def wait(self) -> None:
        """Until none is left. TimeoutError where they do not end."""
        deadline = time.monotonic() + PATIENCE
        while left := self.living():
            if time.monotonic() > deadline:
                raise TimeoutError(f"still there after {PATIENCE:g} s: {_said(left)}")
            time.sleep(0.002)


def below(process: int | None = None, ended: bool = True) -> set[int]:
    """The processes below that one, or this. ended: those as well that nobody has waited for yet."""
    children: dict[int, list[int]] = {}
    for path in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            # The name, in parentheses, may hold anything.
            state, parent = path.read_text().rpartition(")")[2].split()[:2]
            if ended or state != "Z":
                children.setdefault(int(parent), []).append(int(path.parent.name))
    found, last = set(), [process or os.getpid()]
    while last:
        last = [child for parent in last for child in children.get(parent, [])]
        found.update(last)
    return found


@contextmanager
def adopting() -> Iterator[Adopted]:
    """Orphans of the commands that run in the block become children of this process.

    The block waits for its own commands before it asks for those left. Elsewhere than on Linux
    nothing is seen.
    """
    adopted = Adopted()
    _adopt(True)
    try:
        yield adopted
    finally:
        _adopt(False)


def _adopt(whether: bool) -> None:
    if sys.platform == "linux":
        libc = ctypes.CDLL(None, use_errno=True)
        if libc.prctl(PR_SET_CHILD_SUBREAPER, int(whether), 0, 0, 0):
            raise OSError(ctypes.get_errno(), "prctl")


def _said(processes: set[int]) -> str:
    commands = []
    for process in sorted(processes):
        with suppress(OSError):
            command = Path(f"/proc/{process}/cmdline").read_bytes().replace(b"\0", b" ")
            commands.append(f"{process} {command.decode(errors='replace')[:80]}")
    return "; ".join(commands)
