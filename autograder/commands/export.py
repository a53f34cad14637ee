"""Puts marks into a sheet of Moodle or Canvas, or writes a table."""

import argparse
from pathlib import Path

from autograder import arguments as argument
from autograder.commands.assignments import add_roster, name_of, unknown
from autograder.commands.saying import complain, to_be_looked_at
from autograder.terminal import say, shown_note


def add_to(commands) -> None:
    exporting = commands.add_parser(
        "export", help="put the marks into a sheet of Moodle or Canvas, or write a table"
    )
    exporting.add_argument(
        "assignment",
        nargs="*",
        type=argument.name,
        help="such as p3-pendulum (default: all that count); Moodle's sheet takes one",
    )
    exporting.add_argument(
        "--for", dest="platform", choices=("moodle", "canvas", "csv"), default="csv"
    )
    exporting.add_argument(
        "--sheet", type=argument.there, help="the sheet that Moodle or Canvas gave out"
    )
    exporting.add_argument(
        "--to",
        type=argument.new_file,
        metavar="FILE",
        help="where to write (default: course/marks.csv, or course/marks-moodle.csv and the like)",
    )
    exporting.add_argument("--wide", action="store_true", help="one row a student")
    exporting.add_argument(
        "--count",
        type=argument.answers,
        metavar="A,B",
        help="these alone count, as p1-inertia,p2-…",
    )
    exporting.add_argument(
        "--leave-out", type=argument.answers, metavar="A,B", help="these do not count"
    )
    exporting.add_argument(
        "--with-unread",
        action="store_true",
        help="give points also where a proof is not yet marked: the checks', and those suggested",
    )
    exporting.add_argument(
        "--scale", action="store_true", help="to the points of the platform, where they are others"
    )
    exporting.add_argument(
        "--grade-column",
        metavar="HEADING",
        help="where Moodle's sheet has the grades, if not found",
    )
    exporting.add_argument(
        "--column",
        action="append",
        default=[],
        type=argument.pair,
        metavar="ASSIGNMENT=HEADING",
        help="where Canvas's sheet has an assignment's marks, if not found by its title",
    )
    exporting.add_argument(
        "--feedback",
        type=argument.new_file,
        metavar="ZIP",
        help="write the feedback pages, too, as the archive that Moodle takes in",
    )
    add_roster(exporting)
    exporting.set_defaults(run=run)


def run(root: Path, given: argparse.Namespace) -> int:
    """Write the marks; the exit status is 1 if somebody's could not be."""
    from autograder import roster, term_calendar
    from autograder.files import put_in_place
    from autograder.lms import export as exporting
    from autograder.nbgrader_glue.marks import pages_of, read_marks

    given.assignment = [name_of(name) for name in given.assignment]
    for name in given.assignment:
        if why := unknown(root, name):
            return complain(why)
    if why := exporting.refusal(given):
        return complain(why)
    try:
        calendar = term_calendar.read_if_there(root)
        people = roster.read(given.roster) if given.roster else roster.read_if_there(root)
        marks, lines = read_marks(root, people)
        chosen, left_out = exporting.chosen(marks, calendar, given)
        written = exporting.written(chosen, given, lambda: pages_of(root, given.assignment[0]))
        for path, content in written.files.items():
            put_in_place(path if path.is_absolute() else root / path, content, 0o600)
    except (OSError, ValueError) as error:
        return complain(str(error))
    for line in [*lines, *left_out, *written.lines]:
        say(shown_note(line))
    return to_be_looked_at(written.faults)
