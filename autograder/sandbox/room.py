"""Runs one notebook's code in a room: a process that can reach nothing but its own memory.

`ways.py` says what keeps the process apart, and how it is started.

`clock.py` says what its limits on time count.
"""

import base64
import json
import logging
import math
import os
import select
import sys
import time
from collections.abc import Mapping
from functools import cache
from typing import NoReturn

from autograder.protocol import (
    CALL_SECONDS,
    MOST_NUMBERS,
    PATIENCE,
    Call,
    Reply,
    decode_reply,
    encode_call,
    one_line,
)
from autograder.sandbox.clock import Clock, RoomLostError, StarvedError, TooLongError
from autograder.sandbox.ways import Shared, Way, started, warm_process_of, ways_here

log = logging.getLogger(__name__)

START_SECONDS = 120.0
CELL_SECONDS = 10.0
# The programs that a cell starts get this many times as long: to compile Eigen's headers takes seconds.
STARTED = 3.0
# Code should stop at its limit inside the room. If it runs on for this long, the room is ended.
GRACE_SECONDS = 3.0
# How often the judge asks a silent room what it has used.
LOOK_SECONDS = 0.25
# Most notebooks import these; where the room's process is new, the first cell must not pay for it.
LOAD = "import matplotlib.pyplot, sympy\ndel matplotlib, sympy"
# Limits on what a cell may show and a call may answer; the runner never sends as much.
MOST_BYTES = 32 << 20
MOST_VALUES = 1 << 20
MOST_OUTPUTS = 110
BYTES_A_NUMBER = 32


class Room:
    """A running sandbox. Use as a context manager; `close` leaves no process behind.

    run(source) gives a cell's outputs, ask(calls) the replies to calls. Both raise RoomLostError
    when the process does not survive them, and leave behind no process that the student's code
    started. OSError if the sandbox does not start.

    files: put into the folder in which cells run, by their path in it.
    """

    def __init__(self, way: Way | None = None, files: Mapping[str, bytes] | None = None):
        self.way = way or _best_way()
        self._buffer = bytearray()
        self._process = started(self.way)
        os.set_blocking(self._process.requests, False)
        self._clock = Clock(self._process)
        try:
            hello = self._receive(math.inf, START_SECONDS, MOST_BYTES, MOST_VALUES)
            if not hello.get("ready"):
                self._lost(str(hello.get("refused")))
            if files:
                self._lay(files)
        except RoomLostError as error:
            # Nothing of the student's has run yet.
            raise OSError(f"the sandbox did not start: {error}") from None
        self._clock.begin()

    @classmethod
    def loaded(cls, files: Mapping[str, bytes] | None = None) -> "Room":
        """A room that has loaded what notebooks import; no notebook pays for the time."""
        room = cls()
        try:
            if not room.way.warm:
                room.run(LOAD, START_SECONDS)
            if files:
                room._lay(files)
        except RoomLostError as error:
            raise OSError(f"the sandbox did not start: {error}") from None
        room._clock.begin()
        return room

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.close()

    @property
    def used(self) -> float:
        """The processor time of all processes of the room, s, when it was last asked for."""
        return self._clock.counted

    @property
    def idle(self) -> float:
        """How long, while the room had something to do, no process of it computed or was ready to, s."""
        return self._clock.waited

    def run(self, source: str, seconds: float = CELL_SECONDS) -> list[dict]:
        """Run a cell, and return its outputs.

        seconds: of processor time, for the cell; with the programs it starts, STARTED times as many.
        """
        idle = PATIENCE * seconds + GRACE_SECONDS
        most = STARTED * seconds + GRACE_SECONDS
        with self._clock.working():
            self._send({"run": source, "seconds": seconds})
            message = self._receive(most, idle, MOST_BYTES, MOST_VALUES)
            outputs = message.get("outputs")
            if not isinstance(outputs, list) or not all(isinstance(out, dict) for out in outputs):
                self._lost("it sent no outputs")
            self._sweep()
        return outputs[:MOST_OUTPUTS]

    def ask(
        self, calls: list[Call], seconds: float = math.inf, idle: float = math.inf
    ) -> list[Reply]:
        """The replies to calls, up to the first fault.

        seconds, idle: the processor time and the time of waiting for all of them together. Each call
        also has limits of its own, inside the room and, for code that ignores those, here.
        """
        replies: list[Reply] = []
        with self._clock.working():
            clock = self._clock
            ends, most = clock.idle + idle, clock.used + seconds
            self._send({"ask": [encode_call(call) for call in calls]})
            looked = time.monotonic()
            while len(replies) < len(calls):
                # Quick replies leave no silence in which to look.
                if time.monotonic() - looked > LOOK_SECONDS:
                    clock.look()
                    looked = time.monotonic()
                if clock.used > most:
                    self._lost(f"no reply within {seconds:g} s of processor time", TooLongError)
                if clock.idle > ends:
                    self._lost(f"no reply within {max(idle, 0):g} s", StarvedError)
                message = self._receive(
                    min(CALL_SECONDS + GRACE_SECONDS, most - clock.used),
                    min(PATIENCE * CALL_SECONDS + GRACE_SECONDS, ends - clock.idle),
                    BYTES_A_NUMBER * MOST_NUMBERS,
                    4 * MOST_NUMBERS,
                )
                if "reply" not in message:
                    self._lost("it sent no reply")
                replies.append(decode_reply(message["reply"]))
                if replies[-1].fault:
                    break
            self._sweep()
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
        failed = self._receive(math.inf, START_SECONDS, MOST_BYTES, MOST_VALUES).get("failed")
        if failed:
            log.warning(
                "these files could not be put into the sandbox: %s",
                ", ".join(map(one_line, failed)),
            )

    def _send(self, request: dict) -> None:
        left = memoryview(json.dumps(request).encode() + b"\n")
        stdin = self._process.requests
        over = None
        try:
            while left:
                if select.select([], [stdin], [], LOOK_SECONDS)[1]:
                    left = left[os.write(stdin, left) :]
                    continue
                # A process that does not read must not make the judge wait for ever.
                over = over or self._clock.over(GRACE_SECONDS, GRACE_SECONDS)
                if over():
                    self._lost("it stopped listening")
        except OSError:
            self._lost("it has ended")

    def _sweep(self) -> None:
        """End what the student's code started; if that fails, end the room."""
        if not self._clock.look("sweep"):
            self._lost("it left processes behind")

    def _receive(self, seconds: float, idle: float, most_bytes: int, most_values: int) -> dict:
        line = self._read_line(seconds, idle, most_bytes)
        # An empty list takes two bytes in JSON and fifty in memory. Commas in texts are counted, too.
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
            self._lost("it wrote something that is not a reply")
        return message

    def _read_line(self, seconds: float, idle: float, most_bytes: int) -> bytes:
        stdout = self._process.replies
        searched, over = 0, None
        while (end := self._buffer.find(b"\n", searched)) < 0:
            searched = len(self._buffer)
            if searched > most_bytes:
                self._lost("it wrote too much")
            if not select.select([stdout], [], [], LOOK_SECONDS)[0]:
                # Between calls nobody asks for the time used, so that this call's time starts here.
                over = over or self._clock.over(seconds, idle)
                kind = over()
                if kind is TooLongError:
                    self._lost(f"no reply within {seconds:g} s of processor time", kind)
                if kind is not None:
                    self._lost(f"no reply within {max(idle, 0):g} s", kind)
                continue
            chunk = os.read(stdout, 1 << 16)
            if not chunk:
                self._lost("it ended")
            self._buffer += chunk
        line = bytes(self._buffer[:end])
        del self._buffer[: end + 1]
        if len(line) > most_bytes:
            self._lost("it wrote too much")
        return line

    def _lost(self, why: str, kind: type[RoomLostError] = RoomLostError) -> NoReturn:
        reason = self._process.why_ended()
        innocent = self._process.lost_its_warm_process()
        self.close()
        if innocent:
            raise OSError("the process that starts the sandboxes ended, and this sandbox with it")
        raise kind(f"{why}: {reason}" if reason else why)


def _best_way() -> Way:
    warm, cold = ways_here()
    return warm if _works(warm) else cold


@cache
def _works(way: Way) -> bool:
    """Whether rooms can be forked this way here; if not, a line in the log says so."""
    if sys.platform != "linux":
        return False
    try:
        with Room(way):
            return True
    except OSError as error:
        log.warning("each notebook has to start its own Python, which takes longer: %s", error)
        return False


def share() -> Shared | None:
    """This process's warm process, for others to use; None if rooms are not warm."""
    way = _best_way()
    return warm_process_of(way) if way.warm else None
