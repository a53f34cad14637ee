"""Chooses which files beside a notebook its cells find, and explains why a file is not there."""

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path, PurePosixPath, PureWindowsPath

from autograder.digest import digest
from autograder.protocol import Reply, one_line

MOST_FILES = 100
MOST_BYTES = 8 << 20
# A derivation may be handed in as one of these.
DOCUMENTS = (
    ".docx",
    ".gif",
    ".heic",
    ".jpeg",
    ".jpg",
    ".md",
    ".odt",
    ".pdf",
    ".png",
    ".rtf",
    ".svg",
    ".tex",
    ".tif",
    ".tiff",
    ".txt",
    ".webp",
)
# Under these names, a cell imports the grader's own modules.
RESERVED = ("armdyn", "autograder", "protocol", "toolchain")
# How Python, IPython and NumPy report that a file or a module is not there.
MISSING_FILE = re.compile(
    r"No such file or directory: '([^']+)'|File `'([^']+)'` not found"
    r"|FileNotFoundError: (?:there is no file )?([^\s;]+)(?: not found\.|[;.])"
)
# What tells a mechanism's file from another module of the course.
DEFINES = re.compile(r"^MECHANISM\b", re.MULTILINE)
MISSING_MODULE = re.compile(r"No module named '(\w+)")


@dataclass(frozen=True)
class Beside:
    """The files beside a notebook, by their path from it.

    laid: those that its cells find. left_out: why its cells do not find the others. documents: a
    student's own pictures and texts. mechanisms: the course's own files, as texts, of which checks are
    made: mechanisms, and checks/NAME.py; they are the source's, and no cell finds them.
    """

    laid: Mapping[str, bytes] = field(default_factory=dict)
    left_out: Mapping[str, str] = field(default_factory=dict)
    documents: tuple[str, ...] = ()
    mechanisms: Mapping[str, str] = field(default_factory=dict)

    def digest(self) -> str:
        """A name for these files; other files have another name."""
        laid = (part for item in sorted(self.laid.items()) for part in item)
        mechanisms = sorted(self.mechanisms.items())
        return digest(*laid, repr((sorted(self.left_out.items()), self.documents, *mechanisms)))

    def explanation(self, error: str) -> str:
        """Why a file or module that an error names is not there; empty if it names none."""
        if match := MISSING_MODULE.search(error):
            return self._of_module(match[1])
        if match := MISSING_FILE.search(error):
            return self._of_file(next(filter(None, match.groups())))
        return ""

    def explained(self, reply: Reply) -> Reply:
        """The reply, with the explanation in its fault's message."""
        if reply.fault is None or not (why := self.explanation(reply.fault.message)):
            return reply
        message = f"{reply.fault.message.rstrip('. ')} ({why})"
        return Reply(fault=replace(reply.fault, message=message))

    def _of_module(self, module: str) -> str:
        for name, why in self.left_out.items():
            if PurePosixPath(name).parts[0] in (module, f"{module}.py"):
                return _not_laid(name, why)
        return f"no {module}.py was handed in, and no package of this name is installed here"

    def _of_file(self, name: str) -> str:
        shown = one_line(name, 100)
        path = PureWindowsPath(name)  # takes either slash
        as_written = path.as_posix().removeprefix("./")
        for left, why in self.left_out.items():
            if left == as_written or PurePosixPath(left).name == path.name:
                return _not_laid(left, why)
        there = next((laid for laid in self.laid if PurePosixPath(laid).name == path.name), None)
        if there is not None:
            return (
                f"{one_line(there, 100)} was handed in, but the path {shown} does not lead to it from "
                "the notebook"
            )
        return f"{shown} was not handed in with the notebook"


def choose(files: Mapping[str, Path], own: Collection[str] = ()) -> Beside:
    """Choose which files of a submission the cells find: the smallest first, up to the limits.

    files: by their path from the notebook. own: those that are not the assignment's.
    """
    left_out = {
        name: "the grader has a module of this name" for name in files if _is_reserved(name)
    }
    sizes = {name: path.stat().st_size for name, path in files.items() if name not in left_out}
    laid: dict[str, bytes] = {}
    total = 0
    for name in sorted(sizes, key=lambda name: (sizes[name], name)):
        total += sizes[name]
        if len(laid) == MOST_FILES:
            left_out[name] = f"more than {MOST_FILES} files lie beside the notebook"
        elif total > MOST_BYTES:
            left_out[name] = f"the files beside the notebook have more than {MOST_BYTES >> 20} MB"
        else:
            laid[name] = files[name].read_bytes()
    documents = sorted(name for name in own if name.lower().endswith(DOCUMENTS))
    return Beside(laid, left_out, tuple(documents))


def _is_reserved(name: str) -> bool:
    return PurePosixPath(name).parts[0].removesuffix(".py") in RESERVED


def _not_laid(name: str, why: str) -> str:
    return f"{one_line(name, 100)} was handed in, but the notebook is graded without it: {why}"
