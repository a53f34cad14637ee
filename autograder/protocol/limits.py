"""Stops a student's code at its time limit: by signals, or where there are none, as it goes on.

On Windows and in a browser no signal comes. There Python itself looks at the clock, whenever the code
jumps back in a loop or enters a function (`sys.monitoring`, since Python 3.12). Code that waits outside
Python, as in `time.sleep`, is stopped when it comes back.
"""

import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext

# Code that sleeps for ever uses no processor time, and on a busy machine honest code gets little. So
# each limit holds on the clock as well, where it is this many times as long.
PATIENCE = 5.0
# After the first time, since student code may catch that one, s.
AGAIN = 0.5
TOOL = (
    4  # among the numbers that Python gives to tools, one that is no debugger's and no profiler's
)
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


def time_limit(seconds: float) -> AbstractContextManager[None]:
    """Raise TimeLimitError in the block at its time limit; in a thread, and as NO_LIMIT says, there is
    none.

    The limit is `seconds` of this process's processor time, or PATIENCE times as long on the clock.
    """
    if threading.current_thread() is not threading.main_thread():
        return nullcontext()
    if _has_signals():
        return _by_signals(seconds)
    return _by_looking(seconds) if _can_look() else nullcontext()


def no_limit() -> str:
    """What a student has to know where code cannot be stopped; "" where it can."""
    return "" if _has_signals() or _can_look() else NO_LIMIT


def _has_signals() -> bool:
    return hasattr(signal, "setitimer") and hasattr(signal, "SIGPROF")


def _can_look() -> bool:
    return hasattr(sys, "monitoring")


@contextmanager
def _by_signals(seconds: float) -> Iterator[None]:
    begin = time.process_time()

    def stop(signum, frame):
        # Code that swallowed the processor's limit may still run at the clock's.
        if signum == signal.SIGPROF or time.process_time() - begin >= seconds:
            raise TimeLimitError(seconds, starved=False)
        raise TimeLimitError(PATIENCE * seconds, starved=True)

    def unraisable(hooked):
        # It fell into a destructor, which lets none out; the next one comes in half a second.
        if not isinstance(hooked.exc_value, TimeLimitError):
            of_destructors(hooked)

    of_destructors, sys.unraisablehook = sys.unraisablehook, unraisable
    of_processor = signal.signal(signal.SIGPROF, stop)
    of_clock = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds, AGAIN)
    signal.setitimer(signal.ITIMER_REAL, PATIENCE * seconds, AGAIN)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGPROF, of_processor)
        signal.signal(signal.SIGALRM, of_clock)
        sys.unraisablehook = of_destructors


@contextmanager
def _by_looking(seconds: float) -> Iterator[None]:
    monitoring = sys.monitoring  # type: ignore[attr-defined]  # mypy reads this for Python 3.11
    own = monitoring.get_tool(TOOL) is None
    if own:
        monitoring.use_tool_id(TOOL, "armdyn")
    kinds = monitoring.events
    events = (kinds.JUMP, kinds.PY_START, kinds.PY_RESUME)
    before = monitoring.get_events(TOOL)
    look = _looking(seconds)
    earlier = [monitoring.register_callback(TOOL, event, look) for event in events]
    monitoring.set_events(TOOL, sum(events))
    try:
        yield
    finally:
        monitoring.set_events(TOOL, before)
        for event, callback in zip(events, earlier, strict=True):
            monitoring.register_callback(TOOL, event, callback)
        if own:
            monitoring.free_tool_id(TOOL)


def _looking(seconds: float) -> Callable[..., None]:
    """What Python calls while the code goes on."""
    begin, start = time.process_time(), time.monotonic()
    due = start + seconds  # no code uses more processor time than has passed

    def look(*_: object) -> None:
        nonlocal due
        now = time.monotonic()
        if now < due:
            return
        used, passed = time.process_time() - begin, now - start
        if used < seconds and passed < PATIENCE * seconds:
            due = now + max(min(seconds - used, PATIENCE * seconds - passed), 0.001)
            return
        due = now + AGAIN
        if used >= seconds:
            raise TimeLimitError(seconds, starved=False)
        raise TimeLimitError(PATIENCE * seconds, starved=True)

    return look
