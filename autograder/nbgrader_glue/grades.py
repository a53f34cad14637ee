"""Writes a course's scores as a table that is safe in a spreadsheet: `nbgrader export`."""

from collections.abc import Sequence
from pathlib import Path

from nbgrader.api import Gradebook, MissingEntry
from nbgrader.plugins import CsvExportPlugin

from autograder.files import put_in_place
from autograder.lms.sheet import as_csv, harmless
from autograder.nbgrader_glue.late import settle
from autograder.terminal import plain

COLUMNS = (
    "assignment",
    "duedate",
    "timestamp",
    "student_id",
    "last_name",
    "first_name",
    "email",
    "raw_score",
    "late_submission_penalty",
    "score",
    "max_score",
)


class GradesExporter(CsvExportPlugin):
    """Writes nbgrader's table, but so that no text in it is a formula or breaks a row."""

    def export(self, gradebook: Gradebook) -> None:
        to = Path(self.to or "grades.csv")
        if self.parent is not None:  # nbgrader's command, started in the course's folder
            for line in settle(Path(self.parent.coursedir.root), gradebook):
                self.log.warning(plain(line))
        self.log.info("Exporting grades to %s", to)
        rows: list[Sequence[str]] = [COLUMNS]
        for assignment in gradebook.assignments:
            if self._wanted(assignment.name, self.assignment):
                for student in gradebook.students:
                    if self._wanted(student.id, self.student):
                        rows.append(_row(gradebook, assignment, student))
        put_in_place(to, as_csv(rows))

    @staticmethod
    def _wanted(name: str, names: list) -> bool:
        return not names or name in map(str, names)


def _row(gradebook: Gradebook, assignment, student) -> list[str]:
    about = (student.id, student.last_name, student.first_name, student.email)
    try:
        submission = gradebook.find_submission(assignment.name, student.id)
    except MissingEntry:  # nothing handed in
        timestamp, score, penalty = None, 0.0, 0.0
    else:
        timestamp, score = submission.timestamp, submission.score
        penalty = submission.late_submission_penalty
    points = (score, penalty, max(0.0, score - penalty), assignment.max_score)
    dates = (assignment.duedate, timestamp)
    texts = [harmless(_text(part)) for part in (assignment.name, *dates, *about)]
    return [*texts, *map(_text, points)]


def _text(value) -> str:
    return "" if value is None else str(value)
