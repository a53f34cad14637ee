"""A student's notebook in a room, cell by cell; when the room is lost, a new one takes over."""

import json
from contextlib import contextmanager
from dataclasses import replace

from autograder.judging.check import CannotRunError, Check
from autograder.judging.faults import NOT_RUN, PYTHON_ENDED, describe_fault
from autograder.judging.verdict import State, Verdict
from autograder.notebook import outputs
from autograder.notebook.blame import Ran, explained, ran, stale
from autograder.notebook.budget import (
    AGAIN,
    CALLS_SECONDS,
    GIVEN_SECONDS,
    OWN_SECONDS,
    Budget,
    cell,
)
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

MISSING = """
import json
from protocol.languages import missing
print(json.dumps(missing()))
"""
LINES = "__import__('autograder').print_lines({id!r})"


class Sitting:
    """A student's notebook in a room, cell by cell; when the room is lost, a new one takes over.

    A new room runs the earlier cells again, but not the cell or the call that ended the last room.
    Nothing is run whose `budget` is used up; the time to start a room does not count. If the processor
    had no time for a call, it is tried once more before it costs points.

    uncertain: what was stopped though it may have had too little of the processor, in words.
    """

    def __init__(self, room=Room.loaded):
        self._new_room = room
        self._room: Room | None = None
        self._used = self._idle = 0.0  # s, in earlier rooms
        self._own = Budget("the student's own cells", OWN_SECONDS)
        self._given = Budget("the assignment's cells", GIVEN_SECONDS)
        self._calls: dict[str, Budget] = {}
        self._ran: list[tuple[str, bool]] = []
        self._cells: list[Ran] = []  # all of them, those that ended a room too
        self.uncertain: list[str] = []

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self._leave()

    def seconds(self) -> float:
        """The processor time so far, s."""
        return self._spent()[0]

    def run(self, source: str, own: bool = False, is_students: bool = True) -> list[dict]:
        """The outputs of a cell; an error output where it ends its process.

        own: whether it is the student's, beside the assignment's. is_students: whether it may be to
        blame for a function that is missing; no sentence about one quotes another cell.
        """
        cells = self._cells if is_students else []
        budget = self._budget(own)
        if budget.is_over:
            text = f"{NOT_RUN}{budget.spent()}"
            if budget.is_over_by_waiting:
                self._doubt(cell(source))
            cells.append(Ran(source, f"TimeoutError: {text}", stopped=True))
            return [outputs.error("TimeoutError", text, [text])]
        try:
            room = self._current()
            with self._charged(budget, cell(source)):
                shown = room.run(source)
        except RoomLostError as error:
            self._leave()
            reason = one_line(str(error)).removeprefix("it ended").lstrip(": ")
            text = "this cell ended Python itself" + (f": {reason}" if reason else "")
            if isinstance(error, StarvedError):
                self._doubt(cell(source))
            shown = [outputs.error("RoomLostError", text, [text])]
            why = PYTHON_ENDED + (f" ({reason})" if reason else "")
            cells.append(Ran(source, why, stopped=True))
        else:
            self._ran.append((source, own))
            cells.append(ran(source, shown))
            if any(output.get("starved") for output in shown):
                self._doubt(cell(source))
        return shown

    def ask(self, calls: list[Call]) -> list[Reply]:
        """The replies to calls of the student's functions."""
        replies = self._asked(calls)
        if (fault := replies[-1].fault) and fault.kind is FaultKind.STARVED:
            replies[-1:] = self._asked(calls[len(replies) - 1 :])
        last = replies[-1].fault
        if last and last.kind is FaultKind.STARVED:
            self._doubt(calls[0].name)
        if last and last.kind is FaultKind.NO_TOOLS and last.message in self._missing():
            raise CannotRunError(last.message)
        if last and not self._of_calls(calls).is_over:
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
        budget = self._of_calls(calls)
        try:
            room = None if budget.is_over else self._current()
            if room is not None:
                with self._charged(budget, f"the calls of {calls[0].name}"):
                    return room.ask(calls, budget.left, budget.idle_left)
            fault = Fault(FaultKind.DIED)
        except TooLongError:
            fault = Fault(FaultKind.TIMED_OUT, f"{CALL_SECONDS:g} s")
        except StarvedError:
            fault = Fault(FaultKind.STARVED, f"{PATIENCE * CALL_SECONDS:g} s")
        except RoomLostError:
            fault = Fault(FaultKind.DIED)
        self._leave()
        if budget.is_over_by_waiting:
            text = f"the {PATIENCE * budget.seconds:g} s that all its calls have together"
            fault = Fault(FaultKind.STARVED, text)
        elif budget.is_over:
            text = f"the {budget.seconds:g} s that all its calls have together"
            fault = Fault(FaultKind.TIMED_OUT, text)
        return [Reply(fault=fault)]

    def _budget(self, own: bool) -> Budget:
        return self._own if own else self._given

    def _of_calls(self, calls: list[Call]) -> Budget:
        name = calls[0].name
        return self._calls.setdefault(name, Budget(f"the calls of {name}", CALLS_SECONDS))

    def _doubt(self, what: str) -> None:
        if what not in self.uncertain:
            self.uncertain.append(what)

    def _missing(self) -> list[str]:
        """The tools that are not installed here, asked of a room that has run no student's code."""
        with self._new_room() as room:
            (printed,) = room.run(MISSING)
        return [shortened(line) for line in json.loads(printed["text"])]

    def _current(self) -> Room:
        if self._room is None:
            self._room = self._new_room()
            for source, own in self._ran:
                if not self._budget(own).is_over:
                    with self._charged(self._budget(own), AGAIN):
                        self._room.run(source)
        return self._room

    def _leave(self) -> None:
        if self._room is not None:
            self._room.close()
            self._used += self._room.used
            self._idle += self._room.idle
            self._room = None

    @contextmanager
    def _charged(self, budget: Budget, what: str):
        used, idle = self._spent()
        try:
            yield
        finally:
            now, idle_now = self._spent()
            budget.take(what, now - used, idle_now - idle)

    def _spent(self) -> tuple[float, float]:
        here = (self._room.used, self._room.idle) if self._room is not None else (0.0, 0.0)
        return self._used + here[0], self._idle + here[1]
