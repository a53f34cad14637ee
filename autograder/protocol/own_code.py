"""Where in a student's own code something happened."""

import os
import traceback
from collections.abc import Collection, Iterable
from pathlib import Path
from traceback import FrameSummary
from types import CodeType

from .words import other_cell, shortened

# A cell as IPython names it, in a kernel and in the sandbox.
CELLS = ("ipykernel_", "<ipython-input")
INSTALLED = ("site-packages", "dist-packages")
OF_PYTHON = Path(os.__file__).parent
MOST_ARGUMENTS = 12
LONGEST_NAME = 30


def line_of(frames: Iterable[FrameSummary]) -> str:
    """The last line of the student's own code among these frames, with its number, and with its cell or
    its file where that is not the function's cell; "" where none is the student's.
    """
    own = [frame for frame in frames if _is_own(frame.filename)]
    if not own:
        return ""
    line = f"line {own[-1].lineno}: {own[-1].line}".rstrip(": ")
    if not _is_cell(own[-1].filename):
        where = os.path.basename(own[-1].filename)
    else:
        where = "" if own[-1].filename == own[0].filename else other_cell(own[-1].name)
    return shortened(f"{where}, {line}" if where else line)


def takes(function) -> tuple[str, ...]:
    """The arguments of a Python function by the names that its first line gives them; () for what has
    none, or more than a function of the course could have.
    """
    code = getattr(function, "__code__", None)
    names = code.co_varnames[: code.co_argcount] if isinstance(code, CodeType) else ()
    return names if are_arguments(names) else ()


def are_arguments(names: Collection) -> bool:
    """Whether these may be the names of a function's arguments."""
    return len(names) <= MOST_ARGUMENTS and all(
        isinstance(name, str) and len(name) <= LONGEST_NAME and name.isidentifier()
        for name in names
    )


def is_left_open(error: NotImplementedError) -> bool:
    """Whether the error says that a function is not written yet. Libraries raise it too, for what they
    cannot do: SymPy where it finds no solution, a kernel without a keyboard where input is called.
    """
    (*_, last) = traceback.extract_tb(error.__traceback__)
    path = Path(last.filename)
    return not (set(INSTALLED) & set(path.parts) or path.is_relative_to(OF_PYTHON))


def _is_own(filename: str) -> bool:
    """Whether code is a student's: of a cell, or of a file beside the notebook."""
    return _is_cell(filename) or os.path.dirname(filename) == os.getcwd()


def _is_cell(filename: str) -> bool:
    return any(name in filename for name in CELLS)
