"""A line as it was handed over: a formula, and the names of its reasons."""

import difflib
import re
from collections.abc import Collection
from dataclasses import dataclass
from typing import Self

MOST_OF_A_REASON = 60  # characters that are quoted


@dataclass(frozen=True)
class Line:
    """text: a formula. reasons: names of reasons, known or not."""

    text: str
    reasons: tuple[str, ...]

    @classmethod
    def read(cls, parts: tuple[str, ...], known: Collection[str]) -> Self:
        """A known reason may be typed with other capitals, hyphens and blanks."""
        spelled = {_letters(name): name for name in known}
        text, *reasons = parts
        return cls(
            text, tuple(spelled.get(_letters(name), name[:MOST_OF_A_REASON]) for name in reasons)
        )


def nearest(name: str, known: Collection[str]) -> str:
    """The known reason whose spelling is nearest, or ""."""
    spelled = {_letters(other): other for other in known}
    found = difflib.get_close_matches(_letters(name), spelled, 1, cutoff=0.6)
    return spelled[found[0]] if found else ""


def _letters(name: str) -> str:
    return re.sub(r"[^a-z0-9]", "", name.casefold())
