"""Where in a student's own cells something happened."""

import sys
from collections.abc import Iterable
from traceback import FrameSummary

from .words import shortened

# A cell as IPython names it, in a kernel and in the sandbox.
OWN = ("ipykernel_", "<ipython-input")


def line_of(frames: Iterable[FrameSummary]) -> str:
    """The last line of the student's own code among these frames, with its number, and with its cell's
    number where that is another cell than the function's; "" where none is the student's.
    """
    own = [frame for frame in frames if any(name in frame.filename for name in OWN)]
    if not own:
        return ""
    line = f"line {own[-1].lineno}: {own[-1].line}".rstrip(": ")
    cell = "" if own[-1].filename == own[0].filename else _cell(own[-1].filename)
    return shortened(f"{cell}, {line}" if cell else line)


def _cell(filename: str) -> str:
    """ "cell In[3]" of a cell's file name, as its notebook numbers it; "" where IPython knows none."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    named = shell and shell.compile.format_code_name(filename)
    return f"{named[0].lower()} {named[1]}" if named else "another cell"
