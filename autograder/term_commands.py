"""The commands around a term: hand-ins in, marks out, and a student who leaves."""

import argparse
import sys
from collections.abc import Callable
from datetime import UTC
from pathlib import Path

from autograder import arguments as argument
from autograder.terminal import say, shown_name, shown_note


def add_to(commands) -> None:
    """Add the commands to the parser's."""
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
    _add_roster(collecting)
    collecting.add_argument(
        "--latest", action="store_true", help="the last hand-in counts, though it is late"
    )
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
    _add_roster(exporting)
    forgetting = commands.add_parser(
        "forget", help="remove all that the course keeps about a student who has left it"
    )
    forgetting.add_argument("student", metavar="ID", help="the name of the student's folder")
    forgetting.add_argument("--yes", action="store_true", help="do not ask first")


def _add_roster(parser) -> None:
    parser.add_argument(
        "--roster", type=argument.there, help="the class list (default: course/class.csv)"
    )


def collect_zip(root: Path, given: argparse.Namespace) -> int:
    """Put hand-ins into course/submitted/; the exit status is 1 if one of them needs a look."""
    from autograder import lean, roster, term_calendar  # noqa: F401  before nbformat is imported
    from autograder.lms.collect import collect
    from autograder.nbgrader_glue.shelf import Submissions
    from autograder.pipeline import run as pipeline
    from autograder.pipeline.lock import locked

    path = given.roster or root / roster.FILE
    if not path.is_file():
        return _complain(
            f"there is no class list: write {roster.FILE}, with the first line "
            f"{','.join(roster.COLUMNS)} and a line for each student, or name one with --roster"
        )
    try:
        people = roster.read(path)
        calendar = term_calendar.read_if_there(root)
        shelf = Submissions(root, given.assignment)
        with locked(root / pipeline.LOCK, f"`autograder grade` is running in {root}"):
            done = collect(
                given.archives, given.assignment, people, calendar, shelf, given.sheet, given.latest
            )
    except (OSError, ValueError) as error:
        return _complain(str(error))
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
    return _list(done.faults)


def export(root: Path, given: argparse.Namespace) -> int:
    """Write the marks; the exit status is 1 if somebody's could not be."""
    from autograder import lean, roster, term_calendar  # noqa: F401  before nbformat is imported
    from autograder.files import put_in_place
    from autograder.lms import export as exporting
    from autograder.nbgrader_glue.marks import pages_of, read_marks

    if why := exporting.refusal(given):
        return _complain(why)
    try:
        calendar = term_calendar.read_if_there(root)
        people = roster.read(given.roster) if given.roster else roster.read_if_there(root)
        marks, lines = read_marks(root, people)
        chosen, left_out = exporting.chosen(marks, calendar, given)
        written = exporting.written(chosen, given, lambda: pages_of(root, given.assignment[0]))
        for path, content in written.files.items():
            put_in_place(path if path.is_absolute() else root / path, content, 0o600)
    except (OSError, ValueError) as error:
        return _complain(str(error))
    for line in [*lines, *left_out, *written.lines]:
        say(shown_note(line))
    return _list(written.faults)


def _list(faults: list[str]) -> int:
    """Say what needs a look; the exit status."""
    if faults:
        say("\nTo be looked at:")
    for fault in faults:
        say(f"  {shown_note(fault)}")
    return 1 if faults else 0


def forget(root: Path, given: argparse.Namespace) -> int:
    """Remove a student from the course, after asking; the exit status is 1 if nothing was removed."""
    from autograder import lean, roster  # noqa: F401  before nbformat is imported
    from autograder.nbgrader_glue.forget import mentions, traces
    from autograder.pipeline import run as pipeline
    from autograder.pipeline.lock import locked

    student = given.student
    if roster.UNFIT_ID.search(student) or not student.strip():
        return _complain(f"{student[:60]!r} is no student's id")
    shown = shown_name(student)
    try:
        with locked(root / pipeline.LOCK, f"`autograder grade` is running in {root}"):
            found = traces(root, student, pipeline.kept_about(root, student))
            if not found:
                return _complain(f"the course keeps nothing about {shown}", 1)
            say(f"Kept about {shown}:")
            for trace in found:
                say(f"  {shown_note(trace.what)}")
            for path in mentions(root, student):
                say(f"  {path.relative_to(root)} names the student, too, and will be left as it is")
            if not given.yes and not _agreed("Remove all of it? It cannot be undone. [y/N] "):
                return _complain("nothing was removed", 1)
            for trace in found:
                trace.remove()
    except (OSError, ValueError) as error:
        return _complain(str(error))
    say("Removed. Copies that you made elsewhere, and what the student fetched, are still there.")
    return 0


def _agreed(question: str) -> bool:
    try:
        return input(question).strip().casefold() in ("y", "yes")
    except EOFError:
        return False


COMMANDS: dict[str, Callable[[Path, argparse.Namespace], int]] = {
    "collect-zip": collect_zip,
    "export": export,
    "forget": forget,
}


def _complain(what: str, status: int = 2) -> int:
    say(f"autograder: {what}", sys.stderr)
    return status
