"""The course's preprocessors for nbgrader's generate_assignment, autograde and generate_feedback."""

import secrets
from collections.abc import Iterable
from dataclasses import asdict
from functools import lru_cache
from logging import Logger
from pathlib import Path

import nbformat
from nbformat import NotebookNode
from nbgrader.preprocessors import GetGrades, NbGraderPreprocessor, SaveAutoGrades
from traitlets import Float, Unicode

from autograder.files import put_in_place
from autograder.marking.kept import Kept, KeptError, counting
from autograder.nbgrader_glue import handed_in, times
from autograder.nbgrader_glue.items import ROWS, UNREAD
from autograder.nbgrader_glue.kept_editions import kept
from autograder.notebook.beside import Beside
from autograder.notebook.editions import Edition, of_release
from autograder.notebook.grade import CARRIED_ON, grade, is_judged
from autograder.notebook.recognise import grade_id
from autograder.notebook.repair import repair
from autograder.notebook.scores import with_verdicts
from autograder.notebook.suggestion import suggestion_of
from autograder.notebook.version import questions_of, stamp, version_of
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


class StampVersion(NbGraderPreprocessor):
    """For `generate_assignment`: writes into the notebook in which version it is handed out."""

    def preprocess(self, nb, resources):
        names, course = resources["nbgrader"], self.parent.parent.coursedir
        source = Path(course.format_path(course.source_directory, ".", names["assignment"]))
        files = handed_in.mechanisms_beside(source)
        stamp(nb, names["notebook"], version_of(nb, files), questions_of(nb, files))
        return nb, resources


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

    def earlier(self, names) -> list[Edition]:
        """The editions of the assignment that students may have."""
        root = Path(self.parent.parent.coursedir.root)
        return [of_release(text) for text in kept(root, names["assignment"])]

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
        documents = self.beside(names).documents
        nb, notes = repair(nb, source, notes, documents, self.earlier(names))
        _warn(self.log, names["student"], notes)
        return nb, resources


class Judge(FromSource):
    """For `autograde`, instead of nbgrader's Execute: writes verdicts as outputs of the grade cells."""

    seed_file = Unicode(
        "course/seed",
        help="The file with the secret that decides the random cases. It is made on first use; keep "
        "it to get the same verdicts again.",
    ).tag(config=True)
    carried_on = Float(
        CARRIED_ON,
        min=0.0,
        max=1.0,
        help="The share of its points that a wrong answer gets where it follows, as it should, from an "
        "earlier wrong answer of the student's own: 0 for none, 1 for all.",
    ).tag(config=True)

    def preprocess(self, nb, resources):
        names = resources["nbgrader"]
        secret = secret_of(Path(self.parent.parent.coursedir.root) / self.seed_file)
        seed = seed_of(secret, names["student"], names["assignment"])
        source, student = self.source_of(resources), names["student"]
        beside, earlier = self.beside(names), self.earlier(names)
        graded = grade(
            nb, source, seed, beside, student=student, earlier=earlier, carried_on=self.carried_on
        )
        _warn(self.log, names["student"], graded.notes)
        return with_verdicts(graded), resources


class SaveSuggestions(SaveAutoGrades):
    """For `autograde`, instead of nbgrader's SaveAutoGrades: saves what marked lines suggest, too. A
    person still has to read the answer, but not again what has not changed.
    """

    def preprocess(self, nb, resources):
        regrading = getattr(self.parent, "regrading", None)
        student = resources["nbgrader"]["student"]
        self._same = regrading.same_answers(student, nb) if regrading else set()
        return super().preprocess(nb, resources)

    def _add_score(self, cell, resources):
        grade = self.gradebook.find_grade(*_place(self, cell))
        to_read = grade.needs_manual_grade
        super()._add_score(cell, resources)
        if suggestion := suggestion_of(cell):
            grade.auto_score, grade.needs_manual_grade = suggestion.points, True
        if grade.manual_score is not None and grade_id(cell) in self._same:
            grade.needs_manual_grade = to_read
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
    the page no longer says which points its lines suggest, and says which rows of the rubric the answer
    met. Until then the answer says that it is unread.
    """

    def _get_score(self, cell, resources):
        super()._get_score(cell, resources)
        grade = self.gradebook.find_grade(*_place(self, cell))
        cell.metadata.nbgrader[UNREAD] = grade.needs_manual_grade
        if grade.manual_score is not None and not grade.needs_manual_grade:
            cell.metadata.nbgrader[ROWS] = self._rows(grade)

    def _rows(self, grade) -> list[dict]:
        """The rows of the rubric behind a person's points; none where they are not known."""
        kept = Kept(Path(self.parent.parent.coursedir.root))
        try:
            entry = kept.of(self.assignment_id, grade.name).get(self.student_id, {})
        except KeptError as error:
            self.log.warning("%s", error)
            return []
        given = counting(entry, grade.manual_score)
        return [asdict(row) for row in given.rows] if given else []

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
