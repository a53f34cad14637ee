"""Reads and writes, in nbgrader's gradebook, the points that people give to answers."""

from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import TypeVar

import nbformat
from nbformat import NotebookNode
from nbgrader import api
from nbgrader.coursedir import CourseDirectory
from sqlalchemy import select
from sqlalchemy.exc import OperationalError

from autograder import roster
from autograder.marking.book import Paper, Proof, Written
from autograder.marking.rubric import rubrics
from autograder.nbgrader_glue import answer_page
from autograder.nbgrader_glue.folders import QUIET
from autograder.nbgrader_glue.items import NO_RESPONSE, titles_above
from autograder.nbgrader_glue.locked import patiently, why_unusable
from autograder.nbgrader_glue.release import configuration

PATIENCE = 30.0  # s, while another program writes into the gradebook
T = TypeVar("T")


class ByHand:
    """The book of one course, whose folder is `root`. RosterError if the class list is wrong."""

    def __init__(self, root: Path):
        config = configuration(root)
        config.CourseDirectory.assignment_id = "of the term"
        self._course = CourseDirectory(config=config, log=QUIET)
        self._answers = answer_page.Answers(config)
        people = roster.read_if_there(root)
        self._people = people.people if people else {}
        self._source = cache(_source)

    def proofs(self) -> list[Proof]:
        with self._gradebook() as gradebook:
            names = sorted(one.name for one in gradebook.assignments)
        return [proof for name in names for proof in self._proofs_of(name)]

    def papers(self, proof: Proof) -> list[Paper]:
        with self._gradebook() as gradebook:
            papers = _patiently(lambda: list(_papers(gradebook.db, proof)))
        # Who could not be graded has rows, and no answer that a person could read.
        readable = [one for one in papers if self._graded(proof, one.student).is_file()]
        return sorted(readable, key=lambda one: one.id)

    def written(self, proof: Proof, student: str, hidden: bool) -> Written:
        person = self._people.get(student)
        names = [student, person.name, person.first_name, person.last_name] if person else [student]
        return self._answers.written(
            self._graded(proof, student),
            self._source_of(proof.assignment),
            proof.cell,
            names if hidden else [],
        )

    def content(self, proof: Proof, student: str) -> str:
        return answer_page.content(self._graded(proof, student), proof.cell)

    def shown(self, proof: Proof, markdown: str) -> str:
        return answer_page.shown(markdown, self._source_path(proof.assignment).parent)

    def called(self, student: str) -> str:
        person = self._people.get(student)
        return person.name if person else student

    def record(self, proof: Proof, student: str, points: float | None, comment: str) -> None:
        place = proof.cell, proof.assignment, proof.assignment, student

        def write() -> None:
            with self._gradebook() as gradebook:
                grade, said = gradebook.find_grade(*place), gradebook.find_comment(*place)
                grade.manual_score, grade.needs_manual_grade = points, points is None
                said.manual_comment = comment or None
                gradebook.db.commit()

        _patiently(write)

    def _graded(self, proof: Proof, student: str) -> Path:
        course, name = self._course, proof.assignment
        folder = Path(course.format_path(course.autograded_directory, student, name))
        return folder / f"{name}.ipynb"

    def _gradebook(self) -> api.Gradebook:
        course = self._course
        return _patiently(lambda: api.Gradebook(course.db_url, course.course_id))

    def _proofs_of(self, assignment: str) -> Iterator[Proof]:
        source = self._source_of(assignment)
        if source is None:
            return
        titles = titles_above(source)
        for rubric in rubrics(source):
            yield Proof(assignment, titles.get(rubric.cell) or rubric.cell, rubric)

    def _source_path(self, assignment: str) -> Path:
        course = self._course
        folder = Path(course.format_path(course.source_directory, ".", assignment))
        return folder / f"{assignment}.ipynb"

    def _source_of(self, assignment: str) -> NotebookNode | None:
        path = self._source_path(assignment)
        return self._source(path, path.stat().st_mtime_ns) if path.is_file() else None


def _source(path: Path, changed: int) -> NotebookNode:
    return nbformat.read(path, as_version=4)


def _papers(db, proof: Proof) -> Iterator[Paper]:
    def of(table, *columns):
        wanted = (
            select(table.notebook_id, *columns)
            .join(api.BaseCell, api.BaseCell.id == table.cell_id)
            .join(api.SubmittedNotebook, api.SubmittedNotebook.id == table.notebook_id)
            .join(api.Notebook, api.Notebook.id == api.SubmittedNotebook.notebook_id)
            .join(api.Assignment, api.Assignment.id == api.Notebook.assignment_id)
            .where(
                api.BaseCell.name == proof.cell,
                api.Notebook.name == proof.assignment,
                api.Assignment.name == proof.assignment,
            )
        )
        return {row.notebook_id: row for row in db.execute(wanted)}

    comments = of(api.Comment, api.Comment.auto_comment, api.Comment.manual_comment)
    grades = of(
        api.Grade, api.Grade.auto_score, api.Grade.manual_score, api.Grade.needs_manual_grade
    )
    wanted = select(api.SubmittedNotebook.id, api.SubmittedAssignment.student_id).join(
        api.SubmittedAssignment,
        api.SubmittedAssignment.id == api.SubmittedNotebook.assignment_id,
    )
    students = {row.id: row.student_id for row in db.execute(wanted)}
    for id, grade in grades.items():
        said, by_hand = comments.get(id), grade.manual_score
        automatic = (said.auto_comment if said else None) or ""
        to_read = bool(grade.needs_manual_grade) or (by_hand is None and grade.auto_score is None)
        settled = not to_read and by_hand is None and not grade.auto_score
        yield Paper(
            id,
            students[id],
            grade.auto_score,
            by_hand,
            to_read,
            settled and automatic.startswith(NO_RESPONSE),
            (said.manual_comment if said else None) or "",
        )


def _patiently(does: Callable[[], T]) -> T:
    """What the function gives, after waiting for another program that keeps the gradebook locked."""
    try:
        return patiently(does, seconds=PATIENCE)
    except OperationalError as error:
        raise OSError(why_unusable(error)) from None
