"""What a room uses of its limits on time, as its watch tells.

They count the processor's time, of all processes of a room together: on a busy machine, an honest
answer takes longer on the clock, but no more processor time. Beside each stands a limit on the time in
which no process of the room computes or is ready to, which is PATIENCE times as long, and far behind it
one on the clock.
"""

import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Protocol

from autograder.protocol import FAR, PATIENCE

# A room's watch must answer within this time, also on a busy machine.
WATCH_SECONDS = 60.0
# Requests follow one another so quickly that the look after one serves as the look before the next.
JUST_NOW = 0.01


class RoomLostError(Exception):
    """The room's process ended, fell silent, or wrote something that is not a reply; it is gone now."""


class TooLongError(RoomLostError):
    """The room used more processor time than its limit, and did not stop by itself."""


class StarvedError(RoomLostError):
    """The room was silent until it had waited, or the clock had run, for too long, and had used less
    processor time than it may.
    """


class Watched(Protocol):
    """A room's process, whose watch can be asked."""

    def ask_watch(self, request: str, seconds: float) -> tuple[float, float] | None:
        """The processor time so far, and the time in which nothing computed, s; None if it is silent."""


class Clock:
    """A room's time, as it was at the last look.

    used: the processor time of all its processes; idle: how long none of them computed or was ready to;
    waited: the same, while the room had something to do; all in s.
    """

    def __init__(self, process: Watched):
        self._process = process
        self.used = self.idle = self.waited = self._before = 0.0
        self._looked = -math.inf

    @property
    def counted(self) -> float:
        """The processor time since `begin`, s."""
        return self.used - self._before

    def begin(self) -> None:
        """Do not count the time that the room has used so far."""
        self.look()
        self._before = self.used

    def look(self, request: str = "used") -> bool:
        """Ask the watch; whether it answered."""
        found = self._process.ask_watch(request, WATCH_SECONDS)
        self.used, self.idle = found or (self.used, self.idle)
        self._looked = time.monotonic()
        return found is not None

    @contextmanager
    def working(self) -> Iterator[None]:
        """Count the time of waiting in the block; between requests, a room waits for the judge."""
        if time.monotonic() - self._looked > JUST_NOW:
            self.look()
        idle = self.idle
        try:
            yield
        finally:
            self.waited += self.idle - idle

    def over(self, seconds: float, idle: float) -> Callable[[], type[RoomLostError] | None]:
        """A function that looks, and says by what kind of limit the room is over, counted from now.

        seconds: of processor time. idle: of waiting; the clock may run FAR / PATIENCE times as long.
        """
        self.look()
        most, longest = self.used + seconds, self.idle + idle
        far = time.monotonic() + FAR / PATIENCE * idle

        def over() -> type[RoomLostError] | None:
            self.look()
            if self.used > most:
                return TooLongError
            return StarvedError if self.idle > longest or time.monotonic() > far else None

        return over
