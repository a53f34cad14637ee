"""Lines that work in JupyterLab but not where a notebook is graded, and what is said of them."""

import re

INSTALLS = (
    "nothing can be installed where a notebook is graded; the packages of the course are there"
)
NO_KERNEL = "it is about a running kernel, and there is none where a notebook is graded"
UNKNOWN = "there is no magic of that name where a notebook is graded"
NOT_FIRST = "a magic with %% has to be the first line of its cell"
STOPS = "it waits for commands, and nobody is there to give any where a notebook is graded"
NOBODY = "nobody is there to answer where a notebook is graded"

# By the name of the magic. Where nothing is said, nothing would be seen in the notebook either.
MAGICS = {
    **dict.fromkeys(("pip", "conda", "mamba", "micromamba", "uv"), INSTALLS),
    **dict.fromkeys(("connect_info", "qtconsole", "subshell"), NO_KERNEL),
    **dict.fromkeys(("debug", "pdb"), f"it asks for commands, and {NOBODY}"),
    **dict.fromkeys(("edit", "ed"), f"it opens an editor, and {NOBODY}"),
    "pastebin": "a notebook that is graded has no network",
    **dict.fromkeys(("autosave", "less", "man", "more"), ""),
}
INSTALLERS = re.compile(
    r"(?:^|[;&|(]) \s* (?:sudo\s+)? (?: \S*python[\d.]*\S* \s+ -m \s+ )?"
    r"(?:pip[\d.]*|conda|mamba|micromamba|uv|apt|apt-get|brew) (?!\S)",
    re.VERBOSE,
)


class LeftOutError(Exception):
    """A line that cannot work here: its message says why."""


def refuse_what_cannot_work(command: str) -> None:
    """LeftOutError for a shell command that would install something, or go on by itself."""
    if INSTALLERS.search(command):
        raise LeftOutError(INSTALLS)
    if command.rstrip().endswith("&"):
        raise LeftOutError("a command cannot go on in the background")


def refuse_magic(name: str) -> bool:
    """Whether nothing is to be done for the magic; LeftOutError where that has to be said."""
    if MAGICS.get(name):
        raise LeftOutError(MAGICS[name])
    return name in MAGICS
