"""Talks to a running program that answers numbers with numbers.

A message is a count and then that many numbers, all as little-endian doubles, so that each arrives
as it was sent. An answer opens with the eight bytes `numbers:`; whatever the program printed before
them is text and is kept apart, so that a forgotten print does no harm. The program reads the whole
of a request before it answers, and ends when its input does.
"""

import contextlib
import signal
import subprocess
import tempfile
import threading
import time

import numpy as np

from . import processes

MARK = b"numbers:"
DOUBLE = np.dtype("<f8")
# More text than this before an answer is a program that will not answer.
MOST_TEXT = 1 << 20
SHOWN = 2000


class ProgramError(RuntimeError):
    """A program ended, hung or wrote something other than an answer; the message quotes its output."""


class Conversation:
    """A program that is started once and then answers requests; a context manager that ends it.

    command: its words. folder: where it runs; by default here. seconds: the limit for each answer;
    for the first one, together with the start. environment: by default this process's own.
    patience: if more than 1, `seconds` limits the processor time where the system counts it, and
    the limit on the clock is this many times as long.

    late: whether an answer took too long. starved: whether that was by the clock alone.
    """

    def __init__(
        self, command, folder=None, seconds: float = 60, environment=None, patience: float = 1.0
    ):
        self.seconds, self.patience = seconds, patience
        self.late = self.starved = False
        self._printed = bytearray()
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 - closed with the conversation
        pipe = subprocess.PIPE
        try:
            self._process = processes.start(
                command, cwd=folder, env=environment, stdin=pipe, stdout=pipe, stderr=self._errors
            )
        except OSError as error:
            self._errors.close()
            raise ProgramError(f"the program does not start: {error}") from error
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._stdin, self._stdout = self._process.stdin, self._process.stdout

    def ask(self, numbers, at_most: int) -> np.ndarray:
        """The program's answer to these numbers, an array of at most so many.

        Raises ProgramError where the program ends, takes more than `seconds`, or writes what is no
        answer; the conversation is over then.
        """
        if self._process.returncode is not None:
            raise ProgramError("the program has ended")
        numbers = np.asarray(numbers, DOUBLE).ravel()
        del self._printed[:-SHOWN]  # only the text before this answer counts
        answered = threading.Event()
        arguments = (answered, processes.processor_seconds(self._process))
        threading.Thread(target=self._watch, args=arguments, daemon=True).start()
        try:
            with contextlib.suppress(OSError):  # reading its output shows that it has ended
                self._stdin.write(np.array([numbers.size], DOUBLE).tobytes())
                self._stdin.write(numbers.tobytes())
                self._stdin.flush()
            answer = self._answer(at_most)
        except BaseException:  # an interrupt too: half an answer would be read as the next
            self.close()
            raise
        finally:
            answered.set()
        return answer

    @property
    def ended(self) -> bool:
        """Whether the program has ended, by itself or not."""
        return self._process.poll() is not None

    def text(self) -> str:
        """The text that the program has written so far, to its output and then its errors."""
        self._errors.seek(0)
        text = bytes(self._printed) + self._errors.read()
        return text.decode(errors="replace").strip()

    def close(self) -> None:
        """End the program and all that it started."""
        if self._process.returncode is None:
            processes.end(self._process)
        for stream in (self._stdin, self._stdout):
            with contextlib.suppress(OSError):
                stream.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
        self._errors.close()

    def _watch(self, answered, used_before):
        """End the program if its answer takes too long."""
        seconds, deadline = self.seconds, time.monotonic() + self.patience * self.seconds
        wait = seconds
        while not answered.wait(wait):
            used = processes.processor_seconds(self._process)
            left = deadline - time.monotonic()
            wait = left
            if used is not None and used_before is not None:
                wait = min(left, used_before + seconds - used)
            if wait <= 0:
                self.late, self.starved = True, self.patience > 1 and left <= 0
                processes.end(self._process)
                return
            wait = max(wait, 0.01)

    def _answer(self, at_most):
        mark = bytearray(self._read(len(MARK)))
        while mark != MARK:
            self._printed.append(mark.pop(0))
            if len(self._printed) > MOST_TEXT:
                raise ProgramError(f"the program wrote text instead of an answer: {self._shown()}")
            mark += self._read(1)
        (count,) = np.frombuffer(self._read(DOUBLE.itemsize), DOUBLE)
        if not 0 <= count <= at_most or count != int(count):
            raise ProgramError(f"the program gave {count:g} numbers; at most {at_most} are allowed")
        return np.frombuffer(self._read(int(count) * DOUBLE.itemsize), DOUBLE)

    def _read(self, size):
        found = self._stdout.read(size)
        if len(found) == size:
            return found
        self._printed += found
        processes.end(self._process, grace=1)
        if self.late:
            raise ProgramError(f"no answer within {self.seconds:g} s{self._quoted()}")
        raise ProgramError(f"the program ended with {self._status()}{self._quoted()}")

    def _status(self):
        status = self._process.returncode
        with contextlib.suppress(ValueError):
            return signal.Signals(-status).name if status < 0 else f"exit status {status}"
        return f"signal {-status}"

    def _quoted(self):
        return f": {shown}" if (shown := self._shown()) else ""

    def _shown(self):
        text = self.text()
        return text if len(text) <= SHOWN else f"…{text[-SHOWN:]}"
