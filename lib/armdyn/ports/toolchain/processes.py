"""Starts a program so that it and everything that it starts can be ended together."""

import contextlib
import os
import signal
import subprocess
from pathlib import Path


def start(command, **options) -> subprocess.Popen:
    """The command as a process at the head of a group of its own."""
    return subprocess.Popen([str(part) for part in command], start_new_session=True, **options)


def processor_seconds(process: subprocess.Popen) -> float | None:
    """The processor time that the process has used, s; None if the system does not say."""
    try:
        stat = Path(f"/proc/{process.pid}/stat").read_text()
    except OSError:
        return None
    user, system = stat.rpartition(")")[2].split()[11:13]  # the name before may hold anything
    return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")


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
