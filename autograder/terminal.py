"""Prints text in a terminal without any control sequence that the terminal would obey."""

import sys
from collections.abc import Iterable
from typing import TextIO

from autograder.protocol import one_line

MOST_OF_A_NAME = 64  # characters, so that a table keeps its width
MOST_OF_A_NOTE = 1000
MOST_NAMES = 10


def say(text: str, to: TextIO | None = None) -> None:
    """Print some lines, to stdout unless told otherwise."""
    to = to or sys.stdout
    encoding = to.encoding or "utf-8"
    print(plain(text).encode(encoding, "backslashreplace").decode(encoding), file=to)


def plain(text: str) -> str:
    """The text with the code of each character that is not printable, except for line breaks."""
    return "".join(
        character if character.isprintable() or character == "\n" else repr(character)[1:-1]
        for character in text
    )


def shown_points(points: float) -> str:
    """Points as a person writes them: 9, 8.5, 8.97."""
    rounded = round(points, 2) + 0.0  # and no -0.0
    return f"{rounded:.2f}".rstrip("0").rstrip(".")


def shown_name(student: str) -> str:
    """A student's id, whatever it holds, as part of one line."""
    return one_line(student, MOST_OF_A_NAME)


def shown_names(students: Iterable[str]) -> str:
    """Some students for one line: the first ten of them, and how many more there are."""
    names = [shown_name(student) for student in sorted(students)]
    more = f" and {len(names) - MOST_NAMES} more" if len(names) > MOST_NAMES else ""
    return f"{', '.join(names[:MOST_NAMES])}{more}"


def shown_note(note: str) -> str:
    """A note to the instructor, as part of one line."""
    return one_line(note, MOST_OF_A_NOTE)
