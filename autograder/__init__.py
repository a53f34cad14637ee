"""Checks a student's answers to the course's problems, and grades submissions."""

from autograder.protocol.languages import from_file
from autograder.student.cell import check
from autograder.student.derivation import derivation
from autograder.student.hints import hint
from autograder.student.look import look_at
from autograder.student.own_arm import own_arm
from autograder.student.solution import solution
from autograder.student.watch import watch
from autograder.student.worst_case import worst_case

__all__ = [
    "check", "derivation", "from_file", "hint", "look_at", "own_arm", "solution", "watch",
    "worst_case",
]  # fmt: skip
