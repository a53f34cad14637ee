"""What all processes of a room use together: limits of the kernel's hold for each alone."""

import os
import select
import time
from contextlib import suppress

# A room has no more processes and threads than this, its keeper among them. The kernel holds it
# where the room's user is not root.
MOST_PROCESSES = 64
ROOM_BYTES = 4 << 30
LOOK_SECONDS = 0.1
PAGE = os.sysconf("SC_PAGE_SIZE")


def until_ended(process: int) -> str:
    """Wait until the process that a pidfd stands for ends, or its room has to: the reason why."""
    poll = select.poll()
    poll.register(process, select.POLLIN)
    pause = LOOK_SECONDS
    while not poll.poll(pause * 1000):
        start = time.monotonic()
        if reason := _too_much():
            return reason
        # Looking closely at many processes takes long.
        pause = max(LOOK_SECONDS, 5 * (time.monotonic() - start))
    return ""


def _too_much() -> str:
    """The limit that the room is over, if any.

    The sum of what each process has mapped is quick to read and no less than what they use, pages
    that several share counted once; only where it is too much is there a closer look.
    """
    own = ("1", str(os.getpid()))
    processes = [name for name in os.listdir("/proc") if name.isdigit() and name not in own]
    if sum(map(_threads, processes)) > MOST_PROCESSES:
        return f"it had more than {MOST_PROCESSES} processes and threads"
    segments = _segments()
    if (
        sum(map(_mapped, processes)) + segments > ROOM_BYTES
        and sum(map(_share, processes)) + segments > ROOM_BYTES
    ):
        return f"its processes used more than {ROOM_BYTES >> 30} GiB of memory together"
    return ""


def _threads(process):
    with suppress(OSError):
        return os.stat(f"/proc/{process}/task").st_nlink - 2
    return 0


def _mapped(process):
    with suppress(OSError), open(f"/proc/{process}/statm") as file:
        return int(file.read().split()[1]) * PAGE
    return 0


def _share(process):
    try:
        with open(f"/proc/{process}/smaps_rollup") as file:
            return sum(int(line.split()[1]) << 10 for line in file if line.startswith("Pss:"))
    except OSError:
        return _mapped(process)  # it hides, or has just ended


def _segments():
    """Shared memory of System V stays when nobody has it mapped."""
    with suppress(OSError), open("/proc/sysvipc/shm") as file:
        column = file.readline().split().index("rss")
        return sum(int(line.split()[column]) for line in file)
    return 0
