"""The only file that knows nbgrader: its preprocessors, its scores, its commands.

nbgrader reads a score from a grade cell's outputs: an error is zero, a result that is one number is
that many points, and almost anything else is full marks. So a verdict is written as the card and one
number, and where no verdict could be reached as an error.
"""

import secrets
import shutil
import tempfile
from pathlib import Path

import nbformat
from nbformat import NotebookNode
from nbformat.v4 import new_output
from nbgrader.converters import Autograde, GenerateAssignment
from nbgrader.coursedir import CourseDirectory
from nbgrader.preprocessors import Execute, NbGraderPreprocessor
from traitlets import Unicode
from traitlets.config import PyFileConfigLoader

from autograder import card
from autograder.grade import grade, is_judged
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
        return nbformat.read(Path(folder) / f"{names['notebook']}.ipynb", as_version=4)


class RepairCells(FromSource):
    """For `autograde`, first: graded cells as in the source, so that no copied cell stops a batch."""

    def preprocess(self, nb, resources):
        nb, notes = repair(nb, self.source_of(resources))
        for note in notes:
            self.log.warning("%s: %s", resources["nbgrader"]["student"], note)
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
        seed = f"{self._seed()}\0{names['student']}\0{names['assignment']}"
        graded = grade(nb, self.source_of(resources), seed)
        for note in graded.notes:
            self.log.warning("%s: %s", names["student"], note)
        for cell in graded.notebook.cells:
            if is_judged(cell):
                verdict = graded.verdicts[grade_id(cell)]
                points = cell.metadata["nbgrader"]["points"]
                cell.execution_count = 1
                cell.outputs = outputs_for(verdict, points)
        return graded.notebook, resources

    def _seed(self) -> str:
        path = Path(self.parent.parent.coursedir.root) / self.seed_file
        if not path.exists():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(secrets.token_hex(16) + "\n", encoding="utf-8")
            path.chmod(0o600)
        return path.read_text(encoding="utf-8").strip()


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
    config = PyFileConfigLoader("nbgrader_config.py", path=str(root)).load_config()
    config.CourseDirectory.release_directory = folder
    config.CourseDirectory.assignment_id = assignment
    config.GenerateAssignment.no_database = True
    config.SaveCells.enabled = False
    coursedir = CourseDirectory(config=config)
    GenerateAssignment(coursedir=coursedir, config=config).start()


def _copy_new(folder: Path, to: Path) -> None:
    for path in folder.rglob("*"):
        target = to / path.relative_to(folder)
        if path.is_file() and not target.exists():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, target)
