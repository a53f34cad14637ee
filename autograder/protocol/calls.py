"""Calls a student's function, and writes calls and replies as messages."""

import difflib
import sys
import traceback
import warnings
from collections.abc import Callable, Iterator, Mapping, MutableMapping
from contextlib import contextmanager
from dataclasses import dataclass, replace

import numpy as np

from . import causes, riddles
from .arguments import changed, real
from .limits import PATIENCE, Limit, TimeLimitError, time_limit
from .own_code import is_left_open, line_of, takes
from .readings import (
    MOST_NUMBERS,
    FaultKind,
    NotNumbersError,
    evaluate,
    is_finite,
    read_numbers,
    read_parts,
)
from .waiting import Stopwatch
from .words import shortened

# Of the processor's time. A browser's Python is slower, and knows only the time that passes.
CALL_SECONDS = 8.0 if sys.platform == "emscripten" else 2.0
# A reply with two answers must fit where the largest answer does; this is more than any answer has.
MOST_TWICE = MOST_NUMBERS // 10
MOST_CHANGES = 50
# Where a number came up that is not finite is found out by a second call, if the first was quicker, s.
QUICK = 0.5
# Faults that another call need not have.
GO_ON_AFTER = (FaultKind.RAISED, FaultKind.NOTHING, FaultKind.NOT_NUMBERS)


@dataclass(frozen=True)
class Fault:
    """A call that gave no numbers: what went wrong, and the student's line where it did.

    riddle: what the error means, where it is in the table.
    """

    kind: FaultKind
    message: str = ""
    line: str = ""
    riddle: riddles.Riddle | None = None


@dataclass(frozen=True)
class Call:
    """One call of a student's function.

    args: floats, arrays, namespaces and tuples of them, or the stand-ins of `arguments`. at: points,
    each a mapping from symbol to number, at which the SymPy expression that comes back is evaluated;
    the reply then holds one value a point. parts: whether the function returns several things at once,
    named or in order; the reply then does too. truth: whether it returns True or False, which the reply
    holds as 1 or 0. without: the functions of the student's that cannot be called meanwhile.
    """

    name: str
    args: tuple
    at: tuple[Mapping[str, float], ...] = ()
    parts: bool = False
    truth: bool = False
    without: tuple[str, ...] = ()


@dataclass(frozen=True)
class Reply:
    """The numbers that a call gave, or the fault because of which it gave none.

    value: a float array; dicts and lists of arrays where the call asks for parts.
    changed: each argument that the call changed: its place, and the name in a namespace or "".
    again: what a second call gave, with the arguments as the first call had changed them. caret:
    whether the function uses ^, which is no power. cause: where a number came up that is not finite.
    takes: the function's arguments by the names that its first line gives them; () if it is not Python.
    """

    value: np.ndarray | dict | list | None = None
    fault: Fault | None = None
    changed: tuple[tuple[int, str], ...] = ()
    again: "Reply | None" = None
    caret: bool = False
    cause: causes.Cause | None = None
    takes: tuple[str, ...] = ()


def answer(call: Call, namespace: Mapping) -> Reply:
    """Call the student's function of that name, and read what it returns as numbers."""
    if not call.without:
        return _answer(call, namespace)
    with _closed(namespace, call.without):
        return _answer(call, namespace)


def _answer(call: Call, namespace: Mapping) -> Reply:
    if call.name not in namespace:
        close = difflib.get_close_matches(call.name, own_names(namespace), n=1, cutoff=0.5)
        hint = close[0] if close else ""
        return Reply(fault=Fault(FaultKind.MISSING, hint))
    function = namespace[call.name]
    if not callable(function):
        return Reply(fault=Fault(FaultKind.NOT_CALLABLE, type(function).__name__))
    given: list = []
    watch = Stopwatch()
    reply = replace(_called(call, function, given, CALL_SECONDS), takes=takes(function))
    if not reply.fault and riddles.uses_caret(function):
        reply = replace(reply, caret=True)
    changes = () if reply.fault else _changes(call.args, given)
    # Both calls together get the time of one, so that the judge waits no longer for the reply.
    took = watch.seconds(PATIENCE)
    if not (reply.fault or is_finite(reply.value)) and took < QUICK:
        reply = replace(reply, cause=_cause(call, function, QUICK - took))
        took = watch.seconds(PATIENCE)
    if not changes:
        return reply
    again = _called(call, function, given, max(CALL_SECONDS - took, 0.01))
    too_large = max(_size(reply.value), _size(again.value)) > MOST_TWICE
    # Then the second call had less time than a call may take.
    too_long = again.fault and again.fault.kind in (FaultKind.TIMED_OUT, FaultKind.STARVED)
    return replace(reply, changed=changes, again=None if too_large or too_long else again)


@contextmanager
def _closed(namespace: Mapping, names: tuple[str, ...]) -> Iterator[None]:
    """Without these functions: what calls one of them meanwhile fails."""
    kept = {name: namespace[name] for name in names if name in namespace}
    if not isinstance(namespace, MutableMapping):
        raise TypeError("functions can be closed only in a namespace that can change")

    def closed(*args, **kwargs):
        raise RuntimeError("this function is closed while another one is asked")

    try:
        namespace.update(dict.fromkeys(kept, closed))
        yield
    finally:
        namespace.update(kept)


def _called(call: Call, function: Callable, given: list, seconds: float) -> Reply:
    """One call with the arguments in `given`; an empty list gets new ones first.

    What comes after a stop that the function swallowed is no answer: it was stopped anywhere.
    """
    limit = time_limit(seconds)
    reply = _within(limit, call, function, given)
    return reply if limit.error is None else _stopped(limit.error)


def _stopped(error: TimeLimitError) -> Reply:
    kind = FaultKind.STARVED if error.starved else FaultKind.TIMED_OUT
    return Reply(fault=Fault(kind, f"{error.seconds:g} s"))


def _within(limit: Limit, call: Call, function: Callable, given: list) -> Reply:
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"), limit:
            warnings.simplefilter("ignore")
            given += [] if given else map(real, call.args)
            result = function(*given)
            if result is ...:  # `return ...`, as a lesson's stub does
                return Reply(fault=Fault(FaultKind.NOT_IMPLEMENTED))
            return Reply(value=read(call, result))
    except NotNumbersError as error:
        nothing = error.kind is FaultKind.NOTHING
        riddle = riddles.of_nothing(function) if nothing else None
        return Reply(fault=Fault(error.kind, shortened(str(error)), riddle=riddle))
    except TimeLimitError as error:
        return _stopped(error)
    except (Exception, SystemExit) as error:
        if isinstance(error, NotImplementedError) and is_left_open(error):
            line = riddles.line_above_answer(function)
            return Reply(fault=Fault(FaultKind.NOT_IMPLEMENTED, line=line))
        text = message_of(error)
        message = shortened(f"{type(error).__name__}: {text}".removesuffix(": "))
        riddle = riddles.of_error(error, shortened(text))
        return Reply(fault=Fault(FaultKind.RAISED, message, _failing_line(error), riddle))


def _cause(call: Call, function: Callable, seconds: float) -> causes.Cause | None:
    """Where in the function a number comes up that is not finite."""
    found: list[causes.Cause] = []
    try:
        with causes.heard() as found, time_limit(seconds):
            function(*map(real, call.args))
    except (Exception, SystemExit, TimeLimitError):
        pass  # what was heard until then
    return causes.likeliest(found)


def _changes(args: tuple, given: list) -> tuple[tuple[int, str], ...]:
    found = []
    for place, (value, now) in enumerate(zip(args, given, strict=True)):
        try:
            found += [(place, name) for name in changed(value, now)]
        except Exception:  # something of the student's own that cannot even be compared
            found.append((place, ""))
    return tuple(found[:MOST_CHANGES])


def _size(value) -> int:
    if isinstance(value, dict | list):
        return sum(map(_size, value.values() if isinstance(value, dict) else value))
    return np.size(value)


def read(call: Call, result):
    """A function's result as the numbers that the call asks for; NotNumbersError where it has none."""
    if call.at:
        return evaluate(result, call.at)
    return read_parts(result) if call.parts else read_numbers(result, call.truth)


def answer_all(calls: list[Call], namespace: Mapping) -> list[Reply]:
    """Answer calls in turn, up to a fault that the rest would share, or would take long to find.

    After an error, or a value that is no number, the calls go on for as long as one call may take in
    all: whoever reads of it wants to know whether every call fails.
    """
    replies: list[Reply] = []
    since: Stopwatch | None = None
    for call in calls:
        replies.append(answer(call, namespace))
        if (fault := replies[-1].fault) is None:
            continue
        since = since or Stopwatch()
        if fault.kind not in GO_ON_AFTER or since.seconds(PATIENCE) > CALL_SECONDS:
            break
    return replies


def own_names(namespace: Mapping) -> list[str]:
    """The functions a student defined, by name."""
    return [
        name
        for name, value in namespace.items()
        if callable(value) and getattr(value, "__module__", None) == "__main__"
    ]


def _failing_line(error: BaseException) -> str:
    """The last line of the student's own code on the way to the error."""
    return line_of(traceback.extract_tb(error.__traceback__))


def kind_of(error: BaseException) -> str:
    """The name of an error's class; SyntaxError also for Python's private kinds of it."""
    name = type(error).__name__
    return "SyntaxError" if isinstance(error, SyntaxError) and name.startswith("_") else name


def message_of(error: BaseException) -> str:
    """The message of an error, whose class may be a student's own."""
    try:
        return str(error)
    except Exception:
        return "(a message that cannot be read)"
