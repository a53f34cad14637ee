"""Writes the rows that `nbgrader autograde` would write, through one gradebook that stays open.

Tables, scores and late penalties are nbgrader's own. But nbgrader opens its database nine times for
each notebook; here, a submission is one transaction of a few statements.
"""

import sys
from collections.abc import Set
from dataclasses import dataclass
from datetime import datetime

from nbformat import NotebookNode
from nbgrader import api, utils
from sqlalchemy import select

from autograder.lms.marks import lateness as lateness_in_words
from autograder.nbgrader_glue.agreement import of_gradebook
from autograder.nbgrader_glue.folders import QUIET
from autograder.nbgrader_glue.late import Lateness, seconds_late, settle_one
from autograder.nbgrader_glue.locked import patiently
from autograder.nbgrader_glue.names import release_first
from autograder.notebook.suggestion import suggestion_of
from autograder.terminal import say


@dataclass(frozen=True)
class Standing:
    """A submission in the gradebook: its automatic rows as text, its points, its cells to be read, how
    late it is, in words, and the points of the checks alone, without a penalty.
    """

    rows: str
    score: float
    to_read: int
    late: str = ""
    of_checks: float = 0.0


class Rows:
    """One assignment's rows. ValueError if it is not there, or has not exactly one notebook of its name.

    lateness: what being late costs; with it, the due date, extensions and penalties in the gradebook are
    brought up to date. None for one who only reads.
    """

    def __init__(self, url: str, course: str, assignment: str, lateness: Lateness | None = None):
        self._gradebook = patiently(lambda: api.Gradebook(url, course))
        self._db = self._gradebook.db
        self._lateness = lateness
        try:
            patiently(lambda: self._read_cells(assignment), self._db.rollback)
        except BaseException:
            self.close()
            raise
        self._students = self._known()

    def close(self) -> None:
        self._gradebook.close()

    def knows(self, student: str) -> bool:
        return student in self._students

    def enter(self, student: str, timestamp: datetime | None):
        """The submission's rows, old or new: (submission, notebook, grades, comments).

        New rows are not committed yet.
        """
        db = self._db
        if student not in self._students:
            if db.get(api.Student, student) is None:
                db.add(api.Student(id=student))
            self._students.add(student)
        wanted = select(api.SubmittedAssignment, api.SubmittedNotebook)
        found = db.execute(
            wanted.join(*self._of_submission()).where(
                api.SubmittedAssignment.assignment_id == self._assignment,
                api.SubmittedAssignment.student_id == student,
            )
        ).first()
        if found:
            submission, notebook = found
            of = api.Grade.notebook_id == notebook.id, api.Comment.notebook_id == notebook.id
            grades = list(db.scalars(select(api.Grade).where(of[0])))
            comments = list(db.scalars(select(api.Comment).where(of[1])))
        else:
            submission = api.SubmittedAssignment(
                id=api.new_uuid(), assignment_id=self._assignment, student_id=student
            )
            notebook = api.SubmittedNotebook(
                id=api.new_uuid(), notebook_id=self._notebook, assignment_id=submission.id
            )
            mine = {"notebook_id": notebook.id}
            grades = [api.Grade(cell_id=cell, **mine) for cell in self._with_grade]
            comments = [api.Comment(cell_id=cell, **mine) for cell in self._with_comment]
            db.add_all([submission, notebook, *grades, *comments])
        # Also None: the time of an earlier hand-in is not that of one without a time.
        submission.timestamp = timestamp
        if self._lateness and self._lateness.due is not None:
            submission.extension = self._lateness.extension(student)
        return submission, notebook, grades, comments

    def record(
        self, student: str, timestamp: datetime | None, graded: NotebookNode, unchanged: Set[str]
    ) -> Standing:
        """Enter a submission and its scores, and commit them. BusyError if the gradebook stays locked.

        unchanged: the cells whose answers have not changed since they were last graded.
        """
        return patiently(
            lambda: self._recorded(student, timestamp, graded, unchanged),
            lambda: self._drop(student),
        )

    def _recorded(
        self, student: str, timestamp: datetime | None, graded: NotebookNode, unchanged: Set[str]
    ) -> Standing:
        submission, notebook, grades, comments = self.enter(student, timestamp)
        grade_of = {self._names[grade.cell_id]: grade for grade in grades}
        comment_of = {self._names[comment.cell_id]: comment for comment in comments}
        for cell in graded.cells:
            suggestion = suggestion_of(cell)
            if utils.is_grade(cell):
                grade = _found(grade_of, cell)
                score = utils.determine_grade(cell, QUIET)[0]
                grade.auto_score = None if score is None else float(score)
                if suggestion:
                    grade.auto_score = suggestion.points
                # A person should look at a manual score again if the answer has changed.
                if (
                    grade.manual_score is None
                    or cell.metadata.nbgrader["grade_id"] not in unchanged
                ):
                    by_hand = grade.manual_score is not None or score is None
                    grade.needs_manual_grade = by_hand or suggestion is not None
            if utils.is_solution(cell) or utils.is_task(cell):
                same = cell.metadata.nbgrader.get("checksum") == utils.compute_checksum(cell)
                empty = same and not utils.is_task(cell)
                said = ["No response."] if empty else []
                said += [suggestion.comment] if suggestion else []
                _found(comment_of, cell).auto_comment = " ".join(said) or None
        notebook.late_submission_penalty = self._late_penalty(student, submission, notebook.id)
        self._db.flush()
        standing = self._standing(submission, notebook, grades, comments)
        self._commit()
        return standing

    def enter_alone(self, student: str, timestamp: datetime | None) -> None:
        """Enter a submission without scores, and commit it. BusyError as in `record`."""

        def work() -> None:
            self.enter(student, timestamp)
            self._commit()

        patiently(work, lambda: self._drop(student))

    def _commit(self) -> None:
        self._db.commit()
        self._db.expunge_all()  # so that the last submission takes no longer than the first one

    def _drop(self, student: str) -> None:
        """Drop what was not committed of one student, without reading."""
        self._db.rollback()
        self._db.expunge_all()
        self._students.discard(student)

    def forget(self) -> None:
        """Drop what was not committed, after an error."""
        self._db.rollback()
        self._db.expunge_all()
        self._students = self._known()

    def _known(self) -> set[str]:
        return patiently(lambda: set(self._db.scalars(select(api.Student.id))), self._db.rollback)

    def standings(self) -> dict[str, Standing]:
        """What the gradebook holds, by student."""
        return patiently(self._read_standings, self._db.rollback)

    def _read_standings(self) -> dict[str, Standing]:
        mine = api.SubmittedNotebook.notebook_id == self._notebook
        rows: dict[type, dict[str, list]] = {}
        for table in (api.Grade, api.Comment):
            columns = [column for column in table.__table__.columns if column.name != "id"]
            wanted = select(*columns).join(
                api.SubmittedNotebook, api.SubmittedNotebook.id == table.notebook_id
            )
            rows[table] = {}
            for row in self._db.execute(wanted.where(mine)):
                rows[table].setdefault(row.notebook_id, []).append(row)
        wanted = select(
            api.SubmittedAssignment.student_id,
            api.SubmittedAssignment.timestamp,
            api.SubmittedAssignment.extension,
            api.SubmittedNotebook.id,
            api.SubmittedNotebook.late_submission_penalty,
        ).join(*self._of_submission())
        grades, comments = rows[api.Grade], rows[api.Comment]
        return {
            row.student_id: self._standing(
                row, row, grades.get(row.id, []), comments.get(row.id, [])
            )
            for row in self._db.execute(wanted.where(mine))
        }

    def _standing(self, submission, notebook, grades, comments) -> Standing:
        automatic = sorted((self._names[row.cell_id], row.auto_score) for row in grades)
        texts = sorted((self._names[row.cell_id], row.auto_comment) for row in comments)
        penalty = notebook.late_submission_penalty
        late = self._seconds_late(submission) > 0
        return Standing(
            # Without the penalty, which changes with the points that a person gives.
            repr((submission.timestamp, automatic, texts)),
            sum(map(_points, grades)) - (penalty or 0.0),
            sum(bool(row.needs_manual_grade) for row in grades),
            lateness_in_words(penalty or 0.0) if late else "",
            sum(_points(grade) for grade in grades if self._names[grade.cell_id] in self.of_checks),
        )

    def _late_penalty(self, student: str, submission, notebook: str) -> float | None:
        seconds = self._seconds_late(submission)
        if seconds <= 0 or self._lateness is None:
            return None
        self._db.flush()
        # The database adds up, as it does for nbgrader, so that not even the rounding differs.
        score = self._db.scalar(
            select(api.SubmittedNotebook.score).where(api.SubmittedNotebook.id == notebook)
        )
        return self._lateness.penalty(student, score, seconds)

    def _seconds_late(self, submission) -> float:
        return seconds_late(self._due, submission)

    def _of_submission(self):
        return api.SubmittedNotebook, (
            api.SubmittedNotebook.assignment_id == api.SubmittedAssignment.id
        )

    def _read_cells(self, name: str) -> None:
        """Copy the gradebook's cells, so that no commit expires them."""
        command = release_first(name)
        try:
            assignment = self._gradebook.find_assignment(name)
        except api.MissingEntry:
            raise ValueError(f"the gradebook does not know {name}: {command}") from None
        names = [notebook.name for notebook in assignment.notebooks]
        if names != [name]:
            raise ValueError(
                f"{name} must have one notebook, {name}.ipynb, but it has "
                f"{', '.join(names) or 'none'}: use `nbgrader autograde`, or {command}"
            )
        if self._lateness:
            for line in settle_one(self._db, assignment, self._lateness):
                say(line, sys.stderr)
            self._db.commit()
        notebook = assignment.notebooks[0]
        self._assignment, self._notebook, self._due = assignment.id, notebook.id, assignment.duedate
        self.cells = of_gradebook(notebook)
        graded = [*notebook.grade_cells, *notebook.task_cells]
        commented = [*notebook.solution_cells, *notebook.task_cells]
        self._with_grade = [cell.id for cell in graded]
        self._with_comment = [cell.id for cell in commented]
        self._names = {cell.id: cell.name for cell in [*graded, *commented]}
        self.points = {cell.name: float(cell.max_score) for cell in graded}
        by_person = {cell.name for cell in commented}
        self.of_checks = {name: most for name, most in self.points.items() if name not in by_person}
        self._db.expunge_all()


def _found(rows: dict, cell: NotebookNode):
    name = cell.metadata["nbgrader"]["grade_id"]
    if name not in rows:
        raise api.MissingEntry(f"the gradebook has no row for {name}")
    return rows[name]


def _points(grade) -> float:
    """A grade row's points, as nbgrader adds them up."""
    given = grade.auto_score if grade.manual_score is None else grade.manual_score
    return 0.0 if given is None else given + (grade.extra_credit or 0.0)
