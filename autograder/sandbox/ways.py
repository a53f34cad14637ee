"""Knows in which ways a room can be made, and starts its process.

With bubblewrap, the process has no network, no home directory, no course folder, none of this
project's files but the runner, and a read-only system. Without bubblewrap (macOS, some containers),
there are only limits on time, memory, processes and file size, and the log says so once. Either way, a
room is a fork of a warm process if the system allows that, and otherwise a new process.
"""

import socket
from dataclasses import dataclass
from enum import Enum

from autograder.sandbox import nursery
from autograder.sandbox.bubblewrap import bubblewrapped, has_bubblewrap
from autograder.sandbox.cold import ColdProcess
from autograder.sandbox.unwalled import UnwalledNursery, UnwalledProcess


class Way(Enum):
    """How a room is made."""

    WARM = "forked from a warm process, in bubblewrap"
    COLD = "started in bubblewrap"
    UNWALLED = "forked from a warm process, without walls"
    UNWALLED_COLD = "started without walls"

    @property
    def walled(self) -> bool:
        return self in (Way.WARM, Way.COLD)

    @property
    def warm(self) -> bool:
        return self in (Way.WARM, Way.UNWALLED)


def ways_here() -> tuple[Way, Way]:
    """How rooms are made on this machine: if it can fork them from a warm process, and if it cannot."""
    return (Way.WARM, Way.COLD) if has_bubblewrap() else (Way.UNWALLED, Way.UNWALLED_COLD)


def started(way: Way):
    """The process of a new room; OSError if it does not start."""
    if not way.warm:
        return ColdProcess(way.walled)
    own = _nursery(way)
    return nursery.WarmProcess(own) if way.walled else UnwalledProcess(own)


def _nursery(way: Way) -> nursery.Nursery:
    if way.walled:
        return nursery.running(way, lambda: nursery.Nursery(*bubblewrapped("forks.py")))
    return nursery.running(way, UnwalledNursery)


@dataclass(frozen=True)
class Shared:
    """A warm process that its owner shares with the processes that work for it."""

    way: Way
    channel: socket.socket

    def close(self) -> None:
        self.channel.close()


def warm_process_of(way: Way) -> Shared:
    """This process's warm process, for others to use."""
    return Shared(way, _nursery(way).share())


def use_shared(shared: Shared | None) -> None:
    """Fork rooms from another process's warm process."""
    if shared is not None:
        nursery.use_shared(shared.way, shared.channel)
