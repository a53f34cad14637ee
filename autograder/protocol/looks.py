"""`Look`: when a student's function fails in a cell of the course, a line says so, not an error."""

import inspect
import sys
import traceback
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from types import TracebackType

from .calls import message_of
from .limits import TimeLimitError, time_limit
from .own_code import is_left_open
from .riddles import of_error, sentence
from .words import one_line

# Takes the id of the check in whose function an error was raised, if any; gives the one to blame.
Blame = Callable[[str | None], str | None]


class Look:
    """A block that uses functions of the student's. An error in it becomes one printed line.

    The figures that a failed block opened are closed, as they are empty or half drawn. An interrupt
    goes through, as it is no function's error.

    ids: of the checks that judge these functions, each after those that it builds on. namespace: the
    notebook's. blame: asked after an error; without it, the line names every card that may say more.
    seconds: the time limit of the block; none by default.
    """

    def __init__(
        self,
        ids: tuple[str, ...],
        namespace: Mapping,
        blame: Blame | None = None,
        seconds: float | None = None,
    ):
        self._ids = ids
        self._namespace = namespace
        self._blame = blame
        self._seconds = seconds
        self._limit = ExitStack()
        self._figures: set[int] = set()

    def __enter__(self):
        self._figures = _open_figures()
        if self._seconds is not None:
            self._limit.enter_context(time_limit(self._seconds))

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> bool:
        self._limit.close()
        if error is None:
            return False
        # The time limit of the whole cell is not ours to catch.
        own: tuple[type[BaseException], ...] = (Exception, SystemExit)
        if self._seconds is not None:
            own += (TimeLimitError,)
        if isinstance(error, own):
            print(self._line_about(error))
        _close_figures(_open_figures() - self._figures)
        return isinstance(error, own)

    def _line_about(self, error: BaseException) -> str:
        raising = self._raising(error)
        if isinstance(error, NotImplementedError) and is_left_open(error):
            names = [_name(raising)] if raising else map(_name, self._ids)
            return f"Write {_joined(names)} first, then run this cell again."
        missing = [id for id in self._ids if _name(id) not in self._namespace]
        if isinstance(error, NameError) and error.name in list(map(_name, missing)):
            return f"The notebook does not define {error.name}: {_cards(missing)}."
        if isinstance(error, TimeLimitError):
            failure = f"did not end within {self._seconds:g} s"
        else:
            failure = f"raises {one_line(type(error).__name__)}"
        details = f"{failure}: {one_line(message_of(error), 120)}".removesuffix(": ")
        if self._blame is None:
            cards = self._ids[: self._ids.index(raising) + 1] if raising else self._ids
            who = _name(raising) if raising else "This cell"
            return f"{who} {failure if raising else details}: {_cards(cards)}."
        blamed = self._blame(raising)
        if blamed is None:  # the functions are right, but not in a form that this cell can use
            who = _name(raising) if raising else "This cell"
            means = sentence(of_error(error, message_of(error)))
            return f"{who} {details.removesuffix('.')}. {means}" if means else f"{who} {details}"
        if blamed == raising:
            return f"{_name(raising)} {failure}: {_cards([blamed])}."
        return f"This cell cannot use what {_name(blamed)} returns: {_cards([blamed])}."

    def _raising(self, error: BaseException) -> str | None:
        """The check of the innermost of these functions on the way to the error."""
        codes = {_code(self._namespace.get(_name(id))): id for id in self._ids}
        frames = [frame for frame, _ in traceback.walk_tb(error.__traceback__)]
        return next((codes[f.f_code] for f in reversed(frames) if f.f_code in codes), None)


def _name(id: str) -> str:
    """The function that a check judges: p1-M judges M."""
    return id.partition("-")[2]


def _joined(names) -> str:
    *others, last = names
    return f"{', '.join(others)} and {last}" if others else last


def _cards(ids) -> str:
    return f"see the card{'s' if len(ids) > 1 else ''} of {_joined(ids)}"


def _code(function):
    """What a function runs; None where that is not Python."""
    try:
        function = inspect.unwrap(function)
    except ValueError:  # wrapped in itself
        return None
    if not hasattr(function, "__code__") and callable(function):
        function = type(function).__call__
    return getattr(function, "__code__", None)


def _open_figures() -> set[int]:
    pyplot = sys.modules.get("matplotlib.pyplot")
    return set(pyplot.get_fignums()) if pyplot else set()


def _close_figures(numbers: set[int]) -> None:
    for number in numbers:
        sys.modules["matplotlib.pyplot"].close(number)
