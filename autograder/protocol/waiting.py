"""Tells how long code has waited for nothing: neither it nor what it started computed, or could not.

On a busy machine, code that computes waits for a processor; that is not its fault, and Linux says how
long it was. Where the system does not say, that time counts as well.
"""

import os
import time
from collections.abc import Callable
from contextlib import suppress
from typing import TypeVar

Read = TypeVar("Read")
TRIES = 4
MOMENT = 0.01  # s; to read all takes a tenth of it


class Waiting:
    """Adds up, from one look to the next, the time in which nothing computed or wanted to, s."""

    def __init__(self) -> None:
        self._idle = 0.0
        self._seen: tuple[float, float, dict[str, float]] | None = None

    def look(self) -> float:
        """The time so far, s; before the first look nothing is known, and 0 comes back.

        Look often: of a process that has ended, the time since the last look counts as waiting, but for
        what it computed.
        """
        clock, (busy, below) = _at_once(lambda: (_busy_here(), _busy_below()))
        if self._seen is not None:
            clock_before, busy_before, below_before = self._seen
            worked = busy - busy_before
            worked += sum(max(0.0, now - below_before.get(key, 0.0)) for key, now in below.items())
            self._idle += max(0.0, clock - clock_before - worked)
        self._seen = clock, busy, below
        return self._idle


class Stopwatch:
    """What code has used of its time limit since this was made."""

    def __init__(self) -> None:
        self._computed, self._clock, self._delay = _now()

    def seconds(self, patience: float) -> float:
        """The processor time, or a `patience`-th of the time that it waited, s; the longer one."""
        computed, clock, delay = _now()
        used = computed - self._computed
        waited = clock - self._clock - used - (delay - self._delay)
        return max(used, waited / patience)


def _now() -> tuple[float, float, float]:
    clock, (computed, delay) = _at_once(
        lambda: (time.process_time(), _delay("/proc/thread-self/schedstat"))
    )
    return computed, clock, delay


def _at_once(read: Callable[[], Read]) -> tuple[float, Read]:
    """The clock, s, and what was read just then: once more where the processor was lost in between."""
    for _ in range(TRIES):
        clock = time.monotonic()
        found = read()
        if time.monotonic() - clock < MOMENT:
            break
    return clock, found


def _busy_here() -> float:
    """The processor time of this process and of children that ended, and its threads' delays, s."""
    times = os.times()
    return time.process_time() + times.children_user + times.children_system + _delays("self")


def _busy_below() -> dict[str, float]:
    """The same of each process below this one that lives."""
    found: dict[str, float] = {}
    left = ["self"]
    while left and len(found) < 100:
        for child in _children(left.pop()):
            if child not in found:
                found[child] = _computed(child) + _delays(child)
                left.append(child)
    return found


def _children(process: str) -> list[str]:
    found: list[str] = []
    with suppress(OSError):
        for thread in os.listdir(f"/proc/{process}/task"):
            with suppress(OSError), open(f"/proc/{process}/task/{thread}/children") as file:
                found += file.read().split()
    return found


def _computed(process: str) -> float:
    with suppress(OSError, ValueError), open(f"/proc/{process}/stat") as file:
        user, system = file.read().rpartition(")")[2].split()[11:13]
        return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")
    return 0.0


def _delays(process: str) -> float:
    """How long the threads of a process were ready and had no processor, s; 0 where nobody knows."""
    with suppress(OSError):
        threads = os.listdir(f"/proc/{process}/task")
        return sum(_delay(f"/proc/{process}/task/{thread}/schedstat") for thread in threads)
    return 0.0


def _delay(path: str) -> float:
    with suppress(OSError, ValueError, IndexError):
        # Read twice in each call of a student's function, where `open` takes twice as long.
        file = os.open(path, os.O_RDONLY)
        try:
            return int(os.read(file, 100).split()[1]) / 1e9
        finally:
            os.close(file)
    return 0.0
