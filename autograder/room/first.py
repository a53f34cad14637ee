"""Process 1 of a room: it furnishes the namespaces, reaps, and watches what memory they use.

When it ends, the kernel ends every process in the room. It does so when the runner has ended, and
when all of the room together uses more memory than one process of it may.
"""

import json
import os
import select
import signal
import socket
import time
from contextlib import suppress

import namespaces

DESCRIPTORS = 4  # requests, replies, a handle on this process, and a line to it
ROOM_BYTES = 4 << 30
WATCH_SECONDS = 0.1
PAGE = os.sysconf("SC_PAGE_SIZE")


def furnish_and_wait(requests, replies, handles, to_warm, user):
    """Never returns. What goes wrong before the runner starts is said on the room's own channel."""
    try:
        namespaces.map_user(*user)
        namespaces.furnish()
        os.setsid()
        os.chdir("/tmp")
        namespaces.drop_privileges()
        here, there = socket.socketpair()
        line = [requests, replies, os.pidfd_open(os.getpid()), there.fileno()]
        with socket.socket(fileno=to_warm) as channel:
            socket.send_fds(channel, [b"room"], line)
        os.dup2(here.detach(), 0)
        os.dup2(handles, 1)
        there.detach()
        os.closerange(2, os.sysconf("SC_OPEN_MAX"))
        here, judge = socket.socket(fileno=0), socket.socket(fileno=1)
        # Process 1 gets no signal from within but those it handles.
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        _, runner, *_ = socket.recv_fds(here, 16, 1)
        if runner:
            namespaces.close_to_tracing()
            here.send(b"go")
            _watch(runner[0], judge)
    except BaseException as error:
        refuse(replies, error)
    finally:
        os._exit(0)


def join(line):
    """In the runner: let process 1 end with this one, and wait until it is out of reach."""
    with socket.socket(fileno=line) as channel:
        socket.send_fds(channel, [b"runner"], [os.pidfd_open(os.getpid())])
        if channel.recv(16) != b"go":
            raise RuntimeError("the room ended before it began")


def _watch(runner, judge):
    poll = select.poll()
    poll.register(runner, select.POLLIN)
    pause = WATCH_SECONDS
    while not poll.poll(pause * 1000):
        start = time.monotonic()
        if _memory() > ROOM_BYTES:
            judge.send(f"its processes used more than {ROOM_BYTES >> 30} GiB together".encode())
            return
        # Looking closely at many processes takes long.
        pause = max(WATCH_SECONDS, 5 * (time.monotonic() - start))


def _memory():
    """Bytes that the processes of the room use, pages that several share counted once.

    The sum of what each has mapped is quick to read and no less; only where it is too much is there
    a closer look.
    """
    processes = [name for name in os.listdir("/proc") if name.isdigit() and name != "1"]
    mapped = sum(map(_mapped, processes)) + _segments()
    if mapped <= ROOM_BYTES:
        return mapped
    return sum(map(_share, processes)) + _segments()


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


def refuse(replies, error):
    why = f"{type(error).__name__}: {error}"
    with suppress(OSError):
        os.write(replies, json.dumps({"refused": why}).encode() + b"\n")
