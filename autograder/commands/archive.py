"""Closes a year: one archive of all that must be kept, and then, if asked for, an empty course/."""

import argparse
import sys
import tempfile
from datetime import date
from itertools import chain, count
from pathlib import Path

from autograder import arguments as argument
from autograder.commands.saying import agreed, complain, to_be_looked_at
from autograder.terminal import say, shown_note

FOLDER = Path("archive")


def add_to(commands) -> None:
    archiving = commands.add_parser(
        "archive", help="close a year: one archive of all that must be kept"
    )
    archiving.add_argument(
        "--to",
        type=argument.new_file,
        metavar="ZIP",
        help="where to write (default: archive/, with the course's name and the day)",
    )
    archiving.add_argument(
        "--anyway",
        action="store_true",
        help="also where a proof is not yet marked, or feedback not released",
    )
    archiving.add_argument(
        "--pseudonyms",
        action="store_true",
        help="write a second archive with the marks alone, without names",
    )
    archiving.add_argument(
        "--empty",
        action="store_true",
        help="then remove from course/ what is in the archive, after asking",
    )
    archiving.add_argument(
        "--keep-class", action="store_true", help="with --empty: leave course/class.csv"
    )
    archiving.add_argument(
        "--keep-calendar",
        action="store_true",
        help="with --empty: leave the calendar as course/calendar-of-last-year.toml, without "
        "extensions, to write the next one by",
    )
    archiving.add_argument("--yes", action="store_true", help="do not ask first")
    archiving.set_defaults(run=run)


def run(root: Path, given: argparse.Namespace) -> int:
    """Archive the course; the exit status is 1 if something is open, left out or left where it was."""
    from autograder.nbgrader_glue.closing import Closing
    from autograder.pipeline import run as pipeline
    from autograder.pipeline.lock import locked

    if (given.keep_class or given.keep_calendar) and not given.empty:
        return complain("--keep-class and --keep-calendar say what --empty leaves: add --empty")
    if not (root / "course").is_dir():
        return complain("there is no course/ to archive", 1)
    try:
        with locked(root / pipeline.LOCK, f"`autograder grade` is running in {root}"):
            return _close(root, Closing(root), given)
    except (OSError, ValueError) as error:
        return complain(str(error))


def _close(root: Path, course, given: argparse.Namespace) -> int:
    from autograder.year.emptying import last_calendar

    to = (
        root / given.to
        if given.to
        else _unused(root / FOLDER / f"{course.name}-{date.today()}.zip")
    )
    nameless = to.with_name(f"{to.stem}-without-names.zip")
    for path in (to, *([nameless] if given.pseudonyms else [])):
        if path.exists():
            return complain(f"{path} is there already: name another file with --to")
        if path.resolve().is_relative_to((root / "course").resolve()):
            return complain(f"{path} lies in course/, which it is to hold: choose another folder")
    calendar = last_calendar(root) if given.keep_calendar else ""
    marks = _marks(root)
    if todo := list(course.still_open(marks)):
        say("Still open:", sys.stderr)
        for line in todo:
            say(f"  {shown_note(line)}", sys.stderr)
        if not given.anyway:
            return complain("nothing was written; --anyway writes the archive all the same", 1)
    to.parent.mkdir(mode=0o700, exist_ok=True)
    kept, faults = _whole(root, course, marks, to)
    if given.pseudonyms:
        _nameless(root, course, marks, nameless)
    if not given.empty:
        return to_be_looked_at(faults)
    return _empty(root, course, given, kept, faults, calendar)


def _unused(path: Path) -> Path:
    """The path, or with "-2" and so on before its end if there is such a file."""
    others = (path.with_name(f"{path.stem}-{number}.zip") for number in count(2))
    return next(one for one in chain([path], others) if not one.exists())


def _marks(root: Path):
    """Those of all who are in the class list, in the gradebook, or handed something in."""
    from autograder import roster
    from autograder.lms.marks import Marks
    from autograder.nbgrader_glue.marks import read_marks

    listed = roster.read_if_there(root)
    marks, lines = read_marks(root, None)
    for line in lines:
        say(shown_note(line))
    people = {one.id: one for one in marks.people} | (listed.people if listed else {})
    return Marks(list(people.values()), marks.columns)


def _whole(root: Path, course, marks, to: Path) -> tuple[dict[str, str], list[str]]:
    """Write the archive; the sums of the files in the course's folder, and what was left out."""
    from autograder.lms.table import long_table, wide_table
    from autograder.nbgrader_glue.closing import GRADEBOOK
    from autograder.year import about, archive
    from autograder.year.holdings import holdings

    found = holdings(root)
    if elsewhere := course.exchange_elsewhere:
        found.left.append(f"the exchange, {elsewhere}: it is outside of course/ and stays as it is")
    with tempfile.TemporaryDirectory(prefix="archive-") as folder:
        copy, original = Path(folder) / GRADEBOOK.name, course.file_of_gradebook
        before = archive.sum_of(original) if original else ""
        course.copy_gradebook(copy)
        contents: dict[str, Path | bytes] = {
            "ABOUT.txt": about.about(about.WHOLE, course.name, root, marks, found.left),
            "marks.csv": long_table(marks).encode("utf-8-sig"),
            "marks-by-student.csv": wide_table(marks).encode("utf-8-sig"),
            **found.files,
            GRADEBOOK.as_posix(): copy,
        }
        sums = archive.write(to, to.stem, contents)
    if original:
        sums[GRADEBOOK.as_posix()] = before  # of the file itself, which is what may be removed
    size = to.stat().st_size / 1e6
    say(f"{to}: {len(contents)} files, {size:.1f} MB, read back and found whole")
    return {name: one for name, one in sums.items() if name in found.files}, found.left


def _nameless(root: Path, course, marks, to: Path) -> None:
    from autograder.lms.table import long_table, wide_table
    from autograder.year import about, archive
    from autograder.year.without_names import without_names

    marks = without_names(marks)
    contents = {
        "ABOUT.txt": about.about(about.NAMELESS, course.name, root, marks),
        "marks.csv": long_table(marks).encode("utf-8-sig"),
        "marks-by-student.csv": wide_table(marks).encode("utf-8-sig"),
    }
    archive.write(to, to.stem, contents)
    say(f"{to}: the marks of {len(marks.people)} students, without names")


def _empty(
    root: Path, course, given, kept: dict[str, str], faults: list[str], calendar: str
) -> int:
    from autograder import roster
    from autograder.files import put_in_place
    from autograder.year.emptying import LAST_CALENDAR, empty

    stays = {roster.FILE.as_posix()} if given.keep_class else set()
    files = sum(name.startswith("course/") for name in kept)
    asked = f"Remove these {files} files from {root / 'course'}? They are in the archive. [y/N] "
    if not given.yes and not agreed(asked):
        return complain("course/ stays as it is", 1)
    faults += empty(root, kept, stays)
    if calendar:
        put_in_place(root / LAST_CALENDAR, calendar, 0o600)
    say(
        "course/ is empty for the next year: write its class list and calendar, and copy the archive"
    )
    say(
        "to a safe place. What students fetched, and copies that you made elsewhere, are still there."
    )
    if not course.file_of_gradebook:
        faults.append(
            f"the gradebook is still in {course.address_of_gradebook}: make a new database, and name "
            "it in db_url of nbgrader_config.py"
        )
    return to_be_looked_at(faults)
