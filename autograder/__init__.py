"""Checks, verdicts and grading of the course's problems."""

from autograder.check import check

__all__ = ["check"]
