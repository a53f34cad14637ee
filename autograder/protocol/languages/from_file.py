"""from_file("M.cpp") makes a student's function in another language a Python function."""

import difflib
import os
import sys
import tempfile
import weakref
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np

from ..calls import CALL_SECONDS
from ..limits import PATIENCE, TimeLimitError
from ..readings import MOST_NUMBERS, FaultKind, NotNumbersError

PARAMETERS = ("l1", "l2", "lc1", "lc2", "m1", "m2", "I1", "I2", "g")
# By the clock, and enough for a busy machine: what a compiler computes, the room limits.
BUILD_SECONDS = 225.0
# Of the processor's time, as for a call.
START_SECONDS = 15.0


class MissingToolError(NotNumbersError):
    """A tool that answers in this language need is not installed."""

    def __init__(self, line: str):
        super().__init__(FaultKind.NO_TOOLS, line)


def from_file(name: str):
    """The function that the file `name` defines, M(q, arm) or C(q, qd, arm), to be called from Python.

    name: M.cpp, M.java or M.m, or the same with C. The file is built and started at once. If that
    fails, the cell shows why, and each call raises the same error. FileNotFoundError where there is no
    such file, ValueError where no answer may have this name.
    """
    from .language import ARGUMENTS, LANGUAGES  # here, so that other notebooks do not wait for it

    path = Path(name)
    if path.suffix not in LANGUAGES or path.stem not in ARGUMENTS:
        known = [stem + suffix for stem in ARGUMENTS for suffix in LANGUAGES]
        raise ValueError(f"an answer's file cannot be {name!r}; it can be {', '.join(known)}")
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise FileNotFoundError(_no_file(path)) from None
    return Function(path.stem, LANGUAGES[path.suffix], text)


def missing() -> list[str]:
    """A line for each language whose answers cannot run here: what is not installed."""
    from .language import LANGUAGES, toolchain

    lines = [toolchain.missing(language.toolchain) for language in LANGUAGES.values()]
    return [line for line in lines if line]


def _no_file(path: Path) -> str:
    there = [entry.name for entry in path.absolute().parent.glob("*") if entry.is_file()]
    close = difflib.get_close_matches(path.name, there, n=1, cutoff=0.5)
    meant = f" Did you mean {close[0]}?" if close else ""
    return f"there is no file {path}.{meant} Run the cell with %%writefile {path} before this one."


class Function:
    """A student's function in another language, which keeps its program running."""

    def __init__(self, name: str, language, text: str):
        from .language import ARGUMENTS, toolchain

        self.__name__ = name
        self._arguments = ARGUMENTS[name].split(", ")
        self._language, self._toolchain = language, toolchain
        self._files = language.files(name, text)
        self._program: Any = None  # a Conversation of the toolchain, which is imported late
        self._failed: Exception | None = None
        try:
            self._build()
            self._start()
        except toolchain.MissingToolError as error:
            self._fail(MissingToolError(str(error)), str(error))
        except toolchain.BuildError as error:
            first = language.first_error(name, str(error))
            self._fail(toolchain.BuildError(first), str(error))
        except toolchain.ProgramError as error:
            self._fail(error, str(error))

    def __call__(self, *given):
        if self._failed:
            raise type(self._failed)(str(self._failed))
        if len(given) != len(self._arguments):
            wanted = ", ".join(self._arguments)
            raise TypeError(f"{self.__name__}({wanted}) takes {len(self._arguments)} arguments")
        *vectors, arm = given
        vectors = [self._pair(*pair) for pair in zip(self._arguments, vectors, strict=False)]
        numbers = [float(getattr(arm, name)) for name in PARAMETERS]
        request = np.concatenate([*vectors, np.zeros(4 - 2 * len(vectors)), numbers])
        if self._program is not None and self._program.ended:
            self._end()  # the sandbox ends everything that a cell started
            self._program = None
        if self._program is None:
            self._start()
        return self._ask(request)

    def _pair(self, name, value):
        value = np.asarray(value, dtype=float)
        if value.size != 2:
            raise ValueError(f"{name} has shape {value.shape}; it must be two numbers")
        return value.ravel()

    def _build(self):
        found = self._language.toolchain()
        self._folder = self._toolchain.build(self._files, found.compile, _cache(), BUILD_SECONDS)
        self._command = found.started_in(self._folder)

    def _start(self):
        program = ExitStack()
        self._program = program.enter_context(
            self._toolchain.Conversation(
                self._command, self._folder, START_SECONDS, patience=PATIENCE
            )
        )
        self._end = weakref.finalize(self, program.close)
        self._ask([])
        self._program.seconds = CALL_SECONDS

    def _ask(self, request):
        whole = False
        try:
            answer = self._program.ask(request, at_most=MOST_NUMBERS)
            whole = True
        except self._toolchain.ProgramError as error:
            if self._program.late and self._program.seconds == CALL_SECONDS:
                raise TimeLimitError(CALL_SECONDS, self._program.starved) from None
            how, _, text = str(error).replace(f"{self._folder}{os.sep}", "").partition(": ")
            why = self._language.last_words(self.__name__, text)
            raise self._toolchain.ProgramError(why or how) from None
        finally:
            if not whole:  # whatever ended this call, in the middle of an answer perhaps
                self._end()
                self._program = None
        rows, columns = map(int, answer[:2])
        return answer[2:].reshape(rows, columns)

    def _fail(self, error, text):
        self._failed = error
        print(f"{next(iter(self._files))}: {text}", file=sys.stderr)


def _cache() -> Path:
    """Where built programs are kept: with those of armdyn, or in the sandbox."""
    try:
        from armdyn.codegen.build import cache_folder
    except ImportError:
        return Path(tempfile.gettempdir()) / "built"
    return cache_folder() / "answers"
