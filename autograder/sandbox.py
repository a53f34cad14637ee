"""A room of its own for a student's code: a process that can reach nothing but its own memory.

With bubblewrap the process has no network, no home directory, no course folder, none of this
project's files but the runner, and a read-only system. Such a room is a fork of a warm process
where the kernel allows it, and a process of its own where not. Without bubblewrap (macOS, some
containers) there are limits on time, memory and file size only, and `Room` says so once.
"""

import base64
import json
import logging
import math
import os
import select
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping
from contextlib import suppress
from enum import Enum
from functools import cache
from pathlib import Path

from autograder import warm
from autograder.bubblewrap import ENVIRONMENT, INSIDE, bubblewrapped, has_bubblewrap
from autograder.wall import (
    CALL_SECONDS,
    MOST_NUMBERS,
    Call,
    Reply,
    decode_reply,
    encode_call,
    one_line,
)

log = logging.getLogger(__name__)

START_SECONDS = 60.0
CELL_SECONDS = 10.0
# Of a cell that has a program compiled: Eigen's headers alone take seconds of a busy machine.
BUILD_SECONDS = 30.0
# Over the limit inside by this much, the process is taken to be out of its own control.
GRACE_SECONDS = 3.0
# What a cell may show, and what one call may answer: more than the runner ever sends.
MOST_BYTES = 32 << 20
MOST_VALUES = 1 << 20
MOST_OUTPUTS = 100
BYTES_A_NUMBER = 32


class Way(Enum):
    """How a room is made."""

    WARM = "forked from a warm process, in bubblewrap"
    COLD = "started in bubblewrap"
    NONE = "started without walls"


class RoomLostError(Exception):
    """The process ended, fell silent, or wrote what is no reply; it is gone now."""


class Room:
    """A running sandbox. Use as a context manager; `close` leaves no process behind.

    run(source) gives a cell's outputs, ask(calls) the replies to calls. Both raise RoomLostError
    when the process does not survive them. OSError where the sandbox does not start.

    files: what is laid into the folder in which cells run, by the path in it.
    """

    def __init__(self, way: Way | None = None, files: Mapping[str, bytes] | None = None):
        self.way = way or _best_way()
        self._buffer = bytearray()
        self._process = _start_warm() if self.way is Way.WARM else ColdProcess(self.way)
        os.set_blocking(self._process.requests, False)
        try:
            hello = self._receive(START_SECONDS, MOST_BYTES, MOST_VALUES)
            if not hello.get("ready"):
                self._lost(str(hello.get("refused")))
            if files:
                self._lay(files)
        except RoomLostError as error:
            # Nothing of the student's has run yet.
            raise OSError(f"the sandbox did not start: {error}") from None

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.close()

    def run(self, source: str, seconds: float = CELL_SECONDS) -> list[dict]:
        if "from_file(" in source:
            seconds = max(seconds, BUILD_SECONDS)
        self._send({"run": source, "seconds": seconds})
        message = self._receive(seconds + GRACE_SECONDS, MOST_BYTES, MOST_VALUES)
        outputs = message.get("outputs")
        if not isinstance(outputs, list) or not all(isinstance(out, dict) for out in outputs):
            self._lost("it sent no outputs")
        return outputs[:MOST_OUTPUTS]

    def ask(self, calls: list[Call], seconds: float = math.inf) -> list[Reply]:
        """The replies to calls, up to the first fault. seconds: what they have all together.

        Each call has its own limit, inside and, for code that ignores that, from here.
        """
        ends = time.monotonic() + seconds
        self._send({"ask": [encode_call(call) for call in calls]})
        replies = []
        while len(replies) < len(calls):
            left = min(CALL_SECONDS + GRACE_SECONDS, ends - time.monotonic())
            message = self._receive(left, BYTES_A_NUMBER * MOST_NUMBERS, 4 * MOST_NUMBERS)
            if "reply" not in message:
                self._lost("it sent no reply")
            replies.append(decode_reply(message["reply"]))
            if replies[-1].fault:
                break
        return replies

    @property
    def closed(self) -> bool:
        return self._process.ended

    def close(self) -> None:
        """End the process, and all that it started."""
        self._process.end()

    def _lay(self, files: Mapping[str, bytes]) -> None:
        coded = {name: base64.b64encode(content).decode() for name, content in files.items()}
        self._send({"files": coded})
        failed = self._receive(START_SECONDS, MOST_BYTES, MOST_VALUES).get("failed")
        if failed:
            log.warning("no place in the sandbox for %s", ", ".join(map(one_line, failed)))

    def _send(self, request: dict) -> None:
        left = memoryview(json.dumps(request).encode() + b"\n")
        stdin = self._process.requests
        try:
            while left:
                # A process that does not read must not make the judge wait for ever.
                if not select.select([], [stdin], [], GRACE_SECONDS)[1]:
                    self._lost("it stopped listening")
                left = left[os.write(stdin, left) :]
        except OSError:
            self._lost("it has ended")

    def _receive(self, seconds: float, most_bytes: int, most_values: int) -> dict:
        line = self._read_line(seconds, most_bytes)
        # An empty list is two bytes there and fifty here. Commas in texts count along.
        if line.count(b",") + line.count(b"[") + line.count(b"{") > most_values:
            self._lost("it wrote too much")
        try:
            message = json.loads(line)
            if b"\\ud" in line.lower():
                # Half a surrogate pair is legal in JSON, but no notebook holding one can be saved.
                text = json.dumps(message, ensure_ascii=False).encode(errors="replace")
                message = json.loads(text)
        except (ValueError, RecursionError):
            message = None
        if not isinstance(message, dict):
            self._lost("it wrote what is no reply")
        return message

    def _read_line(self, seconds: float, most_bytes: int) -> bytes:
        deadline = time.monotonic() + seconds
        stdout = self._process.replies
        searched = 0
        while (end := self._buffer.find(b"\n", searched)) < 0:
            searched = len(self._buffer)
            if searched > most_bytes:
                self._lost("it wrote too much")
            left = deadline - time.monotonic()
            if left <= 0 or not select.select([stdout], [], [], left)[0]:
                self._lost(f"no reply within {seconds:g} s")
            chunk = os.read(stdout, 1 << 16)
            if not chunk:
                self._lost("it ended")
            self._buffer += chunk
        line = bytes(self._buffer[:end])
        del self._buffer[: end + 1]
        if len(line) > most_bytes:
            self._lost("it wrote too much")
        return line

    def _lost(self, why: str):
        said = self._process.said()
        innocent = self._process.outlived_its_keeper()
        self.close()
        if innocent:
            raise OSError("the process that keeps the sandboxes ended, and this one with it")
        raise RoomLostError(f"{why}: {said}" if said else why)


class ColdProcess:
    """A room's process, started for it alone. requests, replies: descriptors of its pipes."""

    def __init__(self, way: Way):
        self._folder = tempfile.TemporaryDirectory(prefix="room-")
        start = bubblewrapped("runner.py") if way is Way.COLD else _unwalled(self.folder)
        command, environment = start
        self._process = subprocess.Popen(
            command,
            env=environment,
            cwd=self.folder,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            start_new_session=True,
        )
        self.requests = self._process.stdin.fileno()
        self.replies = self._process.stdout.fileno()

    @property
    def folder(self) -> Path:
        return Path(self._folder.name)

    @property
    def ended(self) -> bool:
        return self._process.returncode is not None

    def said(self) -> str:
        stderr = self._process.stderr
        ready, _, _ = select.select([stderr], [], [], 0)
        return os.read(stderr.fileno(), 4096).decode(errors="replace").strip() if ready else ""

    def outlived_its_keeper(self) -> bool:
        return False

    def end(self) -> None:
        if not self.ended:
            # Without bubblewrap there is no process namespace to take the children along, and they
            # may be there when their parent has ended. The group's number is free only after wait.
            with suppress(ProcessLookupError):
                os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()
        for pipe in (self._process.stdin, self._process.stdout, self._process.stderr):
            pipe.close()
        self._folder.cleanup()


def _unwalled(folder: Path):
    room = folder / ".room"  # apart from what cells write, and what was handed in
    for path, name in INSIDE.items():
        (room / name).parent.mkdir(exist_ok=True, parents=True)
        shutil.copy(path, room / name)
    environment = ENVIRONMENT | {
        name: str(folder) for name in ("HOME", "IPYTHONDIR", "MPLCONFIGDIR", "TMPDIR")
    }
    return [sys.executable, "-I", "-u", str(room / "runner.py")], environment


def _best_way() -> Way:
    if not has_bubblewrap():
        return Way.NONE
    return Way.WARM if _warm_works() else Way.COLD


@cache
def _warm_works() -> bool:
    """Whether rooms can be forked here; a word in the log where not."""
    try:
        with Room(Way.WARM):
            return True
    except OSError as error:
        log.warning("each notebook starts a Python of its own, which takes longer: %s", error)
        return False


def _start_warm() -> warm.WarmProcess:
    return _nursery().start_room()


def _nursery() -> warm.Nursery:
    return warm.nursery(lambda: warm.Nursery(*bubblewrapped("forks.py")))


def lend() -> socket.socket | None:
    """What lets another process `borrow` this one's warm process; None where rooms are not warm."""
    return _nursery().lend() if _best_way() is Way.WARM else None


def borrow(lent: socket.socket | None) -> None:
    if lent is not None:
        warm.borrow(lent)
