"""Looks at an assignment's source before it is released, and before anything is graded by it."""

from logging import Logger
from pathlib import Path

import nbformat
from nbgrader.converters.base import NbGraderException

from autograder.nbgrader_glue.handed_in import beside
from autograder.notebook.beside import Beside
from autograder.notebook.trial import refusal, without_check
from autograder.protocol import one_line
from autograder.terminal import shown_note

WEAKER = (
    "%s has no check: as in nbgrader, it is graded by whether its code runs to the end, and by the "
    "number that it ends in. It runs in the sandbox, but where a student's code can read it, and change "
    "what it rests on"
)


class UnsoundError(NbGraderException):
    """A source cannot be graded as it is written; the message has a sentence for each cell."""


def beside_source(folder: Path, ignore: list[str]) -> Beside:
    """The files beside a source, as cells find them."""
    return beside(folder, folder, ignore, [])


def refuse_unsound(path: Path, ignore: list[str]) -> None:
    """UnsoundError if the source cannot be graded as it is written. OSError if no sandbox starts."""
    try:
        source = nbformat.read(path, as_version=4)
    except Exception as error:  # JSON of another kind, or none
        raise UnsoundError(f"{path} cannot be read: {one_line(str(error))}") from None
    if why := refusal(path.parent.name, source, beside_source(path.parent, ignore)):
        raise UnsoundError(why)


def tell(log: Logger, message: str) -> None:
    """Log an error of several lines, each as one."""
    for line in message.splitlines():
        log.error(shown_note(line))


def look_at(path: Path, ignore: list[str], log: Logger) -> None:
    """Before a source is released: log what its instructor should know. UnsoundError if it cannot be
    graded as it is written.
    """
    try:
        refuse_unsound(path, ignore)
    except UnsoundError as error:
        tell(log, str(error))
        raise
    except OSError as error:
        log.warning("the tests of %s were not tried: %s", path.name, shown_note(str(error)))
    source = nbformat.read(path, as_version=4)
    for id in without_check(source, beside_source(path.parent, ignore)):
        log.warning(WEAKER, id)
