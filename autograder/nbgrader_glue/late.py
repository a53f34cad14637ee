"""Late penalties: the calendar's, or nbgrader's where it names none; kept right in the gradebook.

nbgrader sets a penalty when it grades, from the points that there are then. Points that a person gives
later, and a changed due date or extension, need another; for that, nothing has to be judged again.
"""

from collections.abc import Iterator
from datetime import datetime, timedelta
from pathlib import Path

from nbgrader import api
from nbgrader.converters import Autograde
from nbgrader.coursedir import CourseDirectory
from nbgrader.preprocessors import AssignLatePenalties
from sqlalchemy import select
from sqlalchemy.orm import selectinload
from traitlets.config import Config

from autograder import roster, term_calendar
from autograder.nbgrader_glue.folders import QUIET
from autograder.nbgrader_glue.release import configuration
from autograder.roster import Roster
from autograder.term_calendar import Assignment, Calendar, in_utc
from autograder.terminal import plain, shown_name, shown_points

MOST_LINES = 10  # for each assignment


class Lateness:
    """What the calendar and nbgrader_config.py say of being late with one assignment."""

    def __init__(self, said: Assignment, config: Config, converter):
        self._said = said
        plugin = AssignLatePenalties(parent=converter, config=config)
        plugin.init_plugin()
        self._plugin = plugin.plugin_inst if plugin.enabled else None

    @property
    def due(self) -> datetime | None:
        """The calendar's due date in UTC; None if it has none, and the gradebook's counts."""
        return in_utc(self._said.due) if self._said.due else None

    def extension(self, student: str) -> timedelta | None:
        given = self._said.extensions.get(student)
        return in_utc(given) - in_utc(self._said.due) if given and self._said.due else None

    def penalty(self, student: str, score: float, seconds: float) -> float | None:
        """Between 0 and the score; None if there is none. seconds: how late, more than 0."""
        if self._said.penalty is not None:
            return self._said.penalty.of(score, seconds) or None
        if self._plugin is None:
            return None
        penalty = self._plugin.late_submission_penalty(student, score, seconds)
        return None if penalty is None else min(max(penalty, 0), score)


def read_files(root: Path) -> tuple[Calendar, Roster | None]:
    """The calendar and the class list. CalendarError or RosterError if one of them is wrong."""
    return term_calendar.read_if_there(root), roster.read_if_there(root)


def settle(root: Path, gradebook: api.Gradebook) -> list[str]:
    """Set due dates, extensions and late penalties in the gradebook, and the names of the class list;
    what has changed but for names, in lines.

    CalendarError if the calendar is wrong, RosterError if the class list is.
    """
    calendar, people = read_files(root)
    lines: list[str] = []
    listed = people.people if people else {}
    for student in gradebook.students:
        if one := listed.get(student.id):
            student.last_name, student.first_name = one.last_name, one.first_name
            student.email, student.lms_user_id = one.email, one.lms_id
    for assignment in gradebook.assignments:
        config = configuration(root)
        config.CourseDirectory.assignment_id = assignment.name
        course = CourseDirectory(config=config, log=QUIET)
        converter = Autograde(coursedir=course, config=config, log=QUIET)
        lateness = Lateness(calendar.of(assignment.name), config, converter)
        changed = list(settle_one(gradebook.db, assignment, lateness))
        lines += changed[:MOST_LINES]
        if len(changed) > MOST_LINES:
            lines.append(
                f"{assignment.name}: {len(changed) - MOST_LINES} more changes of this kind"
            )
    gradebook.db.commit()
    return lines


def settle_course(root: Path) -> list[str]:
    """`settle` for the course in the folder `root`."""
    config = configuration(root)
    config.CourseDirectory.assignment_id = "of the term"
    course = CourseDirectory(config=config, log=QUIET)
    with api.Gradebook(course.db_url, course.course_id) as gradebook:
        return settle(root, gradebook)


def settle_before(converter) -> None:
    """For a command of nbgrader: settle what pages will show, and say what has changed."""
    course = converter.coursedir
    with api.Gradebook(course.db_url, course.course_id) as gradebook:
        for line in settle(Path(course.root), gradebook):
            converter.log.warning(plain(line))


def settle_one(db, assignment, lateness: Lateness) -> Iterator[str]:
    """Set those of one assignment; what changes, in lines. Nothing is committed yet."""
    if lateness.due is not None and assignment.duedate != lateness.due:
        if assignment.duedate is not None:
            yield f"{assignment.name}: due {lateness.due} UTC, and not {assignment.duedate}"
        assignment.duedate = lateness.due
    wanted = select(api.SubmittedAssignment).where(
        api.SubmittedAssignment.assignment_id == assignment.id
    )
    with_score = selectinload(api.SubmittedAssignment.notebooks).undefer(
        api.SubmittedNotebook.score
    )
    for submission in db.scalars(wanted.options(with_score)):
        student = submission.student_id
        shown = f"{assignment.name}: {shown_name(student)}"
        extension = lateness.extension(student)
        if lateness.due is not None and submission.extension != extension:
            if submission.extension is not None:
                yield f"{shown}: {_words(extension)}, and not {_words(submission.extension)}"
            submission.extension = extension
        seconds = seconds_late(assignment.duedate, submission)
        for notebook in submission.notebooks:
            before = notebook.late_submission_penalty or 0.0
            score = notebook.score or 0.0
            now = lateness.penalty(student, score, seconds) if seconds > 0 else None
            if abs((now or 0.0) - before) > 1e-9:
                notebook.late_submission_penalty = now
                points = f"{shown_points(now or 0.0)} points off, and not {shown_points(before)}"
                yield f"{shown}: late: {points}"


def seconds_late(due: datetime | None, submission) -> float:
    if due is None or submission.timestamp is None:
        return 0.0
    due += submission.extension or timedelta(0)
    return (submission.timestamp - due).total_seconds()


def _words(extension: timedelta | None) -> str:
    return "no extension" if extension is None else f"an extension of {extension}"
