"""A function that is missing, or still the old one, as the cell that should define it failed.

Python keeps what a name stood for when a cell stops before its `def`: at a SyntaxError, or at an error
further up. A check then judges a function that is no longer on the screen, and has to say so.
"""

import re
import sys
from collections.abc import Collection

from autograder.protocol import kind_of, one_line, said_by


class Definitions:
    """Watches an IPython shell's cells for those that failed to define one of some names anew."""

    def __init__(self, shell, names: Collection[str]):
        self._namespace = shell.user_ns
        self._names = names
        self._before: dict[str, object] = {}
        # What a name stood for, or None, when a cell failed to define it, and the error.
        self._failed: dict[str, tuple[object, str]] = {}
        shell.events.register("pre_run_cell", self._starts)
        shell.events.register("post_run_cell", self._ended)

    def old(self, name: str) -> str:
        """The error that kept what the name stands for from being replaced; "" where none did."""
        return self._kept(name) if name in self._namespace else ""

    def missing(self, name: str) -> str:
        """The error that kept the name, which stands for nothing, from being defined, or ""."""
        return "" if name in self._namespace else self._kept(name)

    def _kept(self, name: str) -> str:
        before, error = self._failed.get(name, (None, ""))
        return error if self._namespace.get(name) is before else ""

    def _starts(self, info) -> None:
        self._before = {name: self._namespace.get(name) for name in self._names}

    def _ended(self, result) -> None:
        error = result.error_before_exec or result.error_in_exec
        for name, before in self._before.items():
            if _defines(result.info.raw_cell, name):
                if error is not None and self._namespace.get(name) is before:
                    self._failed[name] = before, _describe(error)
                else:
                    self._failed.pop(name, None)


def watched(names: Collection[str]) -> Definitions | None:
    """Definitions of the shell that this Python runs, from now on; None outside IPython."""
    if "IPython" not in sys.modules:
        return None
    shell = sys.modules["IPython"].get_ipython()
    return None if shell is None else Definitions(shell, names)


def _defines(source: str | None, name: str) -> bool:
    """Whether a cell, which need not be valid Python, defines the name at its margin."""
    defined = rf"^(def\s+{name}\s*\(|{name}\s*(:[^=\n]+)?=[^=])"
    return re.search(defined, source or "", re.MULTILINE) is not None


def _describe(error: BaseException) -> str:
    said = said_by(error)
    if isinstance(error, SyntaxError):
        said = f"{error.msg}, line {error.lineno}"
    return one_line(f"{kind_of(error)}: {said}", 150)
