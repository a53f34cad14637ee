"""What may stand behind the options of the `autograder` command; other texts are refused in a sentence.

Each function reads an argument's text, and raises ArgumentTypeError with what is wrong, and an example.
"""

import os
import re
from argparse import ArgumentTypeError
from datetime import datetime
from pathlib import Path

from autograder.worked_answers import time_of

MOST_JOBS = 1000
LONGEST_NAME = 100
_SCHEDULER = re.compile(r"(?:(?:tcp|tls|ucx|wss?)://)?(?:[^\s/:]+|\[[0-9a-fA-F:]+\]):(\d{1,5})")


def processes(text: str) -> int:
    if not re.fullmatch(r"\d{1,6}", text) or not 1 <= int(text) <= MOST_JOBS:
        raise ArgumentTypeError(f"{text!r} is no number from 1 to {MOST_JOBS}, such as 4")
    return int(text)


def scheduler(text: str) -> str:
    """The address of a Dask scheduler."""
    found = _SCHEDULER.fullmatch(text)
    if not found or not 1 <= int(found[1]) <= 65535:
        raise ArgumentTypeError(f"{text!r} is no address with a port, such as tcp://10.0.0.5:8786")
    return text


def port(text: str) -> int:
    if not re.fullmatch(r"\d{1,5}", text) or not 1024 <= int(text) <= 65535:
        raise ArgumentTypeError(f"{text!r} is no port from 1024 to 65535, such as 8899")
    return int(text)


def time(text: str) -> datetime:
    """A time, with its zone."""
    try:
        found = time_of(text)
    except ValueError as error:
        raise ArgumentTypeError(str(error)) from None
    if found is None:
        raise ArgumentTypeError(f"{text!r} is no time; there is --full-marks for that")
    return found


def name(text: str) -> str:
    """The name of an assignment or a mechanism, or the path of its folder or file."""
    if len(Path(text).name) > LONGEST_NAME:
        raise ArgumentTypeError(f"this name has more than {LONGEST_NAME} characters")
    return text


def mechanism(text: str) -> str:
    if not text.strip():
        raise ArgumentTypeError("name a mechanism, such as cart-pole")
    return name(text)


def answers(text: str) -> list[str]:
    """The names of answers, as "M,C" or "M, C"."""
    found = [one.strip() for one in text.split(",")]
    if not all(found):
        raise ArgumentTypeError(f"{text!r} has no name before or behind a comma; write it as M,C")
    return found


def there(text: str) -> Path:
    """A file or a folder that is there."""
    if not os.path.exists(text):
        raise ArgumentTypeError(f"there is no file {text[:LONGEST_NAME]!r}")
    return Path(text)


def pair(text: str) -> tuple[str, str]:
    """An assignment and a heading, as "p3-pendulum=Homework 3 (123)"."""
    assignment, equals, heading = text.partition("=")
    if not (assignment.strip() and equals and heading.strip()):
        raise ArgumentTypeError(f"{text[:LONGEST_NAME]!r} is no ASSIGNMENT=HEADING")
    return assignment.strip(), heading.strip()


def new_file(text: str) -> Path:
    """A file that can be written, or written over."""
    path = Path(text)
    if not path.parent.is_dir():
        raise ArgumentTypeError(f"there is no folder {path.parent} to put {path.name} in")
    if not text or path.is_dir():
        raise ArgumentTypeError(f"{text!r} is no name of a file, such as said.txt")
    return path
