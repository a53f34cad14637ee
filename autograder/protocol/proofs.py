"""The lines of a derivation as plain data, on both sides of the sandbox."""

import itertools
import json
from collections.abc import Iterable
from dataclasses import dataclass

from .calls import kind_of, message_of
from .own_code import is_left_open
from .words import one_line, shortened

MOST_LINES = 30
MOST_PARTS = 5  # a formula and its reasons
MOST_CHARACTERS = 400  # of a formula or a reason
MOST_JSON = 200_000
NO_LINES = 'Give a list of lines, each as ("formula", "reason").'


@dataclass(frozen=True)
class HandedIn:
    """The lines of a derivation as they were handed over, each a formula and its reasons; or the problem
    because of which there are none. Neither: it has not been attempted.

    One line more than MOST_LINES may be here, and a text one character longer than MOST_CHARACTERS, so
    that the judge sees that there was too much.
    """

    lines: tuple[tuple[str, ...], ...] = ()
    problem: str = ""


def handed_in(lines: object) -> HandedIn:
    """What a student gave: a list of lines, or a function of nothing that gives one.

    A part of a line that is no text, such as an expression of SymPy's, is read as its text.
    """
    try:
        given = lines() if callable(lines) else lines
        return HandedIn(tuple(_read(given)))
    except _NoLinesError as error:
        return HandedIn(problem=str(error))
    except Exception as error:  # whatever a student's code raises
        if isinstance(error, NotImplementedError) and is_left_open(error):
            return HandedIn()
        return HandedIn(problem=one_line(f"{kind_of(error)}: {message_of(error)}"))


class _NoLinesError(ValueError):
    """What was given is no list of lines."""


def _read(given: object) -> Iterable[tuple[str, ...]]:
    if given is None or isinstance(given, str | bytes | dict) or not isinstance(given, Iterable):
        raise _NoLinesError(NO_LINES)
    for line in itertools.islice(given, MOST_LINES + 1):
        parts = tuple(line) if isinstance(line, list | tuple) else (line,)
        if not parts:
            raise _NoLinesError(NO_LINES)
        yield tuple(shortened(str(part), MOST_CHARACTERS + 1) for part in parts[:MOST_PARTS])


def encode_handed_in(given: HandedIn) -> str:
    return json.dumps({"lines": given.lines, "problem": given.problem})


def decode_handed_in(text: str) -> HandedIn | None:
    """None where the text is no such answer: it may be forged."""
    if len(text) > MOST_JSON:
        return None
    try:
        said = json.loads(text)
    except (ValueError, RecursionError):
        return None
    match said:
        case {"lines": list(lines), "problem": str(problem)} if len(lines) <= MOST_LINES + 1:
            if not all(map(_is_line, lines)):
                return None
            cut = [[part[: MOST_CHARACTERS + 1] for part in line] for line in lines]
            return HandedIn(tuple(map(tuple, cut)), one_line(problem))
    return None


def _is_line(line: object) -> bool:
    return (
        isinstance(line, list)
        and 1 <= len(line) <= MOST_PARTS
        and all(isinstance(part, str) for part in line)
    )
