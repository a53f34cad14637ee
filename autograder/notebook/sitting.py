"""A student's notebook in a room, cell by cell; when the room is lost, a new one takes over."""

import json
import time
from contextlib import contextmanager
from dataclasses import replace

from autograder.judging.check import CannotRunError, Check
from autograder.judging.faults import PYTHON_ENDED, describe_fault
from autograder.judging.verdict import State, Verdict
from autograder.notebook import outputs
from autograder.notebook.blame import Ran, explained, ran, stale
from autograder.protocol import (
    CALL_SECONDS,
    PATIENCE,
    Call,
    Fault,
    FaultKind,
    HandedIn,
    Reply,
    decode_handed_in,
    one_line,
    shortened,
)
from autograder.sandbox.room import Room, RoomLostError, StarvedError, TooLongError

# One slow notebook must not hold up all others. This is processor time; on the clock, a notebook has
# PATIENCE times as long.
NOTEBOOK_SECONDS = 60.0
MISSING = """
import json
from protocol.languages import missing
print(json.dumps(missing()))
"""
LINES = "__import__('autograder').print_lines({id!r})"


class Sitting:
    """A student's notebook in a room, cell by cell; when the room is lost, a new one takes over.

    A new room runs the earlier cells again, but not the cell or the call that ended the last room.
    After NOTEBOOK_SECONDS nothing more is run; the time to start a room does not count. If the
    processor had no time for a call, it is tried once more before it costs points.
    """

    def __init__(self, room=Room.loaded):
        self._new_room = room
        self._room: Room | None = None
        self._used = self._clock = 0.0  # s, in earlier rooms, and while student code ran
        self._ran: list[str] = []
        self._cells: list[Ran] = []  # all of them, those that ended a room too

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self._leave()

    def run(self, source: str, is_students: bool = True) -> list[dict]:
        """The outputs of a cell; an error output where it ends its process.

        is_students: whether it may be to blame for a function that is missing; no sentence about one
        quotes another cell.
        """
        cells = self._cells if is_students else []
        if self._is_over():
            text = f"not run: the notebook had used up its {self._limit():g} s before this cell"
            cells.append(Ran(source, f"TimeoutError: {text}", stopped=True))
            return [outputs.error("TimeoutError", text, [text])]
        try:
            room = self._current()
            with self._timed():
                shown = room.run(source)
        except RoomLostError as error:
            self._leave()
            reason = one_line(str(error)).removeprefix("it ended").lstrip(": ")
            text = "this cell ended Python itself" + (f": {reason}" if reason else "")
            shown = [outputs.error("RoomLostError", text, [text])]
            why = PYTHON_ENDED + (f" ({reason})" if reason else "")
            cells.append(Ran(source, why, stopped=True))
        else:
            self._ran.append(source)
            cells.append(ran(source, shown))
        return shown

    def ask(self, calls: list[Call]) -> list[Reply]:
        """The replies to calls of the student's functions."""
        replies = self._asked(calls)
        if (fault := replies[-1].fault) and fault.kind is FaultKind.STARVED:
            replies[-1:] = self._asked(calls[len(replies) - 1 :])
        last = replies[-1].fault
        if last and last.kind is FaultKind.NO_TOOLS and last.message in self._missing():
            raise CannotRunError(last.message)
        if last and not self._is_over():
            replies[-1] = Reply(fault=explained(calls[0].name, last, self._cells))
        return replies

    def lines_of(self, id: str) -> HandedIn:
        """The lines of a derivation that the notebook's cells handed in, as plain data."""
        printed = [
            str(output.get("text"))
            for output in self.run(LINES.format(id=id))
            if output.get("output_type") == "stream" and output.get("name") == "stdout"
        ]
        given = decode_handed_in("".join(printed))
        return given or HandedIn(problem="The grader could not read these lines.")

    def naming_an_earlier(self, check: Check, verdict: Verdict) -> Verdict:
        """The verdict; if it is on an earlier function than the notebook's last, it says so."""
        earlier = stale(check.name, self._cells)
        if verdict.state not in (State.INCORRECT, State.PARTLY_CORRECT) or earlier is None:
            return verdict
        said = describe_fault(earlier, check.name, check.signature)
        return replace(verdict, next_step=f"{said} {verdict.next_step}".strip())

    def _asked(self, calls: list[Call]) -> list[Reply]:
        try:
            room = None if self._is_over() else self._current()
            if room is not None:
                seconds = NOTEBOOK_SECONDS - self.spent()
                with self._timed():
                    return room.ask(calls, seconds, PATIENCE * NOTEBOOK_SECONDS - self._clock)
            fault = Fault(FaultKind.DIED)
        except TooLongError:
            fault = Fault(FaultKind.TIMED_OUT, f"{CALL_SECONDS:g} s")
        except StarvedError:
            fault = Fault(FaultKind.STARVED, f"{PATIENCE * CALL_SECONDS:g} s")
        except RoomLostError:
            fault = Fault(FaultKind.DIED)
        self._leave()
        if self._is_over():
            text = f"the {self._limit():g} s that the whole notebook has"
            fault = Fault(FaultKind.TIMED_OUT, text)
        return [Reply(fault=fault)]

    def _missing(self) -> list[str]:
        """The tools that are not installed here, asked of a room that has run no student's code."""
        with self._new_room() as room:
            (printed,) = room.run(MISSING)
        return [shortened(line) for line in json.loads(printed["text"])]

    def _current(self) -> Room:
        if self._room is None:
            self._room = self._new_room()
            for source in self._ran:
                if not self._is_over():
                    with self._timed():
                        self._room.run(source)
        return self._room

    def _leave(self) -> None:
        if self._room is not None:
            self._room.close()
            self._used += self._room.used
            self._room = None

    @contextmanager
    def _timed(self):
        start = time.monotonic()
        try:
            yield
        finally:
            self._clock += time.monotonic() - start

    def spent(self) -> float:
        """The processor time of the student's code so far, s."""
        return self._used + (self._room.used if self._room is not None else 0.0)

    def _is_over(self) -> bool:
        return self.spent() >= NOTEBOOK_SECONDS or self._clock >= PATIENCE * NOTEBOOK_SECONDS

    def _limit(self) -> float:
        """The limit that the notebook has reached, the processor's or the clock's, s."""
        of_processor = self.spent() >= NOTEBOOK_SECONDS
        return NOTEBOOK_SECONDS if of_processor else PATIENCE * NOTEBOOK_SECONDS
