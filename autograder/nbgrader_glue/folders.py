"""Finds and writes an assignment's folders in a course, where nbgrader has them."""

import filecmp
import glob
import logging
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from nbformat import NotebookNode
from nbgrader import utils
from nbgrader.converters import Autograde
from nbgrader.coursedir import CourseDirectory
from traitlets.config import Config

from autograder import hints_seen
from autograder.digest import digest
from autograder.nbgrader_glue import handed_in, names, submitted, times
from autograder.nbgrader_glue.source import beside_source
from autograder.notebook.beside import Beside

QUIET = logging.getLogger("autograder.nbgrader")
QUIET.setLevel(logging.CRITICAL)  # the summary table says what was put right

ABOUT_IT = {*handed_in.OF_THE_EXCHANGE, hints_seen.FILE}  # files that are no part of an answer

Files = dict[str, tuple[int, int]]  # path in its folder → size, time in ns


class Folders:
    """Where submissions are, and where their graded notebooks go.

    converter: nbgrader's, if its command is running.
    """

    def __init__(self, config: Config, assignment: str, converter: Autograde | None = None):
        self.assignment = assignment
        if converter is None:
            course = CourseDirectory(config=config, log=QUIET)
            converter = Autograde(coursedir=course, config=config, log=QUIET)
        self.course, self.converter = converter.coursedir, converter
        self.source = Path(self.course.format_path(self.course.source_directory, ".", assignment))
        self.beside_source = self._files(self.source)
        self._not_copied = {os.path.join("", name) for name in
                            self.converter.exclude_overwriting.get(assignment, [])}  # fmt: skip

    def submissions(self) -> dict[str, Path]:
        """Student → where that student's notebook is, or should be; in order of the names."""
        step = self.course.submitted_directory
        found = names.folders(self.course, step, "*", glob.escape(self.assignment))
        return {student: Path(folder) / f"{self.assignment}.ipynb"
                for folder, student in found.items()}  # fmt: skip

    def submitted(self, student: str) -> Path:
        course = self.course
        return Path(course.format_path(course.submitted_directory, student, self.assignment))

    def autograded(self, student: str) -> Path:
        course = self.course
        folder = course.format_path(course.autograded_directory, student, self.assignment)
        return Path(folder) / f"{self.assignment}.ipynb"

    def counted(self, student: str, source: NotebookNode) -> tuple[Path, list[str]]:
        """The notebook of a submission that is graded, and notes on the others."""
        folder = self.submitted(student)
        path, notes = handed_in.counted(folder, self.assignment, source)
        return path, [*filter(None, [times.note(folder)]), *notes]

    def laid_in(self, student: str) -> Beside:
        """The files that the notebook's cells find beside it."""
        kept = self.converter.exclude_overwriting.get(self.assignment, [])
        return handed_in.beside(self.submitted(student), self.source, self.course.ignore, kept)

    def laid_in_source(self) -> Beside:
        """The files that the source's own cells find beside it."""
        return beside_source(self.source, self.course.ignore)

    def timestamp(self, student: str):
        """When it was handed in, in UTC, or None; RefusedError if its timestamp.txt cannot be read."""
        return submitted.timestamp(self.submitted(student))

    def check(self, student: str) -> None:
        """RefusedError if the grader must not read the submission."""
        if why := names.refusal(student):
            raise submitted.RefusedError(why)
        top = Path(self.course.root) / self.course.submitted_directory
        submitted.check(self.submitted(student), top)
        self.timestamp(student)

    def holds_notebook(self, student: str) -> bool:
        return any(self.submitted(student).glob("*.ipynb"))

    def beside(self, student: str) -> Files:
        """A submission's files that are not notebooks."""
        return self._files(self.submitted(student))

    def graded_before(self, student: str) -> bytes:
        """The graded notebook that is there; b"" if there is none, or if other files lie beside the
        submission now, which may be part of an answer.
        """
        path = self.autograded(student)
        ours = self.beside_source.keys() - self._not_copied
        handed_in = self.beside(student).keys() - ours - ABOUT_IT
        there = self._files(path.parent).keys() - ours - ABOUT_IT
        if not path.is_file() or handed_in != there:
            return b""
        folder = self.submitted(student)
        same = all(filecmp.cmp(folder / name, path.parent / name, shallow=False) for name in there)
        return path.read_bytes() if same else b""

    @contextmanager
    def written(self, student: str, notebook: bytes) -> Iterator[None]:
        """Put the graded notebook and the files beside it in place when the block ends.

        The source's files replace a student's of the same name. If something fails, here or in the
        block, what was there before stays.
        """
        path = self.autograded(student)
        folder = path.parent
        new, old = (folder.parent / f".{name}-{digest(student, self.assignment)[:16]}"
                    for name in ("new", "old"))  # fmt: skip
        if old.exists() and not folder.exists():
            old.rename(folder)  # a run was killed between the two lines that change them
        for left in (new, old):
            _remove(left)
        try:
            self._fill(new, student)
            (new / path.name).write_bytes(notebook)
            yield
            if folder.exists():
                folder.rename(old)
            try:
                new.rename(folder)
            except OSError:
                if old.exists():
                    old.rename(folder)
                raise
        except BaseException:
            with suppress(OSError):
                _remove(new)
            raise
        _remove(old)
        self.converter.set_permissions(self.assignment, student)

    def _fill(self, folder: Path, student: str) -> None:
        """Fill a folder with the files beside the notebook."""
        folder.mkdir(mode=0o755, parents=True)
        copied = {name: self.submitted(student) for name in self.beside(student)}
        copied |= dict.fromkeys(self.beside_source.keys() - self._not_copied, self.source)
        for name, origin in copied.items():
            target = folder / name
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(origin / name, target)

    def remove(self, student: str) -> None:
        _remove(self.autograded(student).parent)

    def _files(self, folder: Path) -> Files:
        found = utils.find_all_files(str(folder), [*self.course.ignore, "*.ipynb"])
        stats = {os.path.relpath(name, folder): os.stat(name) for name in sorted(found)}
        return {name: (stat.st_size, stat.st_mtime_ns) for name, stat in stats.items()}


def _remove(folder: Path) -> None:
    if folder.exists():
        utils.rmtree(str(folder))
