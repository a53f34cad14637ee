"""Reads a class from the gradebook and the autograded notebooks, for its report."""

from pathlib import Path

from autograder.nbgrader_glue import names
from autograder.nbgrader_glue.folders import Folders
from autograder.nbgrader_glue.gradebook import Rows
from autograder.nbgrader_glue.release import configuration
from autograder.report import Student, read_verdicts
from autograder.terminal import shown_name


def read_class(root: Path, assignment: str) -> tuple[float, list[Student]]:
    """The assignment's points, and its students in order of their names.

    root: the course's folder. ValueError if the gradebook does not know the assignment.
    """
    config = configuration(root)
    config.CourseDirectory.assignment_id = assignment
    folders = Folders(config, assignment)
    rows = Rows(folders.course.db_url, folders.course.course_id, assignment, penalty=None)
    try:
        standings, most = rows.standings(), sum(rows.points.values())
    finally:
        rows.close()
    return most, [
        _student(name, folders.autograded(name), standings.get(name))
        for name in folders.submissions()
    ]


def _student(name: str, notebook: Path, standing) -> Student:
    if why := names.refusal(name):
        return Student(shown_name(name), note=why)
    if standing is None or not notebook.exists():
        return Student(name, note="not graded yet, or it could not be graded")
    try:
        verdicts = read_verdicts(notebook)
    except ValueError as error:
        return Student(name, standing.score, standing.to_read, note=str(error))
    return Student(name, standing.score, standing.to_read, verdicts)
