"""What a card says of calls, in sentences and in Python that can be pasted; and how it fills lines."""

from __future__ import annotations

import textwrap
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from autograder.judging.verdict import Failed, Witness

LONGEST_INSIDE = 90  # characters: longer Python does not stand in a sentence
LONGEST_IN_TEXT = 300  # characters of what a notebook would fold


@dataclass(frozen=True)
class Passage:
    """A part of a card: a sentence, and the Python that it leads to.

    kind: what it is about. inside: what in the sentence is Python. code: lines of Python below it.
    folded: whether a notebook hides them until they are asked for.
    """

    kind: str
    text: str
    inside: str = ""
    code: str = ""
    folded: bool = False


def if_said(kind: str, text: str) -> list[Passage]:
    """One passage, or none of an empty text."""
    return [Passage(kind, text)] if text else []


def as_text(passage: Passage) -> str:
    """The passage in plain text; "" where that has no room for its code."""
    if passage.folded and len(passage.code) > LONGEST_IN_TEXT:
        return ""
    code = [_code(line) for line in passage.code.splitlines()]
    return "\n".join([filled(passage.text), *code])


def filled(text: str, indent: int = 2, kept: str = "") -> str:
    """A sentence as lines of at most 78 characters. kept: what in it stays on one line, such as Python
    that does not run when it is broken.
    """
    if kept:
        text = text.replace(kept, kept.replace(" ", "\N{NO-BREAK SPACE}"))
    return _wrapped(text, indent, not kept).replace("\N{NO-BREAK SPACE}", " ")


def _code(line: str) -> str:
    """A line of Python, which may break at a blank within its brackets."""
    return _wrapped(line, 6, False) if "(" in line else f"{6 * ' '}{line}"


def _wrapped(text: str, indent: int, break_words: bool) -> str:
    margin = " " * indent
    return textwrap.fill(
        text, 78, initial_indent=margin, subsequent_indent=margin,
        break_on_hyphens=False, break_long_words=break_words,
    )  # fmt: skip


def worst_case(witness: Witness) -> list[Passage]:
    """The witness as a sentence, and its call in numbers where the sentence has no room for it."""
    call, numbers = _inside_and_below(witness.call, witness.by_name)
    if not witness.off:  # a truth value is right or wrong, not more or less
        said = f"{call or 'your function'} gave {witness.returned}"
    elif call:
        said = f"{call} gave {witness.returned}, off by {witness.off}"
    else:
        said = f"{f'{witness.where} is ' if witness.where else ''}off by {witness.off}"
    return [Passage("witness", f"Worst case: {said}.", call), *numbers]


def _inside_and_below(call: str, by_name: str) -> tuple[str, list[Passage]]:
    """A call as it stands in a sentence, and what stands below that: a long call in its numbers."""
    if len(call) <= LONGEST_INSIDE or call == by_name or not by_name:
        return call, []
    return by_name, [Passage("numbers", "This call in numbers:", code=call, folded=True)]


def failing(failed: Failed) -> list[Passage]:
    """Which calls fail and which work."""
    if failed.tried == 0:
        said = "The check stopped at this call"
    elif failed.tried == 1:
        said = "The one call failed"
    elif failed.count == failed.tried == 2:
        said = "Both calls failed, the first of them"
    elif failed.count == failed.tried:
        said = f"All {failed.tried} calls failed, the first of them"
    elif failed.count == 1:
        said = f"1 of {failed.tried} calls failed"
    else:
        said = f"{failed.count} of {failed.tried} calls failed, the first of them"
    call, numbers = _inside_and_below(failed.call, failed.by_name)
    found = [Passage("failed", f"{said}: {call}", call), *numbers]
    if not failed.works:
        return found
    if len(failed.works) > LONGEST_INSIDE:
        return [*found, Passage("works", "This one works:", code=failed.works, folded=True)]
    return [*found, Passage("works", f"This one works: {failed.works}", failed.works)]
