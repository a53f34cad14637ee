"""Stops a student's code at its time limit: by signals, or where there are none, as it goes on.

On Windows and in a browser no signal comes. There Python itself looks at the clock, whenever the code
jumps back in a loop or enters a function (`sys.monitoring`, since Python 3.12). Code that waits outside
Python, as in `time.sleep`, is stopped when it comes back.
"""

import math
import signal
import sys
import threading
import time
from collections.abc import Callable
from contextlib import contextmanager
from types import FrameType
from typing import Any

from .waiting import Waiting

# Code that sleeps for ever uses no processor time. So each limit also holds for the time in which the
# code waits, where it is this many times as long.
PATIENCE = 5.0
# Where a busy machine gives the code hardly any processor time, the clock ends it after this many times
# the limit.
FAR = 60.0
LOOKS = 8  # at how long the code has waited, before that limit
# After the first time, since student code may catch that one, s.
AGAIN = 0.5
TOOL = 4  # of the numbers that Python gives to tools, one that no debugger and no profiler has
NO_LIMIT = (
    "This Python cannot stop a function that never ends. If a check does not come back, interrupt the "
    "kernel (the ■ above the notebook). From Python 3.12 on, a check stops it by itself."
)


class TimeLimitError(BaseException):
    """Raised in the student's code at its time limit; no `except Exception` swallows it.

    seconds: the limit. starved: whether it is the clock's limit, as the code used little processor time.
    """

    def __init__(self, seconds: float, starved: bool):
        super().__init__(seconds, starved)
        self.seconds, self.starved = seconds, starved

    def _render_traceback_(self) -> list[str]:
        """What IPython shows. To format all lines takes it so long that the limit would stop that."""
        return [f"TimeoutError: {self.seconds:g} s"]


class Limit:
    """No limit at all; those that are derived from it stop the block.

    error: what stopped the code first, also if the code swallowed it and went on; None for nothing.
    """

    def __init__(self, seconds: float):
        self.seconds = seconds
        self.error: TimeLimitError | None = None

    def __enter__(self) -> "Limit":
        return self

    def __exit__(self, *exception: object) -> None:
        pass


def time_limit(seconds: float) -> Limit:
    """Raise TimeLimitError in the block at its time limit; in a thread, and as NO_LIMIT says, there is
    none.

    The limit is `seconds` of this process's processor time; or PATIENCE times as long in which nothing
    computed, or FAR times as long on the clock, and then the error says that it is starved.
    """
    if threading.current_thread() is not threading.main_thread():
        return Limit(seconds)
    if _has_signals():
        return _BySignals(seconds)
    return _ByLooking(seconds) if _can_look() else Limit(seconds)


def no_limit() -> str:
    """What a student has to know where code cannot be stopped; "" where it can."""
    return "" if _has_signals() or _can_look() else NO_LIMIT


def _has_signals() -> bool:
    return hasattr(signal, "setitimer") and hasattr(signal, "SIGPROF")


def _can_look() -> bool:
    return hasattr(sys, "monitoring")


class _Stopping(Limit):
    """Raises the error while the block runs, and nowhere else."""

    _armed = False
    _looking = False  # a timer may come while the last one is still answered
    _stopped = -math.inf

    def __enter__(self) -> Limit:
        self._thread = threading.get_ident()
        self._begin, self._start = time.process_time(), time.monotonic()
        self._waiting = Waiting()
        self._unreported, sys.unraisablehook = sys.unraisablehook, self._swallowed
        self._traced: list[FrameType] = []
        self._tracing = False
        self._trace = sys.gettrace()
        return self

    def __exit__(self, *exception: object) -> None:
        self._armed = False
        sys.unraisablehook = self._unreported
        self._untrace()

    def _stop(self, starved: bool) -> TimeLimitError:
        far = time.monotonic() - self._start >= FAR * self.seconds
        times = (FAR if far else PATIENCE) if starved else 1.0
        error = TimeLimitError(times * self.seconds, starved)
        self.error = self.error or error
        self._stopped = time.monotonic()
        return error

    def _left(self) -> float:
        """How long the code may still wait, s."""
        far = FAR * self.seconds - (time.monotonic() - self._start)
        return min(PATIENCE * self.seconds - self._waiting.look(), far)

    def _swallowed(self, found: Any) -> None:
        """A destructor lets no error out, and Python would print it. The code that goes on gets it."""
        if not isinstance(found.exc_value, TimeLimitError):
            self._unreported(found)
        elif self._armed:
            self._raise_above(sys._getframe(1))

    def _raise_above(self, frame: FrameType | None) -> None:
        """Raise the error in this frame or one above, or in the next that begins or goes on: what C code
        calls, such as the generator of `all(…)`, is not above its destructors.
        """

        def raise_in(at: FrameType, event: str, found: object) -> None:
            if self._armed and self.error is not None and at.f_code not in _OURS:
                self._untrace()
                raise TimeLimitError(*self.error.args)

        while frame is not None and frame.f_code not in _OURS:
            frame.f_trace_opcodes = True
            frame.f_trace = raise_in
            self._traced.append(frame)
            frame = frame.f_back
        self._tracing = True
        sys.settrace(raise_in)

    def _untrace(self) -> None:
        if self._tracing:
            self._tracing = False
            sys.settrace(self._trace)
            for frame in self._traced:
                frame.f_trace = None
                frame.f_trace_opcodes = False
            self._traced.clear()


class _BySignals(_Stopping):
    def __enter__(self) -> Limit:
        super().__enter__()
        self._handlers = {
            number: signal.signal(number, self._came) for number in (signal.SIGPROF, signal.SIGALRM)
        }
        self._step = max(PATIENCE * self.seconds / LOOKS, 0.001)
        # A limit around this one has set the same timers.
        self._timers = {
            timer: signal.setitimer(timer, first, AGAIN)
            for timer, first in (
                (signal.ITIMER_PROF, self.seconds),
                (signal.ITIMER_REAL, self._step),
            )
        }
        self._armed = True
        return self

    def __exit__(self, *exception: object) -> None:
        self._armed = False
        for timer in self._timers:
            signal.setitimer(timer, 0)
        super().__exit__()
        for number, handler in self._handlers.items():
            signal.signal(number, handler)
        for timer, (left, again) in self._timers.items():
            if left:
                clock = timer == signal.ITIMER_REAL
                since = (
                    time.monotonic() - self._start if clock else time.process_time() - self._begin
                )
                signal.setitimer(timer, max(left - since, 0.001), again)

    def _came(self, number: int, frame: FrameType | None) -> None:
        if not self._armed or (frame is not None and frame.f_code in _OURS):
            return
        # Where the code had no processor for a while, both signals come at once, and the second would be
        # raised on the way out of the block.
        if time.monotonic() - self._stopped < AGAIN / 2:
            return
        if frame is not None and frame.f_code in _BLOCKS:
            signal.setitimer(signal.ITIMER_PROF, 0.001, AGAIN)
            return
        left = self.seconds - (time.process_time() - self._begin)
        if left <= 0:
            raise self._stop(starved=False)
        if number == signal.SIGPROF:  # a timer of the student's own
            signal.setitimer(signal.ITIMER_PROF, max(left, 0.001), AGAIN)
            return
        if self._looking:
            return
        self._looking = True
        try:
            left = self._left()
        finally:
            self._looking = False
        if left <= 0:
            raise self._stop(starved=True)
        signal.setitimer(signal.ITIMER_REAL, max(min(self._step, left), 0.001), AGAIN)


class _ByLooking(_Stopping):
    def __enter__(self) -> Limit:
        super().__enter__()
        monitoring = sys.monitoring  # type: ignore[attr-defined]  # mypy reads this for Python 3.11
        self._own = monitoring.get_tool(TOOL) is None
        if self._own:
            monitoring.use_tool_id(TOOL, "armdyn")
        kinds = monitoring.events
        events = (kinds.JUMP, kinds.PY_START, kinds.PY_RESUME)
        self._before = monitoring.get_events(TOOL)
        # No code uses more processor time than has passed.
        self._due = self._start + self.seconds
        self._callbacks = {
            event: monitoring.register_callback(TOOL, event, self._look) for event in events
        }
        self._armed = True
        monitoring.set_events(TOOL, sum(events))
        return self

    def __exit__(self, *exception: object) -> None:
        self._armed = False
        monitoring = sys.monitoring  # type: ignore[attr-defined]
        monitoring.set_events(TOOL, self._before)
        for event, callback in self._callbacks.items():
            monitoring.register_callback(TOOL, event, callback)
        if self._own:
            monitoring.free_tool_id(TOOL)
        super().__exit__()

    def _look(self, code: Any, *_: object) -> None:
        now = time.monotonic()
        if now < self._due or not self._armed or code in _OURS or code in _BLOCKS:
            return
        if threading.get_ident() != self._thread:
            return
        left = self.seconds - (time.process_time() - self._begin)
        waited = self._left()
        if left > 0 and waited > 0:
            self._due = now + max(min(left, waited), 0.001)
            return
        self._due = now + AGAIN
        raise self._stop(starved=left > 0)

    def _raise_above(self, frame: FrameType | None) -> None:
        self._due = 0.0


def _codes(*functions: Callable) -> frozenset:
    return frozenset(function.__code__ for function in functions)


# No error is raised in these, so that they always end.
_OURS = _codes(
    _BySignals.__enter__,
    _BySignals.__exit__,
    _BySignals._came,
    _ByLooking.__enter__,
    _ByLooking.__exit__,
    _Stopping.__exit__,
    _Stopping._untrace,
    _Stopping._swallowed,
    _Stopping._raise_above,
)
# Nor in these: where a limit is part of a block that a generator makes, its own exit comes after them.
_BLOCK = type(contextmanager(iter)(()))
_BLOCKS = _codes(_BLOCK.__enter__, _BLOCK.__exit__)
