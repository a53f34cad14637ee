"""The wall between a student's code and its judge: calls go in, plain numbers come back.

This file is on both sides. In JupyterLab `answer` runs in the student's own kernel; in grading it
runs in the sandbox, and calls and replies cross as JSON, never as objects. It knows nothing of the
problems, and holds nothing that a student should not see.
"""

import difflib
import numbers
import os
import signal
import threading
import traceback
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import asdict, dataclass
from enum import StrEnum
from functools import lru_cache
from types import SimpleNamespace

import numpy as np

CALL_SECONDS = 2.0
# 24 such answers are a reply that the room may still send.
MOST_NUMBERS = 50_000
MOST_CHARACTERS = 300


class FaultKind(StrEnum):
    """Why a call gave no numbers."""

    MISSING = "missing"  # no such name in the notebook
    CELL_FAILED = "cell failed"  # no such name, and a cell that holds it stopped with an error
    NOT_CALLABLE = "not callable"
    NOT_IMPLEMENTED = "not implemented"  # the stub is still there
    RAISED = "raised"
    TIMED_OUT = "timed out"
    DIED = "died"  # the process ended during the call
    NOTHING = "nothing"  # returned None
    NOT_NUMBERS = "not numbers"
    GARBLED = "garbled"  # what came back through the wall is no reply


@dataclass(frozen=True)
class Fault:
    """A call that gave no numbers: what went wrong, and the student's line where it did."""

    kind: FaultKind
    message: str = ""
    line: str = ""


@dataclass(frozen=True)
class Symbol:
    """Stands for a real SymPy symbol in the arguments of a call."""

    name: str


@dataclass(frozen=True)
class Call:
    """One call of a student's function.

    args: floats, arrays, namespaces of them, or Symbols. With Symbols, the SymPy expression that
    comes back is evaluated at each point of `at`, a mapping from symbol to number, and the reply
    holds one value a point.
    """

    name: str
    args: tuple
    at: tuple[Mapping[str, float], ...] = ()


@dataclass(frozen=True)
class Reply:
    """The numbers a call gave, as a float array, or the fault that kept them back."""

    value: np.ndarray | None = None
    fault: Fault | None = None


class NotNumbersError(Exception):
    """A value that a judge cannot read as numbers."""

    def __init__(self, kind: FaultKind, message: str):
        super().__init__(message)
        self.kind = kind


class TimeLimitError(BaseException):
    """Raised in the student's code at its time limit; no `except Exception` swallows it."""


def answer(call: Call, namespace: Mapping) -> Reply:
    """Call the student's function of that name, beside it, and read what it returns as numbers."""
    if call.name not in namespace:
        close = difflib.get_close_matches(call.name, own_names(namespace), n=1, cutoff=0.5)
        hint = close[0] if close else ""
        return Reply(fault=Fault(FaultKind.MISSING, hint))
    function = namespace[call.name]
    if not callable(function):
        return Reply(fault=Fault(FaultKind.NOT_CALLABLE, type(function).__name__))
    try:
        with time_limit(CALL_SECONDS), warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            result = function(*(_argument(value) for value in call.args))
            return Reply(value=_evaluate(result, call.at) if call.at else read_numbers(result))
    except NotNumbersError as error:
        return Reply(fault=Fault(error.kind, shortened(str(error))))
    except NotImplementedError:
        return Reply(fault=Fault(FaultKind.NOT_IMPLEMENTED))
    except TimeLimitError:
        return Reply(fault=Fault(FaultKind.TIMED_OUT, f"{CALL_SECONDS:g} s"))
    except (Exception, SystemExit) as error:
        message = shortened(f"{type(error).__name__}: {said_by(error)}")
        return Reply(fault=Fault(FaultKind.RAISED, message, _failing_line(error)))


def answer_all(calls: list[Call], namespace: Mapping) -> list[Reply]:
    """Answer calls in turn, up to the first that gives no numbers: the rest would say the same."""
    replies = []
    for call in calls:
        replies.append(answer(call, namespace))
        if replies[-1].fault:
            break
    return replies


def own_names(namespace: Mapping) -> list[str]:
    """The functions a student defined, by name."""
    return [
        name
        for name, value in namespace.items()
        if callable(value) and getattr(value, "__module__", None) == "__main__"
    ]


def read_numbers(value) -> np.ndarray:
    """`value` as a float array; NotNumbersError says what came instead."""
    if value is None:
        raise NotNumbersError(FaultKind.NOTHING, "")
    if callable(value) and not hasattr(value, "__array__"):
        raise NotNumbersError(FaultKind.NOT_NUMBERS, "a function")
    try:
        array = np.asarray(value)
    except ValueError:
        raise NotNumbersError(FaultKind.NOT_NUMBERS, "rows of different lengths") from None
    if array.size > MOST_NUMBERS:
        raise NotNumbersError(FaultKind.NOT_NUMBERS, f"{array.size} entries, far too many")
    if array.dtype.kind == "O":
        array = np.array([_number(entry) for entry in array.flat]).reshape(array.shape)
    if array.dtype.kind not in "biuf":
        raise NotNumbersError(FaultKind.NOT_NUMBERS, _described(value))
    return array.astype(float)


def _number(entry) -> float:
    free = getattr(entry, "free_symbols", None)
    if free:
        names = ", ".join(sorted(str(symbol) for symbol in free))
        raise NotNumbersError(FaultKind.NOT_NUMBERS, f"an expression that still holds {names}")
    if isinstance(entry, numbers.Real) or hasattr(entry, "__float__"):
        try:
            return float(entry)
        except (TypeError, ValueError, OverflowError):
            pass
    raise NotNumbersError(FaultKind.NOT_NUMBERS, _described(entry))


def _described(value) -> str:
    return f"{type(value).__name__} {shortened(repr(value), 60)}"


def _evaluate(expression, points) -> np.ndarray:
    import sympy  # only a symbolic answer pays for it

    try:
        expression = sympy.sympify(expression, strict=True)
    except sympy.SympifyError:
        read_numbers(expression)
        raise NotNumbersError(FaultKind.NOT_NUMBERS, _described(expression)) from None
    if expression.is_Matrix:
        expression = expression.as_immutable()
    symbols = tuple(sorted(expression.free_symbols, key=lambda symbol: symbol.name))
    return np.array([read_numbers(_value_at(expression, symbols, point)) for point in points])


def _value_at(expression, symbols, point):
    """The expression's value there; compiled where that works, for a hundredth of what `subs` costs."""
    known = {symbol: point[symbol.name] for symbol in symbols if symbol.name in point}
    if len(known) == len(symbols):
        with suppress(Exception):  # what NumPy has no word for, SymPy may still evaluate
            return _compiled(symbols, expression)(*known.values())
    return expression.subs(known)


@lru_cache(maxsize=64)
def _compiled(symbols, expression):
    import sympy

    return sympy.lambdify(symbols, expression, "numpy")


def _argument(value):
    """A fresh copy for each call: a function that changes its arguments harms nobody."""
    if isinstance(value, Symbol):
        import sympy

        return sympy.Symbol(value.name, real=True)
    if isinstance(value, SimpleNamespace):
        return SimpleNamespace(**{name: _argument(entry) for name, entry in vars(value).items()})
    return value.copy() if isinstance(value, np.ndarray) else value


def _failing_line(error: BaseException) -> str:
    """The last line of the student's own code on the way to the error, with its number."""
    own = [
        frame
        for frame in traceback.extract_tb(error.__traceback__)
        if "ipykernel_" in frame.filename or frame.filename.startswith("<ipython-input")
    ]
    if not own:
        return ""
    return shortened(f"line {own[-1].lineno}: {own[-1].line}".rstrip(": "))


def said_by(error: BaseException) -> str:
    """The message of an error, whose class may be a student's own."""
    try:
        return str(error)
    except Exception:
        return "(a message that cannot be read)"


def shortened(text: str, most: int = MOST_CHARACTERS) -> str:
    return text if len(text) <= most else text[: most - 1] + "…"


def one_line(text: str, most: int = MOST_CHARACTERS) -> str:
    """Printable and shortened, so that no text of a student's passes for more than one line of ours."""
    if not text.isprintable():
        text = repr(text[:most])[1:-1]
    return shortened(text, most)


@contextmanager
def time_limit(seconds: float) -> Iterator[None]:
    """Raise TimeLimitError in the block after `seconds`, where the system can (not on Windows)."""
    if os.name != "posix" or threading.current_thread() is not threading.main_thread():
        yield
        return

    def stop(signum, frame):
        raise TimeLimitError

    before = signal.signal(signal.SIGALRM, stop)
    # Again every half second: student code may catch the first one.
    signal.setitimer(signal.ITIMER_REAL, seconds, 0.5)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def encode(value):
    """An argument of a call in JSON's terms."""
    match value:
        case Symbol(name):
            return {"symbol": name}
        case SimpleNamespace():
            return {"namespace": {name: encode(entry) for name, entry in vars(value).items()}}
        case np.ndarray():
            return {"array": value.tolist()}
        case _:
            return value


def decode(value):
    """The argument that `encode` wrote."""
    match value:
        case {"symbol": name}:
            return Symbol(name)
        case {"namespace": entries}:
            return SimpleNamespace(**{name: decode(entry) for name, entry in entries.items()})
        case {"array": entries}:
            return np.array(entries, dtype=float)
        case _:
            return value


def encode_call(call: Call) -> dict:
    return {"name": call.name, "args": [encode(a) for a in call.args], "at": list(call.at)}


def decode_call(message: dict) -> Call:
    args = tuple(decode(value) for value in message["args"])
    return Call(message["name"], args, tuple(message["at"]))


def encode_reply(reply: Reply) -> dict:
    if reply.fault:
        return {"fault": asdict(reply.fault)}
    return {"value": reply.value.tolist()}


def decode_reply(message) -> Reply:
    """A reply from beyond the wall; anything that is not one is a fault, never an exception."""
    try:
        match message:
            case {"value": value}:
                return Reply(value=np.asarray(value, dtype=float))
            case {"fault": {"kind": kind, "message": str(text), "line": str(line)}}:
                return Reply(fault=Fault(FaultKind(kind), shortened(text), shortened(line)))
    except (TypeError, ValueError, OverflowError):
        pass
    return Reply(fault=Fault(FaultKind.GARBLED))
