"""Reads the submissions of `nbgrader autograde`, once it is clear that they can be graded."""

import os
from pathlib import Path

import nbformat
from nbconvert.exporters import NotebookExporter
from nbgrader.converters.base import NbGraderException

from autograder.nbgrader_glue.agreement import DisagreementError, check_before
from autograder.nbgrader_glue.handed_in import counted, mechanisms_beside
from autograder.nbgrader_glue.in_words import stopping
from autograder.nbgrader_glue.late import read_files, settle_before
from autograder.nbgrader_glue.names import leave_out_unfit
from autograder.nbgrader_glue.regrading import Regrading
from autograder.nbgrader_glue.source import UnsoundError, refuse_unsound, tell
from autograder.nbgrader_glue.start import can_start
from autograder.nbgrader_glue.submitted import RefusedError, check, timestamp
from autograder.notebook.reading import UnreadableError, read
from autograder.notebook.version import other_version
from autograder.protocol import one_line
from autograder.sandbox.room import Room


class SubmissionExporter(NotebookExporter):
    """For `autograde`: reads a submission, with or without a BOM, after checking it.

    The converter goes by file names. If a submission has no notebook of the assignment's name, this
    class tells the converter that there is one, and reads the one that counts instead.
    nbgrader makes it when it has found the submissions, and before it changes anything.
    """

    def __init__(self, config=None, **kw):
        super().__init__(config=config, **kw)
        leave_out_unfit(self.parent)
        can_start(self.parent, lambda: Room().close())
        self._refuse_unsound()
        self.regrading = None
        if hasattr(self.parent, "init_destination"):
            with stopping(self.parent):
                self._agree()
                read_files(Path(self._course.root))
            self.regrading = Regrading(self.parent)
            self._settle_after()
        for folder, notebooks in getattr(self.parent, "assignments", {}).items():
            self._read_time(Path(folder))
            name = self._course.assignment_id
            if (
                f"{name}.ipynb" not in map(os.path.basename, notebooks)
                and self._source(name).exists()
            ):
                self._look_for(Path(folder), name, notebooks)

    def _settle_after(self) -> None:
        """Have the penalties of what was graded follow the calendar, as `autograder grade` does."""
        converter = self.parent
        assert converter is not None
        convert = converter.convert_notebooks

        def convert_notebooks() -> None:
            try:
                convert()
            finally:
                with stopping(converter):
                    settle_before(converter)

        converter.convert_notebooks = convert_notebooks

    def _refuse_unsound(self) -> None:
        """UnsoundError if the assignment's source cannot be graded as it is written."""
        found = getattr(self.parent, "assignments", {}).values()
        names = {Path(name).stem for notebooks in found for name in notebooks}
        names.add(self._course.assignment_id)
        for path in map(self._source, sorted(names)):
            if not path.is_file():
                continue
            try:
                refuse_unsound(path, self._course.ignore)
            except UnsoundError as error:
                tell(self.log, f"{error}\nNothing was graded, and nothing has changed.")
                raise

    def _agree(self) -> None:
        """NbGraderException if solutions/ and the gradebook differ in what is graded."""
        try:
            said = check_before(self._course, self._course.assignment_id)
        except DisagreementError as error:
            self.log.error(str(error))
            raise NbGraderException(str(error)) from None
        if said:
            self.log.warning(said)

    @property
    def _course(self):
        assert self.parent is not None  # `autograde` makes the exporter
        return self.parent.coursedir

    def _read_time(self, folder: Path) -> None:
        """Have nbgrader find a time that it can read, or none."""
        try:
            self._check(folder)
            timestamp(folder)
        except (OSError, RefusedError) as error:
            self.log.warning("%s: %s", folder, error)

    def _look_for(self, folder: Path, name: str, notebooks: list[str]) -> None:
        try:
            self._check(folder)
            self._counted(folder, name)
        except (OSError, RefusedError) as error:
            self.log.warning("%s: %s", folder, error)
        else:
            notebooks.append(str(folder / f"{name}.ipynb"))

    def _counted(self, folder: Path, name: str) -> Path:
        return counted(folder, name, nbformat.read(self._source(name), as_version=4))[0]

    def _source(self, name: str) -> Path:
        course = self._course
        folder = course.format_path(course.source_directory, ".", course.assignment_id)
        return Path(folder) / f"{name}.ipynb"

    def _check(self, folder: Path) -> None:
        course = self._course
        check(folder, Path(course.root) / course.submitted_directory)

    def from_filename(self, filename, resources=None, **kw):
        course, names = self._course, resources["nbgrader"]
        folder = Path(
            course.format_path(course.submitted_directory, names["student"], names["assignment"])
        )
        self._check(folder)
        if not os.path.exists(filename):
            filename = str(self._counted(folder, names["notebook"]))
        try:
            return super().from_filename(filename, resources=resources, **kw)
        except UnreadableError as error:
            raise RefusedError(f"{one_line(os.path.basename(filename))} {error}") from None

    def from_file(self, file_stream, resources=None, **kw):
        notebook, _ = read(file_stream.buffer.read())
        name = self._course.assignment_id
        source = self._source(name)
        if source.is_file():
            present = nbformat.read(source, as_version=4)
            if why := other_version(notebook, present, mechanisms_beside(source.parent)):
                raise RefusedError(f"{name}.ipynb {why}")
        return self.from_notebook_node(notebook, resources=resources, **kw)
