"""Makes a feedback page anew where what it shows has changed: a mark, a comment, an answer.

nbgrader looks only at when the work was handed in, and otherwise keeps a page that is there.
"""

import os
import re
from pathlib import Path

from nbgrader import utils
from nbgrader.api import Gradebook, MissingEntry

from autograder.digest import digest
from autograder.marking.kept import COUNTS, FIRST, Kept, KeptError
from autograder.nbgrader_glue import worked

# nbconvert writes a tag's settings in an order of its own.
MADE_OF = re.compile(r'<meta\b(?=[^>]*\bname="armdyn-made-of")[^>]*\bcontent="(\w+)"')
TEMPLATES = Path(__file__).with_name("templates")


class Renewal:
    """Of one run of `nbgrader generate_feedback`, whose converter it tells which pages are old."""

    def __init__(self, converter):
        self._course = converter.coursedir
        self._log = converter.log
        self._made_of: dict[tuple[str, str], str] = {}
        self._layout = digest(*(path.read_bytes() for path in sorted(TEMPLATES.rglob("*.*"))))
        is_wanted = converter.init_destination

        def init_destination(assignment: str, student: str) -> bool:
            self._forget_old(assignment, student)
            return is_wanted(assignment, student)

        converter.init_destination = init_destination

    def made_of(self, assignment: str, student: str) -> str:
        """A name for all that a student's page is made of."""
        key = assignment, student
        if key not in self._made_of:
            graded = Path(
                self._course.format_path(self._course.autograded_directory, student, assignment)
            )
            files = [
                (str(path.relative_to(graded)), path.stat().st_size, path.stat().st_mtime_ns)
                for path in sorted(graded.rglob("*"))
                if path.is_file()
            ]
            opened = worked.settings(Path(self._course.root)).get(assignment)
            marks, rows = self._marks(assignment, student), self._rows(assignment, student)
            self._made_of[key] = digest(self._layout, repr((files, opened, marks, rows)))
        return self._made_of[key]

    def _rows(self, assignment: str, student: str) -> list:
        """The rows of rubrics by which a person marked; none where they cannot be read."""
        kept = Kept(Path(self._course.root))
        try:
            found = {cell: kept.of(assignment, cell).get(student, {})
                     for cell in sorted(kept.cells(assignment))}  # fmt: skip
        except KeptError:
            return []
        return [
            (cell, entry.get(FIRST), entry.get(COUNTS)) for cell, entry in found.items() if entry
        ]

    def _marks(self, assignment: str, student: str) -> list:
        with Gradebook(self._course.db_url, self._course.course_id) as gradebook:
            try:
                submission = gradebook.find_submission(assignment, student)
            except MissingEntry:
                return []
            return [
                [
                    notebook.late_submission_penalty,
                    *sorted(
                        (one.name, one.auto_score, one.manual_score, one.extra_credit,
                         one.needs_manual_grade) for one in notebook.grades
                    ),
                    *sorted((one.name, one.auto_comment, one.manual_comment)
                            for one in notebook.comments),
                ]
                for notebook in submission.notebooks
            ]  # fmt: skip

    def _forget_old(self, assignment: str, student: str) -> None:
        """Remove a page that is not of what there is now."""
        folder = self._course.format_path(self._course.feedback_directory, student, assignment)
        pages = sorted(Path(folder).glob("*.html"))
        made_of = self.made_of(assignment, student) if pages else ""
        if any(_read(page) != made_of for page in pages):
            self._log.info("What %s shows has changed: it is made anew", os.path.relpath(folder))
            utils.rmtree(folder)


def _read(page: Path) -> str:
    with page.open(encoding="utf-8", errors="replace") as file:
        found = MADE_OF.search(file.read(2000))
    return found[1] if found else ""
