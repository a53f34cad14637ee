"""Checks, verdicts and grading of the course's problems."""

from autograder.check import check
from autograder.hints import hint

__all__ = ["check", "hint"]
