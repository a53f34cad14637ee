"""The warm process, from outside: started once, it forks a room in the time a cold one takes to load.

A grader process has one, started with its first room and ended with the process, however that
ends: the warm process reads a socket whose other end is here, and stops when that is closed. It may
lend this end to processes that work for it.
"""

import atexit
import os
import select
import signal
import socket
import subprocess
import tempfile
import threading
import time
import weakref
from collections.abc import Callable
from contextlib import suppress
from enum import Enum
from typing import ClassVar

START_SECONDS = 60.0
END_SECONDS = 10.0


class Nursery:
    """A running warm process. `start_room` forks a room of it; OSError where it cannot.

    command, environment: what starts it.
    """

    def __init__(self, command: list[str], environment: dict[str, str]):
        self._lock = threading.Lock()
        self._said = tempfile.TemporaryFile()  # noqa: SIM115  closed in close
        self._channel, inside = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with inside:
            self._process = subprocess.Popen(
                command,
                env=environment,
                cwd="/",
                stdin=inside.fileno(),
                stdout=subprocess.DEVNULL,
                stderr=self._said,
                start_new_session=True,
            )
        if not select.select([self._channel], [], [], START_SECONDS)[0] or not self._read_ready():
            said = os.pread(self._said.fileno(), 4096, 0).decode(errors="replace").strip()
            self.close()
            raise OSError(f"the warm process did not start: {said[-300:]}")

    def _read_ready(self) -> bool:
        with suppress(OSError):
            return self._channel.recv(16) == b"ready"
        return False

    @property
    def alive(self) -> bool:
        with self._lock:
            return self._process.poll() is None

    def answers(self) -> bool:
        """Whether it works: that it is ending shows here before `alive` does."""
        with self._lock, suppress(OSError):
            self._channel.send(b"alive?")
            if select.select([self._channel], [], [], END_SECONDS)[0]:
                return self._channel.recv(16) == b"alive"
        return False

    def start_room(self, folder: str = "") -> tuple[int, int, socket.socket]:
        """Fork a room; what leads to its requests, its replies and its watch.

        folder: where its cells run, for rooms without walls, which have no /tmp of their own.
        """
        request_end, requests = os.pipe()
        replies, reply_end = os.pipe()
        handles, handle_end = socket.socketpair()
        passed = [request_end, reply_end, handle_end.fileno()]
        try:
            with self._lock:
                socket.send_fds(self._channel, [b"room" + os.fsencode(folder)], passed)
        except OSError as error:
            os.close(requests)
            os.close(replies)
            handles.close()
            raise OSError(f"the warm process has ended: {error}") from None
        finally:
            os.close(request_end)
            os.close(reply_end)
            handle_end.close()
        return requests, replies, handles

    def lend(self) -> socket.socket:
        """A copy of this end of the socket, from which another process makes a `LentNursery`."""
        return self._channel.dup()

    def close(self) -> None:
        """End the process and all its rooms."""
        with self._lock:
            self._channel.close()
            try:
                self._process.wait(END_SECONDS)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
            self._said.close()

    def forget(self) -> None:
        """In a fork of the grader: this end of the socket must not keep the warm process alive."""
        self._channel.close()
        self._process.returncode = 0  # another process's child, and not to be warned of


class LentNursery(Nursery):
    """Another process's nursery, through a copy of its socket; `close` gives that back."""

    def __init__(self, channel: socket.socket):
        self._lock = threading.Lock()
        self._channel = channel
        self._hangs_up = select.poll()
        self._hangs_up.register(channel, 0)

    @property
    def alive(self) -> bool:
        return not self._hangs_up.poll(0)

    def close(self) -> None:
        self._channel.close()

    def forget(self) -> None:
        self.close()


class WatchLine:
    """The judge's end of the line to a room's watch, which is open as long as the room shall live.

    A fork of the judge lets go of its copy, so that the room ends with the judge alone.
    """

    _open: ClassVar[weakref.WeakSet] = weakref.WeakSet()

    def __init__(self, line: socket.socket):
        self._line, self._received, self._reason = line, b"", ""
        WatchLine._open.add(self)

    def told(self, request: str, seconds: float) -> float | None:
        """The processor time that the watch answers with, s; None where it has ended or is silent."""
        with suppress(OSError):
            self._line.sendall(request.encode() + b"\n")
        deadline = time.monotonic() + seconds
        while (line := self._read_line(deadline - time.monotonic())) is not None:
            word, _, number = line.partition(" ")
            if word == request:  # no late answer to another
                return float(number)
        return None

    def reason(self) -> str:
        """Why the watch has ended the room; "" where it has not."""
        while not self._reason and self._read_line(0) is not None:
            pass
        return self._reason

    def close(self) -> None:
        self._line.close()

    def _read_line(self, seconds: float) -> str | None:
        deadline = time.monotonic() + seconds
        while b"\n" not in self._received:
            left = max(0.0, deadline - time.monotonic())
            if self._line.fileno() < 0 or not select.select([self._line], [], [], left)[0]:
                return None
            received = b""
            with suppress(OSError):
                received = self._line.recv(1 << 12)
            if not received:
                return None
            self._received += received
        line, _, self._received = self._received.partition(b"\n")
        text = line.decode(errors="replace")
        if text.startswith("! "):
            self._reason = text[2:302]
        return text

    @classmethod
    def let_go(cls) -> None:
        for line in list(cls._open):
            line.close()


class WarmProcess:
    """One room's processes. requests, replies: descriptors, as of a subprocess's pipes.

    nursery, folder: whose room it is, and as of its `start_room`.
    """

    def __init__(self, nursery: Nursery, folder: str = ""):
        self._nursery = nursery
        self.requests, self.replies, line = nursery.start_room(folder)
        self._handle = _receive_handle(line)
        self._watch = WatchLine(line)
        self.ended = False

    def told(self, request: str, seconds: float) -> float | None:
        return self._watch.told(request, seconds)

    def said(self) -> str:
        return self._watch.reason()

    def outlived_its_keeper(self) -> bool:
        """Whether the warm process ended, so that the end of this room is not the room's doing."""
        return not self._nursery.answers()

    def end(self) -> None:
        """Kill the room's watch, with which the kernel ends all others behind walls; wait for it."""
        if self.ended:
            return
        self.ended = True
        if self._handle is not None:
            with suppress(ProcessLookupError):
                signal.pidfd_send_signal(self._handle, signal.SIGKILL)
            # Readable when the last process of the namespace is gone.
            select.select([self._handle], [], [], START_SECONDS)
            os.close(self._handle)
        self._watch.close()
        os.close(self.requests)
        os.close(self.replies)


def _receive_handle(handles: socket.socket) -> int | None:
    """A descriptor of the room's watch, or None where it did not come to that."""
    if not select.select([handles], [], [], START_SECONDS)[0]:
        return None
    with suppress(OSError):
        _, descriptors, *_ = socket.recv_fds(handles, 16, 1)
        return descriptors[0] if descriptors else None
    return None


_nurseries: dict[Enum, Nursery] = {}
_starting = threading.Lock()


def running(way: Enum, start: Callable[[], Nursery]) -> Nursery:
    """The one of this process and that way; `start()` makes it, and again when it has ended."""
    with _starting:
        if way in _nurseries and not _nurseries[way].alive:
            _nurseries.pop(way).close()
        if way not in _nurseries:
            _nurseries[way] = start()
        return _nurseries[way]


def borrow(way: Enum, channel: socket.socket) -> None:
    """Use the nursery that `channel` was lent by, as long as it lives."""
    with _starting:
        _nurseries[way] = LentNursery(channel)


def _forget():
    global _starting
    WatchLine.let_go()
    _starting = threading.Lock()
    for own in _nurseries.values():
        own.forget()
    _nurseries.clear()


@atexit.register
def close() -> None:
    """End this process's nurseries, if it has any."""
    with _starting:
        for own in _nurseries.values():
            own.close()
        _nurseries.clear()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget)
