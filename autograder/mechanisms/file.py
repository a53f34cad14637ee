"""Reads a mechanism of one's own: a file with MECHANISM = Mechanism(…), beside its notebook."""

import traceback
from functools import lru_cache
from pathlib import Path

from autograder.mechanisms.mechanism import Mechanism


class MechanismFileError(ValueError):
    """A mechanism's file cannot be used; the text says which, where, and what to do."""

    def _render_traceback_(self):
        return [str(self)]


@lru_cache(maxsize=64)
def mechanism_of(text: str, shown: str, name: str = "") -> Mechanism:
    """The mechanism that a file's text defines; the same text gives the same object.

    shown: the file's name for errors. name: the mechanism's, if it has to have this one. The text is
    run, so it must be the course's own, never a student's. MechanismFileError names file and line.
    """
    namespace: dict = {"__name__": "own_mechanism", "__file__": shown}
    try:
        exec(compile(text, shown, "exec"), namespace)
    except Exception as error:  # whatever the lecturer's file raises
        raise MechanismFileError(
            f"{shown}{_line(error, shown)}: {type(error).__name__}: {_said(error)}; put the file right, "
            "and try it with `autograder try`"
        ) from error
    own = namespace.get("MECHANISM")
    if not isinstance(own, Mechanism):
        has = "none" if own is None else repr(own)
        raise MechanismFileError(
            f"{shown}: needs MECHANISM = Mechanism(…), of autograder.mechanisms; it has {has}"
        )
    if name and own.name != name:
        raise MechanismFileError(
            f'{shown}: its mechanism is called {own.name!r}; write name="{name}", as the file says'
        )
    return own


def mechanism_in(path: Path, shown: str = "", name: str = "") -> Mechanism:
    """The mechanism of a file on disk. MechanismFileError too where the file cannot be read."""
    shown = shown or str(path)
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise MechanismFileError(f"{shown}: there is no such file") from None
    except (OSError, UnicodeDecodeError) as error:
        raise MechanismFileError(f"{shown}: cannot be read: {error}") from error
    return mechanism_of(text, shown, name)


def _line(error: Exception, shown: str) -> str:
    if isinstance(error, SyntaxError):
        return f", line {error.lineno}"
    frames = [f.lineno for f in traceback.extract_tb(error.__traceback__) if f.filename == shown]
    return f", line {frames[-1]}" if frames else ""


def _said(error: Exception) -> str:
    return error.msg if isinstance(error, SyntaxError) else str(error)
