"""The course's preprocessors for nbgrader's generate_assignment, autograde and generate_feedback."""

import secrets
from collections.abc import Iterable
from functools import lru_cache
from logging import Logger
from pathlib import Path

import nbformat
from nbformat import NotebookNode
from nbgrader.preprocessors import GetGrades, NbGraderPreprocessor, SaveAutoGrades
from traitlets import Unicode

from autograder.files import put_in_place
from autograder.nbgrader_glue import handed_in, times
from autograder.nbgrader_glue.items import UNREAD
from autograder.notebook.beside import Beside
from autograder.notebook.grade import grade, is_judged
from autograder.notebook.repair import repair
from autograder.notebook.scores import with_verdicts
from autograder.notebook.suggestion import suggestion_of
from autograder.terminal import shown_name, shown_note


class ContinuePastErrors(NbGraderPreprocessor):
    """For `generate_assignment`: "Run All" goes on after a broken answer or a wrong one."""

    def preprocess_cell(self, cell, resources, index):
        claims = cell.metadata.get("nbgrader") or {}
        if is_judged(cell) or (cell.cell_type == "code" and claims.get("solution")):
            tags = cell.metadata.setdefault("tags", [])
            if "raises-exception" not in tags:
                tags.append("raises-exception")
        return cell, resources


class FromSource(NbGraderPreprocessor):
    """A preprocessor that needs the notebook's source version."""

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
    """For `autograde`, first: puts graded cells right, so that no copied cell stops the command."""

    def preprocess(self, nb, resources):
        names, source = resources["nbgrader"], self.source_of(resources)
        folder = self.submitted(names)
        _, notes = handed_in.counted(folder, names["notebook"], source)
        notes = [*filter(None, [times.note(folder)]), *notes]
        nb, notes = repair(nb, source, notes, self.beside(names).documents)
        _warn(self.log, names["student"], notes)
        return nb, resources


class Judge(FromSource):
    """For `autograde`, instead of nbgrader's Execute: writes verdicts as outputs of the grade cells."""

    seed_file = Unicode(
        "course/seed",
        help="The file with the secret that decides the random cases. It is made on first use; keep "
        "it to get the same verdicts again.",
    ).tag(config=True)

    def preprocess(self, nb, resources):
        names = resources["nbgrader"]
        secret = secret_of(Path(self.parent.parent.coursedir.root) / self.seed_file)
        seed = seed_of(secret, names["student"], names["assignment"])
        source, student = self.source_of(resources), names["student"]
        graded = grade(nb, source, seed, self.beside(names), student=student)
        _warn(self.log, names["student"], graded.notes)
        return with_verdicts(graded), resources


class SaveSuggestions(SaveAutoGrades):
    """For `autograde`, instead of nbgrader's SaveAutoGrades: saves what marked lines suggest, too. A
    person still has to read the answer.
    """

    def _add_score(self, cell, resources):
        super()._add_score(cell, resources)
        if suggestion := suggestion_of(cell):
            grade = self.gradebook.find_grade(*_place(self, cell))
            grade.auto_score, grade.needs_manual_grade = suggestion.points, True
            self.gradebook.db.commit()

    def _add_comment(self, cell, resources):
        super()._add_comment(cell, resources)
        if suggestion := suggestion_of(cell):
            comment = self.gradebook.find_comment(*_place(self, cell))
            said = filter(None, [comment.auto_comment, suggestion.comment])
            comment.auto_comment = " ".join(said)
            self.gradebook.db.commit()


class GetDecidedGrades(GetGrades):
    """For `generate_feedback`, instead of nbgrader's GetGrades: once a person has decided on an answer,
    the page no longer says which points its lines suggest. Until then the answer says that it is unread.
    """

    def _get_score(self, cell, resources):
        super()._get_score(cell, resources)
        cell.metadata.nbgrader[UNREAD] = self.gradebook.find_grade(
            *_place(self, cell)
        ).needs_manual_grade

    def _get_comment(self, cell, resources):
        super()._get_comment(cell, resources)
        said = cell.metadata.nbgrader["comment"]
        if said and (suggestion := suggestion_of(cell)):
            grade = self.gradebook.find_grade(*_place(self, cell))
            if grade.manual_score is not None or not grade.needs_manual_grade:
                cell.metadata.nbgrader["comment"] = suggestion.without_points(said) or None


def _place(of, cell):
    """Where the gradebook has a cell's grade and comment."""
    return cell.metadata["nbgrader"]["grade_id"], of.notebook_id, of.assignment_id, of.student_id


def _warn(log: Logger, student: str, notes: Iterable[str]) -> None:
    for note in notes:
        log.warning("%s: %s", shown_name(student), shown_note(note))


def secret_of(path: Path) -> str:
    """The instructor's secret, made if there is none yet. ValueError if its file is empty."""
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        put_in_place(path, secrets.token_hex(16) + "\n", 0o600)
    secret = path.read_text(encoding="utf-8").strip()
    if not secret:
        raise ValueError(
            f"{path} is empty: put the course's seed back, or delete the file to get a new seed"
        )
    return secret


def seed_of(secret: str, student: str, assignment: str) -> str:
    return f"{secret}\0{student}\0{assignment}"
