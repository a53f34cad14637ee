"""Checks, verdicts and grading of the course's problems."""

from autograder.check import check
from autograder.hints import hint
from autograder.look import look_at
from autograder.wall.languages import from_file

__all__ = ["check", "from_file", "hint", "look_at"]
