"""Does what `nbgrader autograde` does around the judging, for many submissions of one assignment."""

import copy
from functools import cached_property
from pathlib import Path
from typing import Self

import nbformat
from nbformat import NotebookNode
from nbgrader import utils
from nbgrader.nbgraderformat import MetadataValidator
from traitlets import import_item
from traitlets.config import Config

from autograder.nbgrader_glue import names
from autograder.nbgrader_glue.decided import same_answers
from autograder.nbgrader_glue.folders import Folders
from autograder.nbgrader_glue.gradebook import Rows, Standing
from autograder.nbgrader_glue.late import Lateness
from autograder.nbgrader_glue.preprocessors import Judge, secret_of, seed_of
from autograder.nbgrader_glue.release import configuration
from autograder.nbgrader_glue.steps import autograde_preprocessors, sanitize_preprocessors
from autograder.nbgrader_glue.submitted import RefusedError
from autograder.notebook.beside import Beside
from autograder.notebook.recognise import grade_id
from autograder.term_calendar import read_if_there

# This module or `repair` does the work of these steps, whatever their settings.
REPLACED = (
    *("ClearOutput", "DeduplicateIds", "OverwriteKernelspec", "OverwriteCells"),
    *(
        "CheckCellMetadata",
        "SaveAutoGrades",
        "SaveSuggestions",
        "ClearOutputPreprocessor",
        "RepairCells",
    ),
)
# Steps that run as they are, on the judged notebook.
RUN = ("IgnorePattern", "ClearMetadataPreprocessor", "LimitOutput")


class Recorder:
    """One assignment's folders and gradebook. Use as a context manager.

    ValueError if the assignment cannot be graded here: it is not in the gradebook yet, it has not one
    notebook of its own name, or nbgrader_config.py asks for steps that only nbgrader can do.
    """

    def __init__(self, root: Path, assignment: str):
        config = configuration(root)
        config.CourseDirectory.assignment_id = assignment
        self.assignment = assignment
        self._folders = Folders(config, assignment)
        self._converter = self._folders.converter
        _refuse_other_steps(config, self._converter)
        steps = [import_item(name) for name in autograde_preprocessors()]
        self._steps = [step(parent=self._converter) for step in steps if step.__name__ in RUN]
        lateness = Lateness(read_if_there(root).of(assignment), config, self._converter)
        course = self._folders.course
        self._secret = secret_of(Path(course.root) / Judge(parent=self._converter).seed_file)
        self.source = (self._folders.source / f"{assignment}.ipynb").read_text(encoding="utf-8")
        self._rows = Rows(course.db_url, course.course_id, assignment, lateness)
        try:
            self._agree_with_source()
        except BaseException:
            self._rows.close()
            raise
        self.max_score: float = sum(self._rows.points.values())
        # What else decides a grade, besides the submission, the source and the seed.
        self.settings = repr((config, self._rows.source_cells, self._rows.points))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        self._rows.close()

    def submissions(self) -> dict[str, Path]:
        """Student → where that student's notebook is, or should be; in order of the names."""
        return self._folders.submissions()

    def standings(self) -> dict[str, Standing]:
        """What the gradebook holds, by student."""
        return self._rows.standings()

    def autograded(self, student: str) -> Path:
        return self._folders.autograded(student)

    def refusal(self, student: str) -> str:
        """Why the grader must not read a submission, such as a link in it; empty if it may."""
        try:
            self._folders.check(student)
        except RefusedError as error:
            return str(error)
        return ""

    def counted(self, student: str) -> tuple[Path, list[str]]:
        """The notebook of a submission that is graded, and notes on the others."""
        return self._folders.counted(student, self._source)

    @cached_property
    def _source(self) -> NotebookNode:
        return nbformat.reads(self.source, as_version=4)

    def laid_in(self, student: str) -> Beside:
        """The files that the notebook's cells find beside it."""
        return self._folders.laid_in(student)

    def seed_of(self, student: str) -> str:
        return seed_of(self._secret, student, self.assignment)

    def files_of(self, student: str) -> str:
        """What lies beside a submission and its source, as text that changes when a file does."""
        return repr((self._folders.beside(student), self._folders.beside_source))

    def record(self, student: str, judged: dict) -> Standing:
        """Write a judged submission's rows and files; if that fails, the earlier ones stay."""
        notebook: NotebookNode = nbformat.from_dict(judged)
        for cell in notebook.cells:
            if grade_id(cell):
                checksum = self._rows.source_cells[grade_id(cell)].checksum
                cell.metadata["nbgrader"]["checksum"] = checksum
        for step in self._steps:
            notebook, _ = step(notebook, {})
        text = nbformat.v4.writes(notebook).encode() + b"\n"
        self._may_enter(student)
        marked = self._folders.graded_before(student)
        same = same_answers(marked, notebook) if marked else set()
        with self._folders.written(student, text):
            return self._rows.record(student, self._folders.timestamp(student), notebook, same)

    def refuse(self, student: str) -> None:
        """Enter a submission that cannot be graded, and remove the notebook of an earlier one.

        As with nbgrader, a folder without any notebook is no submission. If a folder's name cannot be
        a student's id, nothing is entered or removed.
        """
        if names.refusal(student):
            return
        if self._folders.holds_notebook(student):
            self._may_enter(student)
            try:
                timestamp = self._folders.timestamp(student)
            except RefusedError:
                timestamp = None
            self._rows.enter_alone(student, timestamp)
        self._folders.remove(student)

    def forget(self) -> None:
        """Drop what was not committed, after an error."""
        self._rows.forget()

    def _may_enter(self, student: str) -> None:
        if not (self._converter.create_student or self._rows.knows(student)):
            raise ValueError(
                f"the gradebook does not know {student}, and nbgrader_config.py forbids new students"
            )

    def _agree_with_source(self) -> None:
        """Check once what nbgrader would check in each repaired submission."""
        where = f"solutions/{self.assignment}"
        again = f"run `nbgrader generate_assignment {self.assignment} --force`"
        source = nbformat.reads(self.source, as_version=4)
        try:
            MetadataValidator().validate_nb(source)
        except Exception as error:
            raise ValueError(f"{where}: its nbgrader settings are not valid: {error}") from None
        for cell in source.cells:
            name = grade_id(cell)
            if name and name not in self._rows.source_cells:
                raise ValueError(f"{where} has a cell {name}, but the gradebook does not: {again}")
            if name and not _can_be_put_right(cell, self._rows.source_cells[name], self._rows):
                raise ValueError(f"Inconsistent checksums: {name} has changed in {where}: {again}")


def _can_be_put_right(cell: NotebookNode, known, rows: Rows) -> bool:
    """Whether nbgrader's OverwriteCells can make a locked cell the one in the gradebook again."""
    if not known.locked:
        return True
    cell = copy.deepcopy(cell)
    cell.source, cell.cell_type = known.source, known.cell_type
    cell.metadata["nbgrader"]["locked"] = True
    if utils.is_grade(cell) and known.name in rows.points:
        cell.metadata["nbgrader"]["points"] = rows.points[known.name]
    return utils.compute_checksum(cell) == known.checksum


def _refuse_other_steps(config: Config, converter) -> None:
    lists = {
        "sanitize_preprocessors": sanitize_preprocessors(),
        "autograde_preprocessors": autograde_preprocessors(),
    }
    other = [f"Autograde.{name}" for name, ours in lists.items()
             if list(map(_class, getattr(converter, name))) != list(map(_class, ours))]  # fmt: skip
    other += [name for name in REPLACED if config.get(name)]
    hooks = ("pre_convert_hook", "post_convert_hook")
    other += [f"Autograde.{name}" for name in hooks if getattr(converter, name) is not None]
    if other:
        raise ValueError(
            f"nbgrader_config.py sets {', '.join(other)}, which only nbgrader itself follows: "
            "use `nbgrader autograde`, or remove the setting"
        )


def _class(step) -> type:
    return import_item(step) if isinstance(step, str) else step
