"""Has `nbgrader autograde` grade again what was graded by other points or questions, and remember what a
person has decided.

nbgrader looks only at when the work was handed in, and sends all that a person marked back to be read.
"""

import os

import nbformat
from nbformat import NotebookNode
from nbgrader import api, utils

from autograder.nbgrader_glue.agreement import of_gradebook
from autograder.nbgrader_glue.decided import same_answers
from autograder.nbgrader_glue.folders import Folders
from autograder.notebook.recognise import grade_id


class Regrading:
    """Of one run of `nbgrader autograde`, whose converter it tells which submissions are old."""

    def __init__(self, converter):
        self._converter = converter
        self._folders: Folders | None = None
        self._asked: set[tuple[str, float]] | None = None
        self._before: dict[str, bytes] = {}
        is_wanted = converter.init_destination

        def init_destination(assignment: str, student: str) -> bool:
            forced = converter.force
            self._remember(assignment, student)
            converter.force = forced or self._is_old(assignment, student)
            try:
                return is_wanted(assignment, student)
            finally:
                converter.force = forced

        converter.init_destination = init_destination

    def same_answers(self, student: str, now: NotebookNode) -> set[str]:
        """The graded cells whose answers are what they were before this run."""
        before = self._before.get(student, b"")
        return same_answers(before, now) if before else set()

    def _of(self, assignment: str) -> Folders:
        if self._folders is None or self._folders.assignment != assignment:
            self._folders = Folders(self._converter.config, assignment, self._converter)
            self._asked = None
        return self._folders

    def _remember(self, assignment: str, student: str) -> None:
        try:
            self._before[student] = self._of(assignment).graded_before(student)
        except OSError:  # a submission that the grader refuses, and says so
            self._before[student] = b""

    def _is_old(self, assignment: str, student: str) -> bool:
        """Whether a graded notebook has not the gradebook's cells with its points."""
        path = self._of(assignment).autograded(student)
        try:
            graded = nbformat.read(path, as_version=4)
        except Exception:  # none, or whatever lies there in its place
            return False
        was = {(grade_id(cell), float(cell.metadata["nbgrader"]["points"]))
               for cell in graded.cells if utils.is_grade(cell) or utils.is_task(cell)}  # fmt: skip
        old = was != self._points(assignment)
        if old:
            shown = os.path.relpath(path.parent)
            self._converter.log.warning(
                "%s was graded by other points or questions: it is graded again", shown
            )
        return old

    def _points(self, assignment: str) -> set[tuple[str, float]]:
        if self._asked is None:
            course = self._converter.coursedir
            with api.Gradebook(course.db_url, course.course_id) as gradebook:
                cells = of_gradebook(gradebook.find_notebook(assignment, assignment))
            self._asked = {
                (name, one.points) for name, one in cells.items() if one.points is not None
            }
        return self._asked
