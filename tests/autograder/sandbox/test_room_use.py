"""What a room may use as a whole, however many processes share it."""

import os

import pytest

from autograder.sandbox import bubblewrap
from autograder.sandbox.inside.watch import MOST_PROCESSES
from autograder.sandbox.room import Room, RoomLostError
from autograder.sandbox.ways import Way
from tests.autograder.sandbox.rooms import WALLED_WAYS, printed

# Each of these takes one GiB, in pages large enough to be quick.
FILL = (
    "import mmap, os, time\n"
    "def fill():\n"
    "    memory = mmap.mmap(-1, 1 << 30, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)\n"
    "    memory.madvise(mmap.MADV_HUGEPAGE)\n"
    "    for at in range(0, 1 << 30, mmap.PAGESIZE): memory[at] = 1\n"
    "    return memory\n"
)


@WALLED_WAYS
def test_processes_that_share_out_a_memory_bomb_end_with_their_room(way):
    bomb = (
        FILL
        + "for _ in range(5):\n    if os.fork() == 0: kept = fill(); time.sleep(99)\ntime.sleep(60)"
    )
    with Room(way) as room, pytest.raises(RoomLostError, match="more than 4 GiB of memory"):
        room.run(bomb, seconds=60)


@WALLED_WAYS
def test_processes_that_nobody_sees_end_with_their_room(way):
    # Threads count as processes do, and are quicker.
    bomb = (
        "import threading, time\n"
        "for _ in range(6000):\n"
        "    thread = threading.Thread(target=int); thread.start(); thread.join()\n"
        "time.sleep(60)"
    )
    with Room(way) as room, pytest.raises(RoomLostError, match="started more than 5000 processes"):
        room.run(bomb, seconds=60)


@WALLED_WAYS
def test_pages_that_processes_share_count_once(way):
    shared = FILL + (
        "memory = fill()\n"
        "for _ in range(8):\n"
        "    if os.fork() == 0: time.sleep(99)\n"
        "time.sleep(0.5)"
    )
    with Room(way) as room:
        assert room.run(shared, seconds=60) == []
        assert printed(room, "print('alive')") == "alive"


@WALLED_WAYS
def test_segments_of_shared_memory_that_nobody_has_mapped_count(way):
    bomb = FILL + (
        "import ctypes\n"
        "libc = ctypes.CDLL(None)\n"
        "libc.shmat.restype = ctypes.c_void_p\n"
        "libc.shmat.argtypes = [ctypes.c_int, ctypes.c_void_p, ctypes.c_int]\n"
        "libc.shmdt.argtypes = [ctypes.c_void_p]\n"
        "for _ in range(9):\n"
        "    number = libc.shmget(0, ctypes.c_size_t(1 << 29), 0o1600)\n"
        "    at = libc.shmat(number, None, 0)\n"
        "    ctypes.memset(at, 1, 1 << 29)\n"
        "    libc.shmdt(at)\n"
        "time.sleep(60)"
    )
    with Room(way) as room, pytest.raises(RoomLostError, match="more than 4 GiB of memory"):
        room.run(bomb, seconds=60)


def test_a_room_whose_processes_the_kernel_does_not_limit_ends_by_itself(needs, monkeypatch):
    """As for a root who cannot step down; for another user the kernel holds the limit first."""
    needs("bubblewrap")
    monkeypatch.setattr(bubblewrap, "_root_can_step_down", lambda: False)
    bomb = "import os, time\nfor _ in range(200):\n    if os.fork() == 0: time.sleep(60)\n"
    with Room(Way.COLD) as room:
        if os.geteuid() != 0:
            said = room.run(bomb + "time.sleep(1)")
            assert said[-1]["ename"] == "BlockingIOError"
            return
        with pytest.raises(RoomLostError, match=f"more than {MOST_PROCESSES} processes"):
            room.run(bomb + "time.sleep(60)", seconds=60)
