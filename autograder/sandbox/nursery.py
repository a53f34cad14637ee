"""Starts the warm process, which has loaded what notebooks import, and lets it fork rooms.

A grader process has one warm process, which starts with the first room and ends with the grader,
however that ends: it reads a socket whose other end is here, and stops when that is closed. A grader
may share this end with the processes that work for it.
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
    """A running warm process. `start_room` forks a room from it; OSError if that fails.

    command, environment: what starts it.
    """

    def __init__(self, command: list[str], environment: dict[str, str]):
        self._lock = threading.Lock()
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115  closed in close
        self._channel, inside = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with inside:
            self._process = subprocess.Popen(
                command,
                env=environment,
                cwd="/",
                stdin=inside.fileno(),
                stdout=subprocess.DEVNULL,
                stderr=self._errors,
                start_new_session=True,
            )
        if not select.select([self._channel], [], [], START_SECONDS)[0] or not self._read_ready():
            text = os.pread(self._errors.fileno(), 4096, 0).decode(errors="replace").strip()
            self.close()
            raise OSError(f"the warm process did not start: {text[-300:]}")

    def _read_ready(self) -> bool:
        with suppress(OSError):
            return self._channel.recv(16) == b"ready"
        return False

    @property
    def alive(self) -> bool:
        with self._lock:
            return self._process.poll() is None

    def answers(self) -> bool:
        """Whether it answers: while it is ending, it no longer does, though it is still `alive`."""
        with self._lock, suppress(OSError):
            self._channel.send(b"alive?")
            if select.select([self._channel], [], [], END_SECONDS)[0]:
                return self._channel.recv(16) == b"alive"
        return False

    def start_room(self, folder: str = "") -> tuple[int, int, socket.socket]:
        """Fork a room, and return descriptors for its requests and replies, and a socket to its watch.

        folder: where its cells run, if it has no walls and so no /tmp of its own.
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

    def share(self) -> socket.socket:
        """A copy of this end of the socket, from which another process makes a `SharedNursery`."""
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
            self._errors.close()

    def forget(self) -> None:
        """Close this end of the socket in a fork of the grader, so that the warm process can end."""
        self._channel.close()
        self._process.returncode = 0  # the child of another process, so that nobody warns of it


class SharedNursery(Nursery):
    """Another process's nursery, through a copy of its socket; `close` closes only that copy."""

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
    """The judge's end of the line to a room's watch; the room lives as long as it is open.

    A fork of the judge closes its copy, so that the room ends when the judge does.
    """

    _open: ClassVar[weakref.WeakSet] = weakref.WeakSet()

    def __init__(self, line: socket.socket):
        self._line, self._received, self._reason = line, b"", ""
        WatchLine._open.add(self)

    def ask(self, request: str, seconds: float) -> tuple[float, float] | None:
        """The processor time and the idle time that the watch answers with, s; None if it has ended or
        is silent.
        """
        with suppress(OSError):
            self._line.sendall(request.encode() + b"\n")
        deadline = time.monotonic() + seconds
        while (line := self._read_line(deadline - time.monotonic())) is not None:
            word, *numbers = line.split(" ")
            if word == request:  # not a late answer to another request
                used, idle = map(float, numbers)
                return used, idle
        return None

    def reason(self) -> str:
        """Why the watch has ended the room; "" if it has not."""
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
    """One room's processes. requests, replies: descriptors, like those of a subprocess's pipes.

    nursery: it forks the room. folder: where the cells run, as in `start_room`.
    """

    def __init__(self, nursery: Nursery, folder: str = ""):
        self._nursery = nursery
        self.requests, self.replies, line = nursery.start_room(folder)
        self._handle = _receive_handle(line)
        self._watch = WatchLine(line)
        self.ended = False

    def ask_watch(self, request: str, seconds: float) -> tuple[float, float] | None:
        return self._watch.ask(request, seconds)

    def why_ended(self) -> str:
        return self._watch.reason()

    def lost_its_warm_process(self) -> bool:
        """Whether the warm process ended and took this room with it."""
        return not self._nursery.answers()

    def end(self) -> None:
        """Kill the room's watch and wait for it; behind walls, the kernel ends all others with it."""
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
    """A descriptor of the room's watch, or None if the watch did not start."""
    if not select.select([handles], [], [], START_SECONDS)[0]:
        return None
    with suppress(OSError):
        _, descriptors, *_ = socket.recv_fds(handles, 16, 1)
        return descriptors[0] if descriptors else None
    return None


_nurseries: dict[Enum, Nursery] = {}
_starting = threading.Lock()


def running(way: Enum, start: Callable[[], Nursery]) -> Nursery:
    """This process's nursery for rooms of this way; `start()` makes one if there is none alive."""
    with _starting:
        if way in _nurseries and not _nurseries[way].alive:
            _nurseries.pop(way).close()
        if way not in _nurseries:
            _nurseries[way] = start()
        return _nurseries[way]


def use_shared(way: Enum, channel: socket.socket) -> None:
    """Use another process's nursery, through the `channel` that it shared, as long as it lives."""
    with _starting:
        _nurseries[way] = SharedNursery(channel)


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
