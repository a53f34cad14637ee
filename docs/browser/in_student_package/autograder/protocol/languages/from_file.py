"""from_file("M.cpp") in a browser, which builds and starts no other programs: it says so."""

import sys
from collections.abc import Callable

from ..readings import FaultKind, NotNumbersError

NOT_HERE = "a browser runs no answers in other languages; a computer that has the course does."


def from_file(name: str) -> Callable:
    """A function that raises NotNumbersError in each call; why is printed at once.

    name: of the file.
    """
    said = f"{name}: {NOT_HERE}"
    print(said, file=sys.stderr)

    def of_no_browser(*given):
        raise NotNumbersError(FaultKind.NO_TOOLS, said)

    return of_no_browser


def missing() -> list[str]:
    """A line for each language whose answers cannot run here; only the grader asks."""
    return []
