"""Checks what students handed in before it is read: plain files, and no links to elsewhere."""

import os
import stat
from datetime import datetime
from pathlib import Path

import nbformat
from nbconvert.exporters import NotebookExporter

from autograder.nbgrader_glue import times
from autograder.nbgrader_glue.handed_in import counted, mechanisms_beside
from autograder.nbgrader_glue.names import leave_out_unfit
from autograder.nbgrader_glue.start import can_start
from autograder.notebook.version import other_version
from autograder.protocol import one_line
from autograder.sandbox.room import Room


class RefusedError(ValueError):
    """The grader does not read a submission; the message says why."""


def check(folder: Path, top: Path) -> None:
    """RefusedError if a submission's folder contains a link that leads out of it, or no plain file.

    top: the folder of all submissions. No folder below it may be a link, as that could lead to another
    student's.
    """
    if folder.is_relative_to(top):
        for above in (folder, *folder.parents):
            if above == top:
                break
            if above.is_symlink():
                raise RefusedError(
                    f"the folder {one_line(above.name)} is a link: ask the student for the files"
                )
    real = folder.resolve()
    for name, folders, files in os.walk(folder):
        for entry in sorted(folders + files):
            path = Path(name, entry)
            _check_entry(path, one_line(str(path.relative_to(folder)), 100), real)


def _check_entry(path: Path, shown: str, folder: Path) -> None:
    again = "ask the student for the file itself"
    if path.is_symlink() and not Path(os.path.realpath(path)).is_relative_to(folder):
        raise RefusedError(f"{shown} is a link out of the submission: {again}")
    try:
        mode = path.stat().st_mode
    except OSError as error:
        raise RefusedError(f"{shown} leads nowhere ({error.strerror}): {again}") from None
    if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
        raise RefusedError(f"{shown} is a pipe, a device or the like: {again}")
    if path.suffix == ".ipynb" and not stat.S_ISREG(mode):
        raise RefusedError(f"{shown} is a folder: {again}")


def timestamp(folder: Path) -> datetime | None:
    """When a submission was handed in, in UTC; None if that is not known.

    RefusedError if its timestamp.txt holds no time, and cannot be put aside.
    """
    try:
        return times.of(folder)
    except OSError as error:
        raise RefusedError(
            f"{times.FILE} cannot be read, or written as {times.AS} ({error.strerror}): "
            "put the time of the submission into it, or delete it"
        ) from None


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
        for folder, notebooks in getattr(self.parent, "assignments", {}).items():
            self._read_time(Path(folder))
            name = self._course.assignment_id
            if (
                f"{name}.ipynb" not in map(os.path.basename, notebooks)
                and self._source(name).exists()
            ):
                self._look_for(Path(folder), name, notebooks)

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
        return super().from_filename(filename, resources=resources, **kw)

    def from_file(self, file_stream, resources=None, **kw):
        text = file_stream.read().removeprefix("\ufeff")  # Windows editors write it
        notebook = nbformat.reads(text, as_version=4)
        name = self._course.assignment_id
        source = self._source(name)
        if source.is_file():
            present = nbformat.read(source, as_version=4)
            if why := other_version(notebook, present, mechanisms_beside(source.parent)):
                raise RefusedError(f"{name}.ipynb {why}")
        return self.from_notebook_node(notebook, resources=resources, **kw)
