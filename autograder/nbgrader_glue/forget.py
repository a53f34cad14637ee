"""Finds all that a course keeps about one student, and removes it: `autograder forget`."""

import shutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from nbgrader import api, utils
from nbgrader.coursedir import CourseDirectory
from sqlalchemy import create_engine, text
from traitlets.config import Config

from autograder import roster, term_calendar
from autograder.files import put_in_place
from autograder.lti.sent import FILE as SENT
from autograder.lti.sent import Sent
from autograder.marking.kept import Kept
from autograder.nbgrader_glue.folders import QUIET
from autograder.nbgrader_glue.mentions import Called, written
from autograder.nbgrader_glue.release import configuration
from autograder.nbgrader_glue.shelf import REPLACED
from autograder.roster import Person


@dataclass(frozen=True)
class Trace:
    """Something that is kept about a student, in words, and how to remove it."""

    what: str
    remove: Callable[[], object]


def traces(root: Path, student: str, results: list[Path]) -> list[Trace]:
    """All of it. root: the course's folder. results: what the pipeline's cache holds about the student.

    ValueError if the class list is wrong.
    """
    config = configuration(root)
    course = CourseDirectory(config=config, log=QUIET)
    found = [*_folders(root, course, student), *_exchange(root, config, course, student)]
    if results:
        what = f"{_shown(root, results[0].parents[2])}: {len(results)} files"
        found.append(Trace(what, partial(_remove_all, results)))
    found += _gradebook(course, student)
    found += _files_of_the_class(root, student, Called(person(root, student)))
    return found


def person(root: Path, student: str) -> Person:
    """What the class list, or else the gradebook, says of a student. ValueError if the list is wrong."""
    listed = root / roster.FILE
    if listed.is_file() and student in (people := roster.read(listed).people):
        return people[student]
    course = CourseDirectory(config=configuration(root), log=QUIET)
    with api.Gradebook(course.db_url, course.course_id) as gradebook:
        try:
            row = gradebook.find_student(student)
        except api.MissingEntry:
            return Person(student)
        return Person(student, row.last_name or "", row.first_name or "", row.email or "")


def known(root: Path) -> set[str]:
    """The ids of all whom the class list, the gradebook or a submission's folder names."""
    course = CourseDirectory(config=configuration(root), log=QUIET)
    listed = roster.read_if_there(root)
    submitted = Path(course.format_path(course.submitted_directory, "*", ".")).parent
    with api.Gradebook(course.db_url, course.course_id) as gradebook:
        ids = {student.id for student in gradebook.students}
    ids |= set(listed.people if listed else ())
    return ids | {path.name for path in submitted.glob("*/")} if submitted.is_dir() else ids


def _folders(root: Path, course: CourseDirectory, student: str) -> Iterator[Trace]:
    steps = (course.submitted_directory, course.autograded_directory, course.feedback_directory)
    folders = [Path(course.format_path(step, student, ".")) for step in steps]
    for folder in [*folders, root / REPLACED / student]:
        if folder.is_dir() or folder.is_symlink():
            count = sum(path.is_file() for path in folder.rglob("*"))
            yield Trace(f"{_shown(root, folder)}: {count} files", partial(_remove, folder))


def _exchange(root: Path, config: Config, course: CourseDirectory, student: str) -> Iterator[Trace]:
    """What the student handed in there, and the pages that went back."""
    settings = config.Exchange
    for above, below in (("root", "inbound"), ("cache", ".")):
        given = settings.get(above)
        if isinstance(given, str):
            folder = Path(given) / course.course_id / below
            for path in sorted(folder.glob("*")):
                if path.name.startswith(f"{student}+"):
                    yield Trace(_shown(root, path), partial(_remove, path))
    if isinstance(settings.get("root"), str):
        pages = Path(settings.root) / course.course_id / "feedback"
        for page in sorted({pages / f"{name}.html" for name in _page_names(course, student)}):
            if page.is_file():
                yield Trace(_shown(root, page), partial(_remove, page))


def _page_names(course: CourseDirectory, student: str) -> Iterator[str]:
    """What nbgrader calls the released feedback pages of a student."""
    submitted = Path(course.format_path(course.submitted_directory, student, "."))
    for secret in submitted.glob("*/submission_secret.txt"):
        for notebook in secret.parent.glob("*.ipynb"):
            yield utils.notebook_hash(secret=secret.read_text(), notebook_id=notebook.stem)


def _gradebook(course: CourseDirectory, student: str) -> Iterator[Trace]:
    with api.Gradebook(course.db_url, course.course_id) as gradebook:
        try:
            count = len(gradebook.find_student(student).submissions)
        except api.MissingEntry:
            return
    what = f"the gradebook: the student with {count} submissions"
    yield Trace(what, partial(_remove_rows, course, student))


def _remove_rows(course: CourseDirectory, student: str) -> None:
    with api.Gradebook(course.db_url, course.course_id) as gradebook:
        gradebook.remove_student(student)
    engine = create_engine(course.db_url)
    if engine.dialect.name == "sqlite":  # which keeps what was removed in its file until then
        with engine.connect().execution_options(isolation_level="AUTOCOMMIT") as connection:
            connection.execute(text("VACUUM"))
    engine.dispose()


def _files_of_the_class(root: Path, student: str, called: Called) -> Iterator[Trace]:
    listed, calendar = root / roster.FILE, root / term_calendar.FILE
    if listed.is_file() and student in roster.read(listed).people:
        rest = roster.without(listed, student)
        yield Trace(f"the line in {roster.FILE}", partial(put_in_place, listed, rest))
    if calendar.is_file():
        rest, count = term_calendar.without_extensions(calendar.read_text("utf-8-sig"), student)
        if count:
            what = f"{count} extensions in {term_calendar.FILE}"
            yield Trace(what, partial(put_in_place, calendar, rest))
    kept = Kept(root)
    for path in kept.naming(student):
        what = f"{_shown(root, path)}, where the student's proofs are marked"
        yield Trace(what, partial(kept.forget, path, student))
    sent = Sent(root)
    if sent.names(student):
        what = f"{SENT}, the marks that were sent to a platform"
        yield Trace(what, partial(sent.forget, student))
    for path in written(root, called):
        what = f"{_shown(root, path)}, which names the student: write it again"
        yield Trace(what, partial(_remove, path))


def _remove(path: Path) -> None:
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink()


def _remove_all(paths: list[Path]) -> None:
    for path in paths:
        _remove(path)


def _shown(root: Path, path: Path) -> str:
    return str(path.relative_to(root)) if path.is_relative_to(root) else str(path)
