"""Takes hand-ins out of archives of Moodle or Canvas."""

import argparse
from datetime import UTC
from pathlib import Path

from autograder import arguments as argument
from autograder.commands.assignments import add_roster, known, name_of, unknown
from autograder.commands.saying import complain, to_be_looked_at
from autograder.terminal import say, shown_name, shown_note


def add_to(commands) -> None:
    collecting = commands.add_parser(
        "collect-zip", help="take hand-ins out of the archives of Moodle or Canvas"
    )
    collecting.add_argument("assignment", type=argument.name, help="such as p3-pendulum")
    collecting.add_argument(
        "archives",
        nargs="+",
        type=argument.there,
        metavar="ARCHIVE",
        help="a zip archive, or a folder it was unpacked to; several in the order of their download",
    )
    collecting.add_argument(
        "--sheet",
        type=argument.there,
        help="Moodle's grading worksheet of this assignment, for the times and for names that are not "
        "unique; or Canvas's gradebook",
    )
    add_roster(collecting)
    collecting.add_argument(
        "--latest", action="store_true", help="the last hand-in counts, though it is late"
    )
    collecting.set_defaults(run=run)


def run(root: Path, given: argparse.Namespace) -> int:
    """Put hand-ins into course/submitted/; the exit status is 1 if one of them needs a look."""
    from autograder import roster, term_calendar
    from autograder.lms.collect import collect
    from autograder.nbgrader_glue.shelf import Submissions
    from autograder.pipeline import run as pipeline
    from autograder.pipeline.lock import locked

    given.assignment = name_of(given.assignment)
    if why := unknown(root, given.assignment):
        return complain(why)
    path = given.roster or root / roster.FILE
    if not path.is_file():
        return complain(
            f"there is no class list: write {roster.FILE}, with the first line "
            f"{','.join(roster.COLUMNS)} and a line for each student, or name one with --roster"
        )
    try:
        people = roster.read(path)
        calendar = term_calendar.read_if_there(root)
        shelf = Submissions(root, given.assignment)
        with locked(root / pipeline.LOCK, f"`autograder grade` is running in {root}"):
            done = collect(
                given.archives, given.assignment, people, calendar, shelf, given.sheet, given.latest,
                others=known(root),
            )  # fmt: skip
    except (OSError, ValueError) as error:
        return complain(str(error))
    zone = calendar.zone or UTC
    for line in done.lines:
        what = "taken" if line.changed else "left"
        when = (
            f"{line.when.astimezone(zone):%Y-%m-%d %H:%M %Z}" if line.when else "at no known time"
        )
        said = [f"{shown_name(line.student)}: {what}, handed in {when}", *line.notes]
        say(shown_note("; ".join(said)))
    taken = sum(line.changed for line in done.lines)
    left, missing = len(done.lines) - taken, len(people.people) - len(done.lines)
    say(f"\n{taken} taken, {left} left as they were, {missing} of the class not there")
    return to_be_looked_at(done.faults)
