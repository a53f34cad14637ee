"""nbgrader's preprocessors of this course: for `nbgrader generate_assignment` and `autograde`."""

import secrets
from functools import lru_cache
from pathlib import Path

import nbformat
from nbformat import NotebookNode
from nbgrader.preprocessors import NbGraderPreprocessor
from traitlets import Unicode

from autograder.beside import Beside
from autograder.grade import grade, is_judged
from autograder.nbgrader_glue import handed_in
from autograder.nbgrader_glue.scores import with_verdicts
from autograder.repair import repair


class ContinuePastChecks(NbGraderPreprocessor):
    """For `generate_assignment`: a check that is not met stops no "Run All Cells"."""

    def preprocess_cell(self, cell, resources, index):
        if is_judged(cell):
            tags = cell.metadata.setdefault("tags", [])
            if "raises-exception" not in tags:
                tags.append("raises-exception")
        return cell, resources


class FromSource(NbGraderPreprocessor):
    """A preprocessor that needs the source version of the notebook at hand."""

    def source_of(self, resources) -> NotebookNode:
        # An exporter's parent is the converter, which knows the course's folders.
        coursedir = self.parent.parent.coursedir
        names = resources["nbgrader"]
        folder = coursedir.format_path(coursedir.source_directory, ".", names["assignment"])
        path = Path(folder) / f"{names['notebook']}.ipynb"
        return _read_source(path, path.stat().st_mtime_ns)

    def submitted(self, names) -> Path:
        course = self.parent.parent.coursedir
        return Path(
            course.format_path(course.submitted_directory, names["student"], names["assignment"])
        )

    def beside(self, names) -> Beside:
        converter = self.parent.parent
        course, assignment = converter.coursedir, names["assignment"]
        source = Path(course.format_path(course.source_directory, ".", assignment))
        kept = converter.exclude_overwriting.get(assignment, [])
        return handed_in.beside(self.submitted(names), source, course.ignore, kept)


@lru_cache(maxsize=8)
def _read_source(path: Path, changed: int) -> NotebookNode:
    return nbformat.read(path, as_version=4)


class RepairCells(FromSource):
    """For `autograde`, first: graded cells as in the source, so that no copied cell stops a batch."""

    def preprocess(self, nb, resources):
        names, source = resources["nbgrader"], self.source_of(resources)
        _, said = handed_in.counted(self.submitted(names), names["notebook"], source)
        nb, notes = repair(nb, source, said, self.beside(names).documents)
        for note in notes:
            self.log.warning("%s: %s", names["student"], note)
        return nb, resources


class Judge(FromSource):
    """For `autograde`, in the place of nbgrader's Execute: verdicts as outputs of the grade cells."""

    seed_file = Unicode(
        "course/seed",
        help="The secret that decides the random cases; made on first use. Keep it to get the "
        "same verdicts again.",
    ).tag(config=True)

    def preprocess(self, nb, resources):
        names = resources["nbgrader"]
        secret = secret_of(Path(self.parent.parent.coursedir.root) / self.seed_file)
        seed = seed_of(secret, names["student"], names["assignment"])
        graded = grade(nb, self.source_of(resources), seed, self.beside(names))
        for note in graded.notes:
            self.log.warning("%s: %s", names["student"], note)
        return with_verdicts(graded), resources


def secret_of(path: Path) -> str:
    """The instructor's secret; made where there is none yet."""
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(secrets.token_hex(16) + "\n", encoding="utf-8")
        path.chmod(0o600)
    return path.read_text(encoding="utf-8").strip()


def seed_of(secret: str, student: str, assignment: str) -> str:
    return f"{secret}\0{student}\0{assignment}"
