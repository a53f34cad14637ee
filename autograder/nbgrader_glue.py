"""The only file that knows nbgrader: its preprocessors, its scores, its commands.

nbgrader reads a score from a grade cell's outputs: an error is zero, a result that is one number is
that many points, and almost anything else is full marks. So a verdict is written as the card and one
number, and where no verdict could be reached as an error.
"""

import glob
import json
import logging
import os
import re
import secrets
import shutil
import sys
import tempfile
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from types import SimpleNamespace

import jsonschema
import nbformat
from nbconvert.exporters import NotebookExporter
from nbformat import NotebookNode
from nbformat.v4 import new_output
from nbgrader import api, preprocessors, utils
from nbgrader.converters import Autograde, GenerateAssignment
from nbgrader.converters.base import BaseConverter
from nbgrader.coursedir import CourseDirectory
from nbgrader.nbgraderformat import common
from nbgrader.preprocessors import Execute, NbGraderPreprocessor
from sqlalchemy.orm import Session, scoped_session, sessionmaker
from traitlets import Unicode
from traitlets.config import Config, PyFileConfigLoader

from autograder import card
from autograder.grade import Graded, grade, is_judged
from autograder.repair import grade_id, repair
from autograder.verdict import State, Verdict


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


@lru_cache(maxsize=8)
def _read_source(path: Path, changed: int) -> NotebookNode:
    return nbformat.read(path, as_version=4)


class RepairCells(FromSource):
    """For `autograde`, first: graded cells as in the source, so that no copied cell stops a batch."""

    def preprocess(self, nb, resources):
        nb, notes = repair(nb, self.source_of(resources))
        for note in notes:
            self.log.warning("%s: %s", resources["nbgrader"]["student"], note)
        resources["notes"] = notes
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
        seed = self.seed_of(names["student"], names["assignment"])
        graded = grade(nb, self.source_of(resources), seed)
        for note in graded.notes:
            self.log.warning("%s: %s", names["student"], note)
        return with_verdicts(graded), resources

    def seed_of(self, student: str, assignment: str) -> str:
        return f"{self._seed()}\0{student}\0{assignment}"

    def _seed(self) -> str:
        path = Path(self.parent.parent.coursedir.root) / self.seed_file
        if not path.exists():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(secrets.token_hex(16) + "\n", encoding="utf-8")
            path.chmod(0o600)
        return path.read_text(encoding="utf-8").strip()


def with_verdicts(graded: Graded) -> NotebookNode:
    """The judged notebook, its grade cells' outputs as nbgrader reads them."""
    for cell in graded.notebook.cells:
        if is_judged(cell):
            points = cell.metadata["nbgrader"]["points"]
            cell.execution_count = 1
            cell.outputs = outputs_for(graded.verdicts[grade_id(cell)], points)
    return graded.notebook


def outputs_for(verdict: Verdict, points: float) -> list[NotebookNode]:
    """The outputs from which nbgrader reads the verdict's score and people read the verdict."""
    shown = new_output("display_data", data=card.mimebundle(verdict))
    if verdict.state is State.CHECK_FAILED:
        text = "this cell could not be judged and has no score yet"
        error = new_output("error", ename="CheckFailed", evalue=text, traceback=[text])
        return [shown, error]
    credit = min(max(0.0, float(verdict.credit)), 1.0)  # in this order NaN is 0 as well
    score = repr(credit * float(points))
    return [shown, new_output("execute_result", data={"text/plain": score}, execution_count=1)]


def autograde_preprocessors() -> list[type]:
    """nbgrader's own, with Judge in the place of the kernel run."""
    standard = Autograde.autograde_preprocessors.make_dynamic_default()
    return [Judge if step is Execute else step for step in standard]


def sanitize_preprocessors() -> list[type]:
    """nbgrader's own, with RepairCells first."""
    return [RepairCells, *Autograde.sanitize_preprocessors.make_dynamic_default()]


def generate_preprocessors() -> list[type]:
    """nbgrader's own, with ContinuePastChecks first."""
    return [ContinuePastChecks, *GenerateAssignment.preprocessors.make_dynamic_default()]


def write_problem(root: Path, assignment: str, to: Path) -> None:
    """The student version of an assignment in the folder `to`; no file that is there is touched.

    root: the course's folder. The gradebook is not touched either.
    """
    with tempfile.TemporaryDirectory(prefix="release-") as folder:
        _generate(root, assignment, folder)
        _copy_new(Path(folder) / assignment, to)


def _generate(root: Path, assignment: str, folder: str) -> None:
    config = _configuration(root)
    config.CourseDirectory.release_directory = folder
    config.CourseDirectory.assignment_id = assignment
    config.GenerateAssignment.no_database = True
    config.SaveCells.enabled = False
    coursedir = CourseDirectory(config=config)
    GenerateAssignment(coursedir=coursedir, config=config).start()


def _configuration(root: Path) -> Config:
    return PyFileConfigLoader("nbgrader_config.py", path=str(root)).load_config()


def _copy_new(folder: Path, to: Path) -> None:
    for path in folder.rglob("*"):
        target = to / path.relative_to(folder)
        if path.is_file() and not target.exists():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, target)


QUIET = logging.getLogger("autograder.nbgrader")
QUIET.setLevel(logging.CRITICAL)  # what its steps mend stands in the summary table
# nbgrader's steps that open the gradebook, each several times a notebook.
ASKING = ("OverwriteCells", "OverwriteKernelspec", "SaveAutoGrades", "AssignLatePenalties")


@dataclass(frozen=True)
class Standing:
    """A submission in the gradebook: its automatic rows as text, its points, cells not read yet."""

    rows: str
    score: float
    to_read: int


class Recorder:
    """One assignment's folders and gradebook: what `nbgrader autograde` does around the judging.

    nbgrader's own steps run here, on one gradebook that stays open, and a submission's scores are
    committed at once. Use as a context manager. ValueError where the assignment cannot be graded:
    not in the gradebook yet, or not one notebook of its own name.
    """

    def __init__(self, root: Path, assignment: str):
        config = _configuration(root)
        config.CourseDirectory.assignment_id = assignment
        self.assignment = assignment
        self._course = CourseDirectory(config=config, log=QUIET)
        self._converter = Autograde(coursedir=self._course, config=config, log=QUIET)
        self._sanitise = self._exporter(self._converter.sanitize_preprocessors)
        # The judging between the two is done elsewhere.
        steps = self._converter.autograde_preprocessors
        self._save = self._exporter([step for step in steps if step not in (Judge, Execute)])
        self._judge = Judge(parent=self._save)
        self._gradebook = api.Gradebook(self._course.db_url, self._course.course_id)
        self._gradebook.db = scoped_session(sessionmaker(self._gradebook.engine, class_=Held))
        try:
            self._read_cells()
        except BaseException:
            self._gradebook.close()
            raise
        source = Path(self._course.format_path(self._course.source_directory, ".", assignment))
        self.source = (source / f"{assignment}.ipynb").read_text(encoding="utf-8")
        self._beside_source = self._files(source)
        # What decides a submission's grade beside the submission, the source and the seed.
        self.settings = repr((config, self._cells, self._kernelspec))

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self._gradebook.close()

    def submissions(self) -> dict[str, Path]:
        """Student → where that student's notebook is, or should be; in order of the names."""
        excluded = self._course.student_id_exclude.split(",")
        pattern = self._course.format_path(
            self._course.submitted_directory, "(?P<student>[^/\\\\]*)", self.assignment, escape=True
        )
        found = {}
        for folder in glob.glob(self._folder("*")):
            match = re.fullmatch(pattern, folder)
            if match and match["student"] not in excluded:
                found[match["student"]] = Path(folder) / f"{self.assignment}.ipynb"
        return dict(sorted(found.items()))

    def seed_of(self, student: str) -> str:
        return self._judge.seed_of(student, self.assignment)

    def files_of(self, student: str) -> str:
        """What lies beside a submission and its source, as text that changes when a file does."""
        return repr((self._files(Path(self._folder(student))), self._beside_source))

    def prepare(self, student: str, text: str) -> tuple[str, list[str]]:
        """A submission as it goes to the judge, and what was mended in it.

        Raises what nbformat and nbgrader raise where it is no notebook.
        """
        with _lent(self._cells_only()), _without_warnings():
            notebook = nbformat.reads(text, as_version=nbformat.NO_CONVERT)
            notes = []
            if notebook.nbformat != 4:
                notes.append(f"the notebook was in format {notebook.nbformat}; it was converted")
                notebook = nbformat.convert(notebook, 4)
            text, resources = self._sanitise.from_notebook_node(notebook, self._resources(student))
        return text, notes + resources.get("notes", [])

    def record(self, student: str, graded: Graded) -> None:
        """Write a judged submission's rows, then its files."""
        submission = self._enter(student)
        notebook = next(n for n in submission.notebooks if n.notebook_id == self._notebook)
        grades = {self._names[grade.cell_id]: grade for grade in notebook.grades}
        comments = {self._names[comment.cell_id]: comment for comment in notebook.comments}
        rows = self._cells_only(
            find_submission=lambda *_: submission,
            find_submission_notebook=lambda *_: notebook,
            find_grade=lambda name, *_: grades[name],
            find_comment=lambda name, *_: comments[name],
        )
        with _lent(rows), _without_warnings():
            text, _ = self._save.from_notebook_node(with_verdicts(graded), self._resources(student))
        self._gradebook.db().end()
        self._write(student, text)

    def refuse(self, student: str) -> None:
        """Enter a submission that cannot be graded, and take an earlier one's notebook away.

        As with nbgrader, a folder without any notebook is no submission.
        """
        if glob.glob(os.path.join(glob.escape(self._folder(student)), "*.ipynb")):
            self._enter(student)
            self._gradebook.db().end()
        if os.path.exists(self.autograded(student).parent):
            utils.rmtree(str(self.autograded(student).parent))

    def forget(self) -> None:
        """After an error: what was not committed is dropped."""
        self._gradebook.db.rollback()
        self._gradebook.db.expunge_all()

    def autograded(self, student: str) -> Path:
        folder = self._course.format_path(
            self._course.autograded_directory, student, self.assignment
        )
        return Path(folder) / f"{self.assignment}.ipynb"

    def standings(self, student: str | None = None) -> dict[str, Standing]:
        """What the gradebook holds, by student."""
        query = self._gradebook.db.query
        notebook, mine = api.SubmittedNotebook, api.SubmittedNotebook.notebook_id == self._notebook
        if student is not None:
            mine = mine & (api.SubmittedAssignment.student_id == student)
        owner = api.SubmittedAssignment.id == notebook.assignment_id
        grades, comments = {}, {}
        for table, kept in ((api.Grade, grades), (api.Comment, comments)):
            rows = query(table).join(notebook, notebook.id == table.notebook_id)
            columns = [column for column in table.__table__.columns if column.name != "id"]
            rows = rows.join(api.SubmittedAssignment, owner).filter(mine)
            for row in rows.with_entities(*columns):
                kept.setdefault(row.notebook_id, []).append(row)
        found = {}
        whole = query(
            api.SubmittedAssignment.student_id,
            api.SubmittedAssignment.timestamp,
            api.SubmittedAssignment.extension,
            notebook.id,
            notebook.late_submission_penalty,
        ).join(notebook, owner)
        for name, timestamp, extension, id, penalty in whole.filter(mine):
            scores = {self._names[row.cell_id]: row for row in grades.get(id, [])}
            said = {self._names[row.cell_id]: row.auto_comment for row in comments.get(id, [])}
            automatic = sorted((cell, row.auto_score) for cell, row in scores.items())
            found[name] = Standing(
                repr((self._due, extension, timestamp, penalty, automatic, sorted(said.items()))),
                sum(map(_points, scores.values())) - (penalty or 0.0),
                sum(row.needs_manual_grade for row in scores.values()),
            )
        return found

    def _read_cells(self) -> None:
        """Copies of the gradebook's cells: its own are read anew after each commit."""
        command = f"run `nbgrader generate_assignment {self.assignment}` first"
        try:
            assignment = self._gradebook.find_assignment(self.assignment)
        except api.MissingEntry:
            raise ValueError(f"the gradebook does not know {self.assignment}: {command}") from None
        names = [notebook.name for notebook in assignment.notebooks]
        if names != [self.assignment]:
            raise ValueError(
                f"{self.assignment} must have one notebook, {self.assignment}.ipynb, and has "
                f"{', '.join(names) or 'none'}: use `nbgrader autograde`, or {command}"
            )
        notebook = assignment.notebooks[0]
        self._due, self._notebook = assignment.duedate, notebook.id
        self._kernelspec = notebook.kernelspec
        kept = ("name", "cell_type", "locked", "source", "checksum")
        self._cells = {
            cell.name: SimpleNamespace(**{key: getattr(cell, key) for key in kept})
            for cell in notebook.source_cells
        }
        graded = [*notebook.grade_cells, *notebook.task_cells]
        self._graded = {
            cell.name: SimpleNamespace(max_score=float(cell.max_score)) for cell in graded
        }
        self._names = {cell.id: cell.name for cell in [*graded, *notebook.solution_cells]}
        self.max_score = sum(cell.max_score for cell in self._graded.values())

    def _cells_only(self, **more) -> "Answers":
        """What a gradebook answers to nbgrader's steps; `more` for the submission at hand."""
        return Answers(
            db=SimpleNamespace(commit=lambda: None),
            find_notebook=lambda *_: SimpleNamespace(kernelspec=self._kernelspec),
            find_source_cell=lambda name, *_: _found(self._cells, name),
            find_graded_cell=lambda name, *_: _found(self._graded, name),
            **more,
        )

    def _enter(self, student: str):
        self._gradebook.update_or_create_student(student)
        timestamp = self._course.get_existing_timestamp(self._folder(student))
        given = {"timestamp": timestamp} if timestamp else {}
        with _without_warnings():
            return self._gradebook.update_or_create_submission(self.assignment, student, **given)

    def _write(self, student: str, text: str) -> None:
        """The notebook comes last and at once: where it is, the rest is there too."""
        path = self.autograded(student)
        if path.parent.exists():
            utils.rmtree(str(path.parent))
        path.parent.mkdir(mode=0o755, parents=True)
        BaseConverter.init_assignment(self._converter, self.assignment, student)
        source = self._course.format_path(self._course.source_directory, ".", self.assignment)
        kept = self._converter.exclude_overwriting.get(self.assignment, [])
        for name in self._beside_source:
            if name not in kept:
                target = path.parent / name
                target.parent.mkdir(parents=True, exist_ok=True)
                target.unlink(missing_ok=True)
                shutil.copy(os.path.join(source, name), target)
        path.with_suffix(".part").write_text(text, encoding="utf-8")
        path.with_suffix(".part").replace(path)
        self._converter.set_permissions(self.assignment, student)

    def _files(self, folder: Path) -> dict[str, tuple[int, int]]:
        """The files that are not notebooks, with their size and time."""
        found = utils.find_all_files(str(folder), [*self._course.ignore, "*.ipynb"])
        stats = {os.path.relpath(name, folder): os.stat(name) for name in sorted(found)}
        return {name: (stat.st_size, stat.st_mtime_ns) for name, stat in stats.items()}

    def _folder(self, student: str) -> str:
        return self._course.format_path(self._course.submitted_directory, student, self.assignment)

    def _resources(self, student: str) -> dict:
        path = os.path.join(self._folder(student), f"{self.assignment}.ipynb")
        return self._converter.init_single_notebook_resources(path)

    def _exporter(self, steps: list[type]) -> NotebookExporter:
        exporter = NotebookExporter(
            parent=self._converter, config=self._converter.config, optimistic_validation=True
        )
        for step in steps:
            exporter.register_preprocessor(step)
        return exporter


class Answers(SimpleNamespace):
    """Stands for a gradebook that a step opens and closes."""

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        pass


@contextmanager
def _lent(gradebook: Answers) -> Iterator[None]:
    """nbgrader's steps get this gradebook in the block, wherever they would open one."""
    steps = [sys.modules[getattr(preprocessors, name).__module__] for name in ASKING]
    try:
        for module in steps:
            module.Gradebook = lambda *_: gradebook
        # It reads the schema anew, and checks the schema itself, for each cell.
        common.jsonschema = SimpleNamespace(validate=_validate)
        yield
    finally:
        for module in steps:
            module.Gradebook = api.Gradebook
        common.jsonschema = jsonschema


def _validate(settings: dict, schema: dict) -> None:
    _validate_once(json.dumps(settings, sort_keys=True), json.dumps(schema))


@lru_cache
def _validate_once(settings: str, schema: str) -> None:
    jsonschema.validate(json.loads(settings), json.loads(schema))


class Held(Session):
    """A session that leaves it to `end` to commit, so that a student's rows are there or are not."""

    def commit(self):
        self.flush()

    def end(self):
        super().commit()
        self.expunge_all()


@contextmanager
def _without_warnings() -> Iterator[None]:
    """nbgrader's and nbformat's are not the instructor's business."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


def _found(cells: dict, name: str) -> SimpleNamespace:
    if name not in cells:
        raise api.MissingEntry(name)
    return cells[name]


def _points(grade) -> float:
    """A grade row's points, as nbgrader adds them up."""
    given = grade.auto_score if grade.manual_score is None else grade.manual_score
    return 0.0 if given is None else given + (grade.extra_credit or 0.0)
