"""Does what `nbgrader autograde` does around the judging, for many submissions of one assignment."""

import sys
from functools import cached_property
from pathlib import Path
from typing import Self

import nbformat
from nbformat import NotebookNode
from nbgrader.nbgraderformat import MetadataValidator
from traitlets import TraitError, import_item
from traitlets.config import Config

from autograder.nbgrader_glue import agreement, names
from autograder.nbgrader_glue.decided import same_answers
from autograder.nbgrader_glue.folders import Folders
from autograder.nbgrader_glue.gradebook import Rows, Standing
from autograder.nbgrader_glue.kept_editions import kept
from autograder.nbgrader_glue.late import Lateness
from autograder.nbgrader_glue.preprocessors import Judge, secret_of, seed_of
from autograder.nbgrader_glue.release import configuration
from autograder.nbgrader_glue.steps import autograde_preprocessors, sanitize_preprocessors
from autograder.nbgrader_glue.submitted import RefusedError
from autograder.notebook.beside import Beside
from autograder.notebook.recognise import grade_id
from autograder.problems import own_checks
from autograder.term_calendar import read_if_there
from autograder.terminal import say

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
        judge = _judge(self._converter)
        self._secret = secret_of(Path(course.root) / judge.seed_file)
        self.carried_on: float = judge.carried_on
        # Before 100 students are told that a check failed.
        own_checks.refuse_broken(own_checks.files_of(self._folders.source))
        self.source = (self._folders.source / f"{assignment}.ipynb").read_text(encoding="utf-8")
        self._rows = Rows(course.db_url, course.course_id, assignment, lateness)
        try:
            self._agree_with_source()
        except BaseException:
            self._rows.close()
            raise
        self.max_score: float = sum(self._rows.points.values())
        # What else decides a graded notebook. A path, an export or a penalty does not.
        cells = sorted(self._rows.cells.items())
        self.settings = repr(([_settings(step) for step in self._steps], cells))
        self.earlier = kept(root, assignment)

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

    def laid_in_source(self) -> Beside:
        """The files that the source's own cells find beside it."""
        return self._folders.laid_in_source()

    def seed_of(self, student: str) -> str:
        return seed_of(self._secret, student, self.assignment)

    def files_of(self, student: str) -> str:
        """What lies beside a submission and its source, as text that changes when a file does."""
        return repr((self._folders.beside(student), self._folders.beside_source))

    def record(self, student: str, judged: dict) -> Standing:
        """Write a judged submission's rows and files; if that fails, the earlier ones stay."""
        notebook: NotebookNode = nbformat.from_dict(judged)
        for cell in notebook.cells:
            if (name := grade_id(cell)) in self._rows.cells:
                checksum = self._rows.cells[name].checksum
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
        """Check once what nbgrader would check in each repaired submission, and more."""
        try:
            MetadataValidator().validate_nb(self._source)
        except Exception as error:
            raise ValueError(
                f"solutions/{self.assignment}: its nbgrader settings are not valid: {error}"
            ) from None
        agreement.require(self._source, self._rows.cells, self.assignment)
        released = agreement.released(self._folders.course, self.assignment)
        if said := agreement.said_of_release(self._source, released, self.assignment):
            say(said, sys.stderr)


def _settings(step) -> tuple[str, list]:
    """A step's settings, whatever the rest of nbgrader_config.py says."""
    values = {name: getattr(step, name) for name in step.class_trait_names(config=True)}
    plain = {name: sorted(value, key=repr) if isinstance(value, set) else value
             for name, value in values.items()}  # fmt: skip
    return type(step).__name__, sorted(plain.items())


def _judge(converter) -> Judge:
    """The step with its settings; ValueError where one is not what it must be."""
    try:
        return Judge(parent=converter)
    except TraitError as error:
        raise ValueError(f"nbgrader_config.py: {error}") from None


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
