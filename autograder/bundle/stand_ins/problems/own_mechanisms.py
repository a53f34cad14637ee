"""Checks of mechanisms, `cart-pole-M`, as far as the class has their problems."""

from collections.abc import Mapping

from autograder import stored
from autograder.judging.check import Check


def check_of_file(id: str, files: Mapping[str, str]) -> Check | None:
    """No file is read here: what the class has is stored."""
    return None


def check_of_kit(id: str) -> Check | None:
    """The check of this id; None where the class has no such problem."""
    return next((check for check in stored.checks.checks("mechanisms") if check.id == id), None)


def files_here(id: str) -> dict[str, str]:
    return {}
