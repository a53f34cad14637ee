"""Rooms of every kind for the tests, and what can be said to them."""

import os
from contextlib import contextmanager
from pathlib import Path

import pytest

from autograder.sandbox.room import Room
from autograder.sandbox.ways import Way
from tests.autograder.eventually import eventually

EVERY_WAY = pytest.mark.parametrize("way", list(Way), indirect=True, ids=lambda way: way.name)
# A cold room takes a second to start, and has the walls of a warm one.
COLD_AT_NIGHT = pytest.mark.parametrize(
    "way",
    [
        Way.WARM,
        Way.UNWALLED,
        pytest.param(Way.COLD, marks=pytest.mark.long),
        pytest.param(Way.UNWALLED_COLD, marks=pytest.mark.long),
    ],
    indirect=True,
    ids=lambda way: way.name,
)
WALLED_WAYS = pytest.mark.parametrize(
    "way", [Way.WARM, Way.COLD], indirect=True, ids=lambda way: way.name
)


@contextmanager
def kept():
    """One room of each kind, started when a test asks for it, by `room_of`; closed at the end."""
    rooms = {}
    yield rooms
    for room in rooms.values():
        room.close()


def room_of(rooms: dict, way: Way) -> Room:
    # A test that loses the room fails by itself, and takes no other along.
    if way not in rooms or rooms[way].closed:
        rooms[way] = Room(way)
    return rooms[way]


def printed(room, source: str) -> str:
    """What the cell printed; it must do nothing else."""
    (output,) = room.run(source)
    assert (output["output_type"], output["name"]) == ("stream", "stdout")
    return output["text"].strip()


def failed(room, source: str, seconds: float = 10.0) -> str:
    """The error of a cell, after which the room still lives."""
    error = room.run(source, seconds)[-1]
    assert error["output_type"] == "error"
    assert printed(room, "print('alive')") == "alive"
    return f"{error['ename']}: {error['evalue']}"


def sleeper(mark: str) -> str:
    """The arguments, in a student's source, of a process that carries `mark` and outlives the test."""
    return f"[sys.executable, '-c', 'import time; time.sleep(99)', {mark!r}]"


def processes_with(mark: str) -> list[int]:
    """The processes on this machine that have `mark` in their command line."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            command = (entry / "cmdline").read_bytes()
        except OSError:
            continue
        if mark.encode() in command and entry.name != str(os.getpid()):
            found.append(int(entry.name))
    return found


def appears(mark: str) -> bool:
    """Whether a process carries `mark`: a child that was just started has no command line yet."""
    return eventually(lambda: processes_with(mark))


def gone(mark: str) -> bool:
    """Whether no process carries `mark`, at the latest when the system has cleaned up."""
    return eventually(lambda: not processes_with(mark))
