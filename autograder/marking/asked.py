"""Reads what a page sends: points and comments; the rest is refused in a sentence."""

import math
from collections.abc import Sequence

from autograder.marking.kept import Met
from autograder.marking.rubric import Row

LONGEST_COMMENT = 20_000


class AskedError(ValueError):
    """A request cannot be met; the message says why, to the marker."""


def asked_rows(given: object, rows: Sequence[Row]) -> list[Met]:
    """Points for each row of the rubric."""
    if not isinstance(given, list) or len(given) != len(rows):
        raise AskedError("The table of points has changed: load the page again.")
    return [
        Met(row.text, row.points, _number(points, row.points, f"Row {number}"))
        for number, (row, points) in enumerate(zip(rows, given, strict=True), 1)
    ]


def asked_points(total: object, most: float, rows: list[Met]) -> float:
    """Points for the whole answer: the given total, or without one the sum of the rows."""
    if total is None and not rows:
        raise AskedError("Type the points for the whole answer first.")
    if total is None:
        total = round(sum(row.given for row in rows), 2)
    return _number(total, most, "The whole answer")


def asked_comment(comment: object) -> str:
    if not isinstance(comment, str) or len(comment) > LONGEST_COMMENT:
        raise AskedError(f"A comment has at most {LONGEST_COMMENT} characters.")
    return comment.strip()


def _number(points: object, most: float, what: str) -> float:
    if isinstance(points, bool) or not isinstance(points, int | float):
        points = math.nan
    if not 0 <= points <= most:
        raise AskedError(f"{what} takes 0 to {most:g} points.")
    return round(float(points), 2)
