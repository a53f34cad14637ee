"""Says when a function is missing, or an old one, because the cell that defines it failed.

If a cell stops before its `def`, at a SyntaxError or at an error further up, Python keeps the function
that the name stood for. A check then judges a function that is no longer on the screen, and has to
say so.
"""

import re
import sys
from collections.abc import Collection

from autograder.protocol import kind_of, message_of, one_line


class Definitions:
    """Watches the cells of an IPython shell for those that should define a name again, and fail."""

    def __init__(self, shell, names: Collection[str]):
        self._namespace = shell.user_ns
        self._names = names
        self._before: dict[str, object] = {}
        # By name: what it stood for when a cell failed to define it, or None, and the error.
        self._failed: dict[str, tuple[object, str]] = {}
        shell.events.register("pre_run_cell", self._starts)
        shell.events.register("post_run_cell", self._ended)

    def old(self, name: str) -> str:
        """The error because of which the name still stands for its old function, or ""."""
        return self._kept(name) if name in self._namespace else ""

    def missing(self, name: str) -> str:
        """The error because of which the name stands for nothing, or ""."""
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
    """Watch the shell that this Python runs, from now on; None outside IPython."""
    if "IPython" not in sys.modules:
        return None
    shell = sys.modules["IPython"].get_ipython()
    return None if shell is None else Definitions(shell, names)


def _defines(source: str | None, name: str) -> bool:
    """Whether a cell, which may be invalid Python, defines the name without indentation."""
    defined = rf"^(def\s+{name}\s*\(|{name}\s*(:[^=\n]+)?=[^=])"
    return re.search(defined, source or "", re.MULTILINE) is not None


def _describe(error: BaseException) -> str:
    said = message_of(error)
    if isinstance(error, SyntaxError):
        said = f"{error.msg}, line {error.lineno}"
    return one_line(f"{kind_of(error)}: {said}", 150)
