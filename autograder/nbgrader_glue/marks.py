"""Reads a class's marks from the gradebook, and why somebody has none from the course's folders."""

import glob
from datetime import datetime
from pathlib import Path

from nbgrader import api
from nbgrader.coursedir import CourseDirectory
from sqlalchemy import select
from sqlalchemy.orm import undefer

from autograder.lms.marks import GRADED, UNGRADED, UNREAD, UNREADABLE, Column, Mark, Marks
from autograder.nbgrader_glue import names
from autograder.nbgrader_glue.folders import QUIET
from autograder.nbgrader_glue.late import settle
from autograder.nbgrader_glue.release import configuration
from autograder.nbgrader_glue.submitted import RefusedError, timestamp
from autograder.roster import Person, Roster
from autograder.terminal import shown_name


def read_marks(root: Path, roster: Roster | None) -> tuple[Marks, list[str]]:
    """The marks of the class, with the late penalties as they are now, and what is to be said of them.

    root: the course's folder. roster: None if there is no list: then all whom the gradebook or a
    submission names are the class. CalendarError, RosterError if the course's files are wrong.
    """
    config = configuration(root)
    config.CourseDirectory.assignment_id = "of the term"
    course = CourseDirectory(config=config, log=QUIET)
    with api.Gradebook(course.db_url, course.course_id) as gradebook:
        lines = settle(root, gradebook)
        columns = [_column(gradebook.db, course, one) for one in gradebook.assignments]
        known = {one.id: _person(one) for one in gradebook.students}
    seen = known | {id: known.get(id, Person(id)) for one in columns for id in one.marks}
    if roster is None:
        return Marks([seen[id] for id in sorted(seen)], columns), lines
    others = sorted({id for one in columns for id in one.marks if id not in roster.people})
    if others:
        shown = ", ".join(map(shown_name, others))
        lines.append(f"not in the class list, and left out: {shown}")
    return Marks(list(roster.people.values()), columns), lines


def pages_of(root: Path, assignment: str) -> dict[str, list[Path]]:
    """The feedback pages of an assignment, by student."""
    config = configuration(root)
    course = CourseDirectory(config=config, log=QUIET)
    found = names.folders(course, course.feedback_directory, "*", glob.escape(assignment))
    return {student: sorted(Path(folder).glob("*.html")) for folder, student in found.items()}


def _person(student) -> Person:
    parts = (student.last_name, student.first_name, student.email, student.lms_user_id)
    return Person(student.id, *(part or "" for part in parts))


def _column(db, course: CourseDirectory, assignment) -> Column:
    wanted = select(api.SubmittedAssignment).where(
        api.SubmittedAssignment.assignment_id == assignment.id
    )
    at_once = map(undefer, (api.SubmittedAssignment.score, api.SubmittedAssignment.needs_manual_grade,
                            api.SubmittedAssignment.late_submission_penalty))  # fmt: skip
    notebooks = [one.name for one in assignment.notebooks]
    marks = {one.student_id: _mark(course, assignment.name, notebooks, one)
             for one in db.scalars(wanted.options(*at_once))}  # fmt: skip
    folders = names.folders(course, course.submitted_directory, "*", glob.escape(assignment.name))
    for folder, student in folders.items():
        if student not in marks:
            readable = any(Path(folder).glob("*.ipynb"))
            state = UNGRADED if readable else UNREADABLE
            marks[student] = Mark(state, handed_in=_time(Path(folder)))
    return Column(assignment.name, assignment.max_score, assignment.duedate, marks)


def _time(folder: Path) -> datetime | None:
    try:
        return timestamp(folder)
    except RefusedError:
        return None


def _mark(course: CourseDirectory, assignment: str, notebooks: list[str], submission) -> Mark:
    late = submission.total_seconds_late > 0
    when = submission.timestamp
    graded = Path(
        course.format_path(course.autograded_directory, submission.student_id, assignment)
    )
    if not all((graded / f"{name}.ipynb").is_file() for name in notebooks):
        return Mark(UNREADABLE, late=late, handed_in=when)
    penalty = submission.late_submission_penalty or 0.0
    points = max(0.0, submission.score - penalty)
    state = UNREAD if submission.needs_manual_grade else GRADED
    return Mark(state, points, penalty, late, when)
