"""The arms of the family as they are described; their equations are not in a student's package."""

from autograder.problems.material.described import SLOPE, Described, drawn_of, family, folded

__all__ = ["BOOK", "FAMILY", "SLOPE", "Convention", "drawn", "folded"]

Convention = Described
BOOK = Described()
FAMILY = family(Described)


def drawn(name: str, year: int = 0) -> Described:
    """The member of the student with this name, as `drawn_of` tells."""
    return drawn_of(FAMILY, name, year)
