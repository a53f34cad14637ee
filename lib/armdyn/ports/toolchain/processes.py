"""A program and all that it starts, as one group that can be ended."""

import contextlib
import os
import signal
import subprocess


def start(command, **options) -> subprocess.Popen:
    """The command as a process at the head of a group of its own."""
    return subprocess.Popen([str(part) for part in command], start_new_session=True, **options)


def end(process: subprocess.Popen, grace: float = 0) -> None:
    """Kill the process and its group, after `grace` seconds to end by itself; take its status."""
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(grace)
    if os.name == "posix":
        with contextlib.suppress(ProcessLookupError, PermissionError):  # nothing is left of it
            os.killpg(process.pid, signal.SIGKILL)
    else:
        process.kill()
    process.wait()
