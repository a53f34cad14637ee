"""Finds compilers, interpreters and libraries; if one is missing, a line says what to install."""

import os
import shutil
import sys
from collections.abc import Callable, Iterable
from pathlib import Path

IN_BROWSER = "A browser starts no other programs: for this, the course must be on your computer."


class MissingToolError(RuntimeError):
    """A program or library is not there; the message is one line that says what to install."""


def program(what: str, names: Iterable[str], install: str) -> Path:
    """The first of the programs that is on the PATH.

    what, install: for the MissingToolError where none is: "a C++ compiler", "Debian …: …".
    """
    for name in names:
        if found := shutil.which(name):
            return Path(found)
    if sys.platform == "emscripten":
        raise MissingToolError(f"{what} was not found. {IN_BROWSER}")
    raise MissingToolError(f"{what} was not found ({', '.join(names)}). {install}")


def folder(what: str, variable: str, places: Iterable[Path], holds: str, install: str) -> Path:
    """The folder that an environment variable names, else the first place with what is sought.

    holds: a glob pattern of the file that tells, such as "Eigen/Dense". Raises MissingToolError
    where there is none, and where the variable names a folder without it.
    """
    chosen = os.environ.get(variable)
    places = [Path(chosen)] if chosen else list(places)
    for place in places:
        if any(place.glob(holds)):
            return place
    where = f"${variable} = {chosen}" if chosen else ", ".join(map(str, places))
    raise MissingToolError(
        f"{what} was not found ({where}). {install} Or set {variable} to the folder with {holds}."
    )


def missing(find: Callable[[], object]) -> str | None:
    """The line that `find` raises as MissingToolError, or None if it finds all it needs."""
    try:
        find()
    except MissingToolError as error:
        return str(error)
    return None
