"""Opens worked answers to students."""

import argparse
from datetime import datetime
from pathlib import Path

from autograder import arguments as argument
from autograder.commands.assignments import name_of, unknown
from autograder.commands.saying import complain
from autograder.terminal import say


def add_to(commands) -> None:
    opening = commands.add_parser(
        "open-solution",
        help="let students see an assignment's worked answers with solution(), now or from a time on",
    )
    opening.add_argument(
        "assignment",
        nargs="?",
        type=argument.name,
        help="its name in solutions/ (default: all whose time has come)",
    )
    opening.add_argument(
        "--on",
        type=argument.time,
        metavar="TIME",
        help="from then on, as 2026-12-15 or 2026-12-15T12:00 (default: now)",
    )
    opening.add_argument(
        "--full-marks",
        action="store_true",
        help="on the feedback pages, for each check of which a student has all points",
    )
    opening.set_defaults(run=run)


def run(root: Path, given: argparse.Namespace) -> int:
    """Open an assignment's worked answers to students; without a name, all whose time has come."""
    from autograder.nbgrader_glue.worked import open_answers, settings
    from autograder.worked_answers import FULL_MARKS

    assignment, on, full_marks = given.assignment, given.on, given.full_marks
    if on is not None and full_marks:
        return complain("give --on or --full-marks, not both")
    if assignment is None and (on is not None or full_marks):
        return complain("name the assignment whose answers open then")
    if assignment is not None and (why := unknown(root, name_of(assignment))):
        return complain(why)
    when = FULL_MARKS if full_marks else (on or datetime.now()).isoformat()
    asked = settings(root) if assignment is None else {name_of(assignment): when}
    try:
        for line in open_answers(root, asked):
            say(line)
    except (OSError, ValueError) as error:
        return complain(str(error))
    return 0
