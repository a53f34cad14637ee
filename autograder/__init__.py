"""Checks, verdicts and grading of the course's problems."""

from autograder.check import check
from autograder.hints import hint
from autograder.wall.languages import from_file

__all__ = ["check", "from_file", "hint"]
