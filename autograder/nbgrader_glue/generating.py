"""Makes `nbgrader generate_assignment` say what has changed, and never leave a course without a release.

nbgrader skips a release that is there, whatever has changed since, and removes it when it fails.
"""

import json
import logging
import shutil
import tempfile
from pathlib import Path

import nbformat
from nbconvert.exporters import NotebookExporter
from nbgrader import api
from nbgrader.converters.base import NbGraderException

from autograder.nbgrader_glue import agreement, worked
from autograder.nbgrader_glue.in_words import stopping
from autograder.nbgrader_glue.kept_editions import FOLDER, keep
from autograder.nbgrader_glue.release import generate
from autograder.nbgrader_glue.source import look_at
from autograder.nbgrader_glue.start import can_start
from autograder.protocol import one_line
from autograder.terminal import plain


class ReleaseExporter(NotebookExporter):
    """nbconvert's exporter; nbgrader makes it when it has found the sources, and before it changes
    anything.
    """

    def __init__(self, config=None, **kw):
        super().__init__(config=config, **kw)
        converter = self.parent
        if converter is None or converter.no_database:
            return
        for notebooks in getattr(converter, "assignments", {}).values():
            for path in map(Path, sorted(notebooks)):
                look_at(path, converter.coursedir.ignore, converter.log)
        can_start(converter)
        convert = converter.convert_notebooks

        def convert_notebooks() -> None:
            changes = [_Change(converter, Path(folder).name) for folder in converter.assignments]
            with stopping(converter):
                for change in changes:
                    change.check()
            try:
                convert()
            finally:
                for change in changes:
                    change.finish()

        converter.convert_notebooks = convert_notebooks


class _Change:
    """One assignment's release, before and after a run."""

    def __init__(self, converter, assignment: str):
        self._converter, self._course, self._log = converter, converter.coursedir, converter.log
        self._name, self._root = assignment, Path(converter.coursedir.root)
        self._release = agreement.released(self._course, assignment)
        self._aside = self._root / FOLDER / assignment / "release-before"
        self._graded: list[str] = []

    def check(self) -> None:
        """NbGraderException if nothing may be done; else put the present release aside."""
        folder = self._release.parent
        if self._aside.exists() and not folder.exists():  # an earlier run was killed
            shutil.copytree(self._aside, folder)
        if not folder.exists():
            return
        if self._source().is_file():
            self._compare(folder)
        if self._converter.force:
            shutil.rmtree(self._aside, ignore_errors=True)
            shutil.copytree(folder, self._aside)

    def _compare(self, folder: Path) -> None:
        """Remember what is graded otherwise now; NbGraderException without --force, or if it fails."""
        with tempfile.TemporaryDirectory(prefix="release-") as made:
            now = self._try(Path(made))
            same = _same(now, folder)
        source = nbformat.read(self._source(), as_version=4)
        self._graded = agreement.from_gradebook(source, self._cells())
        if not self._graded and self._release.is_file():
            text = self._release.read_text(encoding="utf-8")
            self._graded = agreement.from_release(source, text)
        if not self._converter.force and (self._graded or not same):
            what = agreement.few(self._graded) or "a text or a file is another"
            self._refuse(
                f"course/release/{self._name} is older than solutions/{self._name}: {what}. "
                f"Nothing was changed: {agreement.again(self._name)} to make it anew"
            )
        if self._release.is_file():
            keep(self._root, self._name, self._release)

    def finish(self) -> None:
        """Keep the new edition, and say what follows; if there is none, put the old release back."""
        folder = self._release.parent
        if self._aside.exists() and not folder.exists():
            shutil.copytree(self._aside, folder)
            self._log.error("course/release/%s is as it was before", self._name)
        elif self._release.is_file():
            keep(self._root, self._name, self._release)
            if self._aside.exists():
                self._say_what_follows()
        shutil.rmtree(self._aside, ignore_errors=True)

    def _say_what_follows(self) -> None:
        for line in self._graded:
            self._log.warning("Brought up to date: %s", plain(line))
        if self._graded and (count := self._submissions()):
            self._log.warning(
                "%d submissions were graded by that. Grade them again: `autograder grade %s`, or "
                "`nbgrader autograde %s`",
                *(count, self._name, self._name),
            )
        new, mine = self._release.parent, self._root / "problems" / self._name
        others = [at for at in worked.places(self._root, self._name) if at not in (new, mine)]
        if not all(_same(new, other) for other in others):
            self._log.warning(
                "Students fetch the older one until you run `nbgrader release_assignment %s --force`",
                self._name,
            )

    def _try(self, folder: Path) -> Path:
        """The release as it would be made now, in a folder of its own."""
        log = logging.Logger("autograder.nbgrader.generate")
        heard = _Heard()
        log.addHandler(heard)
        try:
            return generate(self._root, self._name, folder, log)
        except Exception as error:
            why = one_line(heard.reason or str(error), 500)
            self._refuse(
                f"solutions/{self._name} cannot be released: {why}. The release and the gradebook are "
                "as they were before"
            )
            raise

    def _refuse(self, why: str) -> None:
        self._log.error(plain(why))
        raise NbGraderException(why)

    def _source(self) -> Path:
        course = self._course
        folder = agreement.folder_of(course, course.source_directory, self._name)
        return folder / f"{self._name}.ipynb"

    def _cells(self) -> dict[str, agreement.Known]:
        with api.Gradebook(self._course.db_url, self._course.course_id) as gradebook:
            try:
                return agreement.of_gradebook(gradebook.find_notebook(self._name, self._name))
            except api.MissingEntry:
                return {}

    def _submissions(self) -> int:
        with api.Gradebook(self._course.db_url, self._course.course_id) as gradebook:
            return len(gradebook.assignment_submissions(self._name))


class _Heard(logging.Handler):
    """Remembers the reason of an error that nbgrader logs in many lines, the last of a traceback."""

    def __init__(self):
        super().__init__(logging.ERROR)
        self.reason = ""

    def emit(self, record: logging.LogRecord) -> None:
        text = record.getMessage()
        if "Traceback" in text and not self.reason:
            self.reason = text.strip().splitlines()[-1]


def _same(made: Path, there: Path) -> bool:
    """Whether all that was made is there, too."""
    for path in made.rglob("*"):
        other = there / path.relative_to(made)
        if path.is_file() and not (other.is_file() and _content(path) == _content(other)):
            return False
    return True


def _content(path: Path):
    """What is in a file, however a notebook's JSON is laid out."""
    if path.suffix == ".ipynb":
        try:
            return json.loads(path.read_text(encoding="utf-8"))
        except ValueError:
            pass
    return path.read_bytes()
