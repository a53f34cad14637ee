"""Reads a mechanism of one's own: a file with MECHANISM = Mechanism(…), beside its notebook."""

import re
import traceback
from functools import lru_cache
from pathlib import Path

from autograder.mechanisms.kinetic import refuse_other_than_positive
from autograder.mechanisms.mechanism import Mechanism
from autograder.mechanisms.unused import refuse_unused

SYMBOLS = (
    "an energy is made of m.symbol for a parameter m, x.symbol and x.velocity for a coordinate x, and "
    "sp.sin, sp.cos and sp.sqrt"
)


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
        own = namespace.get("MECHANISM")
        if isinstance(own, Mechanism):
            refuse_other_than_positive(own)
            refuse_unused(own)
    except Exception as error:  # whatever the lecturer's file raises
        line = _line(error, shown, text)
        at = f"{shown}, line {line}" if line else shown
        raise MechanismFileError(
            f"{at}: {type(error).__name__}: {_said(error)}; put the file right, and try it with "
            "`autograder try`"
        ) from error
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
    except UnicodeDecodeError:
        raise MechanismFileError(f"{shown}: is no text in UTF-8") from None
    except OSError as error:
        raise MechanismFileError(f"{shown}: cannot be read: {error}") from error
    return mechanism_of(text, shown, name)


def _line(error: Exception, shown: str, text: str) -> int | None:
    """Of the name that the error is about, where the mechanism was refused; else where it was raised."""
    if isinstance(error, SyntaxError):
        return error.lineno
    lines = text.splitlines()
    for name in _named(str(error)):
        found = [k for k, line in enumerate(lines, 1) if f'"{name}"' in line or f"'{name}'" in line]
        if found:
            return found[-1]
    raised = error.__cause__ or error  # as in the file's own `points`
    frames = [
        f.lineno
        for cause in (raised, error)
        for f in traceback.extract_tb(cause.__traceback__)[::-1]
        if f.filename == shown
    ]
    return frames[0] if frames else None


def _named(said: str) -> list[str]:
    """The names in a refusal, the first first: k of "mechanism 'sled': k: the unit 'N/cm' …"."""
    refusal = re.fullmatch(r"mechanism '[^']*': (.*)", said, re.DOTALL)
    found = re.findall(r"'([^']+)'|^(\w+)", refusal[1]) if refusal else []
    return [quoted or bare for quoted, bare in found]


def _said(error: Exception) -> str:
    if isinstance(error, SyntaxError):
        return error.msg
    said = str(error)
    about_symbols = re.search(
        r"'(Parameter|Coordinate)'|\.(Parameter|Coordinate)'|type Symbol", said
    )
    if about_symbols or "expression to float" in said:
        return f"{said}; {SYMBOLS}"
    return said
