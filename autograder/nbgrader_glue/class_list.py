"""Reads a class from the gradebook and the submissions, for its report."""

from dataclasses import replace
from datetime import datetime
from pathlib import Path

import nbformat
from nbformat import NotebookNode
from nbgrader import api

from autograder import hints_seen, roster
from autograder.nbgrader_glue import names
from autograder.nbgrader_glue.folders import Folders
from autograder.nbgrader_glue.gradebook import Rows, Standing
from autograder.nbgrader_glue.release import configuration
from autograder.nbgrader_glue.submitted import RefusedError
from autograder.notebook.own_arm import drawn_for
from autograder.notebook.reading import UnreadableError, read
from autograder.notebook.version import other_version
from autograder.problems import families
from autograder.protocol import one_line
from autograder.report import Class, Student, read_graded
from autograder.roster import Roster
from autograder.term_calendar import read_if_there
from autograder.terminal import shown_name


def read_class(root: Path, assignment: str) -> Class:
    """An assignment's students, in order of their names.

    root: the course's folder. ValueError if the gradebook does not know the assignment, or if the class
    list or the calendar is wrong.
    """
    people, calendar = roster.read_if_there(root), read_if_there(root)
    config = configuration(root)
    config.CourseDirectory.assignment_id = assignment
    folders = Folders(config, assignment)
    rows = Rows(folders.course.db_url, folders.course.course_id, assignment)
    try:
        standings, most = rows.standings(), sum(rows.points.values())
        of_checks = sum(rows.of_checks.values())
    finally:
        rows.close()
    source = _source(folders, assignment)
    students = [
        _called(_student(name, folders, standings.get(name), source), people)
        for name in folders.submissions()
    ]
    there = {one.name for one in students}
    missing = [one.name for id, one in people.people.items() if id not in there] if people else []
    counts = calendar.counts(assignment)
    return Class(assignment, most, students, tuple(missing), counts, of_checks)


def read_term(root: Path) -> tuple[list[Class], list[str]]:
    """Each assignment that somebody has handed in, in order of the names, and why others are left out.

    root: the course's folder.
    """
    config = configuration(root)
    config.CourseDirectory.assignment_id = "of the term"
    course = Folders(config, "of the term").course
    with api.Gradebook(course.db_url, course.course_id) as gradebook:
        known = sorted(assignment.name for assignment in gradebook.assignments)
    classes, left_out = [], []
    for name in known:
        try:
            classes.append(read_class(root, name))
        except ValueError as error:  # such as one of several notebooks
            left_out.append(str(error))
    return [of for of in classes if of.students], left_out


def _source(folders: Folders, assignment: str) -> NotebookNode | None:
    """The assignment's source; None if it has been taken away since."""
    course = folders.course
    folder = Path(course.format_path(course.source_directory, ".", assignment))
    path = folder / f"{assignment}.ipynb"
    return nbformat.read(path, as_version=4) if path.is_file() else None


def _called(one: Student, people: Roster | None) -> Student:
    """With the full name, if the class list has one."""
    person = people.people.get(one.name) if people else None
    return replace(one, called=person.name) if person else one


def _student(
    name: str, folders: Folders, standing: Standing | None, source: NotebookNode | None
) -> Student:
    if why := names.refusal(name):
        return Student(shown_name(name), note=why)
    notebook, when = folders.autograded(name), _handed_in(folders, name)
    if standing is None or not notebook.exists():
        return Student(name, note=_why_not(folders, name, source), handed_in=when)
    score, to_read = standing.score, standing.to_read
    try:
        verdicts, answers, derivations = read_graded(notebook)
    except ValueError as error:
        return Student(name, score, to_read, note=str(error), handed_in=when)
    return Student(
        name,
        score,
        to_read,
        verdicts,
        answers=answers,
        handed_in=when,
        hints=_hints(folders.submitted(name) / hints_seen.FILE, [*verdicts, *derivations]),
        derivations=derivations,
        arms=_arms(source, name, list(verdicts)),
        late=standing.late,
        of_checks=standing.of_checks,
    )


def _why_not(folders: Folders, student: str, source: NotebookNode | None) -> str:
    """Why there is no graded notebook."""
    if not folders.holds_notebook(student):
        return "there is no notebook in what was handed in: ask the student for it"
    path = folders.submitted(student)
    try:
        folders.check(student)
        if source is not None:
            path, _ = folders.counted(student, source)
            notebook, _ = read(path.read_bytes())
            files = folders.laid_in(student).mechanisms
            if why := other_version(notebook, source, files):
                return f"{one_line(path.name)} {why}"
    except RefusedError as error:
        return str(error)
    except UnreadableError as error:
        return f"{one_line(path.name)} {error}"
    except OSError as error:
        return f"{one_line(path.name)} cannot be read: {error.strerror}"
    return f"not graded yet: run `autograder grade {folders.assignment}`, which says what is wrong"


def _arms(source: NotebookNode | None, name: str, checks: list[str]) -> dict[str, str]:
    """Which arm a student's answers are about, by the checks of which the arms' answers differ."""
    drawn = drawn_for(source, name) if source else None
    if drawn is None or drawn.own is None:
        return {}
    return dict.fromkeys(set(checks) & set(families.OF_THE_ARM), ", ".join(drawn.own.facts))


def _handed_in(folders: Folders, name: str) -> datetime | None:
    try:
        return folders.timestamp(name)
    except RefusedError:  # its timestamp.txt holds no time
        return None


def _hints(file: Path, ids: list[str]) -> dict[str, int] | None:
    """How many hints a student saw of these checks and derivations; None if no file says."""
    if file.is_symlink() or not file.is_file():
        return None
    seen = hints_seen.read(file)
    return {id: seen[id] for id in ids if id in seen}
