"""What `autograder export` writes: which assignments, for whom, and into which files."""

from argparse import Namespace
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from autograder.lms import canvas, moodle
from autograder.lms.feedback_archive import feedback_archive
from autograder.lms.fill import Filled, fill_gradebook, fill_worksheet
from autograder.lms.marks import Marks
from autograder.lms.table import long_table, wide_table
from autograder.roster import Roster
from autograder.term_calendar import CHALLENGE, Calendar

FOLDER = Path("course")
MOODLE, CANVAS, CSV = "moodle", "canvas", "csv"


@dataclass
class Written:
    """Files with what is in them, and what is to be said."""

    files: dict[Path, str | bytes] = field(default_factory=dict)
    lines: list[str] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)


def refusal(given: Namespace) -> str:
    """Why the options do not go together; empty if they do."""
    name = {MOODLE: "Moodle's grading worksheet", CANVAS: "the gradebook that Canvas exports"}
    if given.platform in name and not given.sheet:
        return f"--for {given.platform} fills a sheet in: give {name[given.platform]} with --sheet"
    if given.platform == CSV and given.sheet:
        return "--sheet goes with --for moodle or --for canvas"
    if given.platform == MOODLE and len(given.assignment) != 1:
        return "Moodle's worksheet is about one assignment: name it"
    if given.feedback and given.platform != MOODLE:
        return "--feedback goes with --for moodle"
    if given.wide and given.platform != CSV:
        return "--wide goes with --for csv"
    if given.count and given.leave_out:
        return "give --count or --leave-out, not both"
    if given.assignment and (given.count or given.leave_out):
        return "name the assignments, or give --count or --leave-out, not both"
    to = given.to or _default(given.platform)
    if given.sheet and to.resolve() == given.sheet.resolve():
        return (
            f"{to} would overwrite the sheet that {given.platform} gave out: write to another file"
        )
    return ""


def chosen(marks: Marks, calendar: Calendar, given: Namespace) -> tuple[Marks, list[str]]:
    """The columns that count, and a line on those that do not. ValueError for one that is not there."""
    known = [one.assignment for one in marks.columns]
    if not known:
        raise ValueError("the gradebook is empty: run `nbgrader generate_assignment` first")
    named = [Path(one).name for one in given.assignment] or given.count
    for name in [*(named or []), *(given.leave_out or [])]:
        if name not in known:
            raise ValueError(
                f"the gradebook does not know {name}; it has {', '.join(known) or 'none'}"
            )
    if named:
        wanted = [name for name in known if name in named]
    elif given.leave_out:
        wanted = [name for name in known if name not in given.leave_out]
    else:
        wanted = [name for name in known if calendar.counts(name)]
    left_out = [name for name in known if name not in wanted]
    lines = []
    if left_out and not given.assignment:
        why = "the challenges among them do not count by themselves" if any(
            CHALLENGE.match(name) for name in left_out) and not given.leave_out else ""  # fmt: skip
        lines.append(f"not counted: {', '.join(left_out)}{f' ({why})' if why else ''}")
    columns = [one for one in marks.columns if one.assignment in wanted]
    return Marks(marks.people, columns), lines


def written(marks: Marks, given: Namespace, pages: Callable[[], dict[str, list[Path]]]) -> Written:
    """What goes into which file. pages: the feedback pages by student. ValueError, OSError."""
    to, done = given.to or _default(given.platform), Written()
    if given.platform == CSV:
        make = wide_table if given.wide else long_table
        done.files[to] = "\ufeff" + make(marks, given.with_unread)  # so that Excel reads UTF-8
        names = ", ".join(one.assignment for one in marks.columns)
        done.lines.append(f"{len(marks.people)} students; {names or 'no assignment'}: {to}")
        return done
    people = Roster({one.id: one for one in marks.people})
    how = given.with_unread, given.scale
    if given.platform == MOODLE:
        worksheet = moodle.read(given.sheet, given.grade_column)
        filled, found = fill_worksheet(worksheet, marks.columns[0], people, *how)
        done.files[to] = worksheet.sheet.text()
        _say(done, filled, to)
        if given.feedback:
            data, without = feedback_archive(found, pages())
            done.files[given.feedback] = data
            count = f"{len(found) - len(without)} students' pages, {len(without)} have none"
            done.lines.append(f"feedback: {count}: {given.feedback}")
            if found and len(without) == len(found):
                name = marks.columns[0].assignment
                done.lines.append(f"to make the pages, run `nbgrader generate_feedback {name}`")
        return done
    book = canvas.read(given.sheet)
    named = {assignment: book.sheet.column(heading) for assignment, heading in given.column}
    columns = {one.assignment: named[one.assignment] if one.assignment in named
               else book.column_of(one.assignment) for one in marks.columns}  # fmt: skip
    if twice := [at for at in columns.values() if list(columns.values()).count(at) > 1]:
        raise ValueError(f"two assignments would go into the column {book.sheet.head[twice[0]]!r}")
    filled = fill_gradebook(book, marks, columns, people, *how)
    done.files[to] = book.sheet.text()
    _say(done, filled, to)
    return done


def _default(platform: str) -> Path:
    return FOLDER / ("marks.csv" if platform == CSV else f"marks-{platform}.csv")


def _say(done: Written, filled: Filled, to: Path) -> None:
    done.lines.append(f"{filled.marks} marks written: {to}")
    done.lines += [
        f"left as they were: {count}, {why}" for why, count in sorted(filled.left.items())
    ]
    done.faults += filled.faults
