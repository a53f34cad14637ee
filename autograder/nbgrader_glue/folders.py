"""An assignment's folders in a course, as nbgrader lays them out and writes them."""

import glob
import logging
import os
import re
import shutil
from pathlib import Path

from nbformat import NotebookNode
from nbgrader import utils
from nbgrader.converters import Autograde
from nbgrader.coursedir import CourseDirectory
from traitlets.config import Config

from autograder.beside import Beside
from autograder.nbgrader_glue import handed_in, submitted

QUIET = logging.getLogger("autograder.nbgrader")
QUIET.setLevel(logging.CRITICAL)  # what is mended stands in the summary table

Files = dict[str, tuple[int, int]]  # path in its folder → size, time in ns


class Folders:
    """Where submissions are, and where their graded notebooks go."""

    def __init__(self, config: Config, assignment: str):
        self.assignment = assignment
        self.course = CourseDirectory(config=config, log=QUIET)
        self.converter = Autograde(coursedir=self.course, config=config, log=QUIET)
        self.source = Path(self.course.format_path(self.course.source_directory, ".", assignment))
        self.beside_source = self._files(self.source)
        self._not_copied = {os.path.join("", name) for name in
                            self.converter.exclude_overwriting.get(assignment, [])}  # fmt: skip

    def submissions(self) -> dict[str, Path]:
        """Student → where that student's notebook is, or should be; in order of the names."""
        excluded = self.course.student_id_exclude.split(",")
        pattern = self.course.format_path(
            self.course.submitted_directory, "(?P<student>[^/\\\\]*)", self.assignment, escape=True
        )
        found = {}
        for folder in glob.glob(str(self.submitted("*"))):
            match = re.fullmatch(pattern, folder)
            if match and match["student"] not in excluded:
                found[match["student"]] = Path(folder) / f"{self.assignment}.ipynb"
        return dict(sorted(found.items()))

    def submitted(self, student: str) -> Path:
        course = self.course
        return Path(course.format_path(course.submitted_directory, student, self.assignment))

    def autograded(self, student: str) -> Path:
        course = self.course
        folder = course.format_path(course.autograded_directory, student, self.assignment)
        return Path(folder) / f"{self.assignment}.ipynb"

    def counted(self, student: str, source: NotebookNode) -> tuple[Path, list[str]]:
        """The notebook of a submission that is graded, and what to know of the others."""
        return handed_in.counted(self.submitted(student), self.assignment, source)

    def laid_in(self, student: str) -> Beside:
        """The files that the notebook's cells find beside it."""
        kept = self.converter.exclude_overwriting.get(self.assignment, [])
        return handed_in.beside(self.submitted(student), self.source, self.course.ignore, kept)

    def timestamp(self, student: str):
        """When it was handed in, in UTC; None where that is not known. RefusedError where it is none."""
        return submitted.timestamp(self.course, self.submitted(student))

    def check(self, student: str) -> None:
        """RefusedError where nothing of the submission is to be read."""
        top = Path(self.course.root) / self.course.submitted_directory
        submitted.check(self.submitted(student), top)
        self.timestamp(student)

    def holds_notebook(self, student: str) -> bool:
        return any(self.submitted(student).glob("*.ipynb"))

    def beside(self, student: str) -> Files:
        """A submission's files that are not notebooks."""
        return self._files(self.submitted(student))

    def write(self, student: str, notebook: bytes) -> None:
        """The graded notebook, and the files beside it; the source's win over the student's.

        The notebook comes last and at once: where it is, the rest is there too.
        """
        self.remove(student)
        path = self.autograded(student)
        path.parent.mkdir(mode=0o755, parents=True)
        copied = {name: self.submitted(student) for name in self.beside(student)}
        copied |= dict.fromkeys(self.beside_source.keys() - self._not_copied, self.source)
        for name, folder in copied.items():
            target = path.parent / name
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(folder / name, target)
        path.with_suffix(".part").write_bytes(notebook)
        path.with_suffix(".part").replace(path)
        self.converter.set_permissions(self.assignment, student)

    def remove(self, student: str) -> None:
        folder = self.autograded(student).parent
        if folder.exists():
            utils.rmtree(str(folder))

    def _files(self, folder: Path) -> Files:
        found = utils.find_all_files(str(folder), [*self.course.ignore, "*.ipynb"])
        stats = {os.path.relpath(name, folder): os.stat(name) for name in sorted(found)}
        return {name: (stat.st_size, stat.st_mtime_ns) for name, stat in stats.items()}
