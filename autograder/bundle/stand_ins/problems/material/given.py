"""The functions that problems give for a member of the family, as they were written for the class."""

from autograder import stored
from autograder.problems.material.described import Described


def code(own: Described, problem: str) -> str:
    """The functions that this problem gives, one below the other; "" where it gives none."""
    return stored.files.read("given").get(problem, {}).get(own.name, "")
