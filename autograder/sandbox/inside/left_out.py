"""Says why a line that works in JupyterLab is left out when a notebook is graded."""

import re

INSTALLS = "the grader installs nothing; it has the packages of the course"
NO_KERNEL = "it needs a running kernel, and the grader has none"
UNKNOWN = "the grader knows no magic of this name"
NOT_FIRST = "a magic with %% must be the first line of its cell"
NOBODY = "nobody is there to answer while a notebook is graded"
INPUT = f"input() waits for an answer, but {NOBODY}; write the value into the cell"

# By the name of the magic. An empty text: nobody would miss the magic in the notebook.
MAGICS = {
    **dict.fromkeys(("pip", "conda", "mamba", "micromamba", "uv"), INSTALLS),
    **dict.fromkeys(("connect_info", "qtconsole", "subshell"), NO_KERNEL),
    **dict.fromkeys(("debug", "pdb"), f"it asks for commands, and {NOBODY}"),
    **dict.fromkeys(("edit", "ed"), f"it opens an editor, and {NOBODY}"),
    "pastebin": "the grader has no network",
    **dict.fromkeys(("autosave", "less", "man", "more"), ""),
}
INSTALLERS = re.compile(
    r"(?:^|[;&|(]) \s* (?:sudo\s+)? (?: \S*python[\d.]*\S* \s+ -m \s+ )?"
    r"(?:pip[\d.]*|conda|mamba|micromamba|uv|apt|apt-get|brew) (?!\S)",
    re.VERBOSE,
)


class LeftOutError(Exception):
    """A line cannot work here; the message says why."""


def refuse_what_cannot_work(command: str) -> None:
    """LeftOutError for a shell command that would install something, or run in the background."""
    if INSTALLERS.search(command):
        raise LeftOutError(INSTALLS)
    if command.rstrip().endswith("&"):
        raise LeftOutError("the grader runs no command in the background")


def refuse_magic(name: str) -> bool:
    """Whether to pass over the magic in silence; LeftOutError where the student must know why."""
    if MAGICS.get(name):
        raise LeftOutError(MAGICS[name])
    return name in MAGICS
