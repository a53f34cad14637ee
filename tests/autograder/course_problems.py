"""The course's problems as the tests see them: released and graded once, when first asked for."""

import copy
import importlib
from functools import cache, cached_property
from pathlib import Path

import nbformat
from nbformat import NotebookNode

from autograder.judging.verdict import State
from autograder.nbgrader_glue import write_problem
from autograder.notebook.grade import Graded, grade
from autograder.notebook.recognise import grade_id
from tests.once import made_once
from tests.submissions import answers
from tests.submissions.dressed import dressed

ROOT = Path(__file__).parents[2]
NAMES = sorted(path.stem for path in (ROOT / "solutions").glob("*/*.ipynb"))
# Cells of p3 that take their time to draw, and are not what is graded.
SHOWN_OFF = ("p3-euler-lagrange", "p3-swing-plot")


class Problem:
    """One problem: its source notebook, its release, and what its submissions get.

    The notebooks are shared by all tests: a test that changes one takes a copy.
    """

    def __init__(self, name: str):
        self.name = name
        self.folder = ROOT / "solutions" / name
        self._graded: dict[str, Graded] = {}

    @cached_property
    def submissions(self):
        """The module in tests/submissions that makes submissions to it."""
        return importlib.import_module(f"tests.submissions.{self.name.replace('-', '_')}")

    @cached_property
    def source(self) -> NotebookNode:
        return nbformat.read(self.folder / f"{self.name}.ipynb", as_version=4)

    @cached_property
    def release_folder(self) -> Path:
        return made_once(self.name, lambda folder: write_problem(ROOT, self.name, folder))

    @cached_property
    def release(self) -> NotebookNode:
        return nbformat.read(self.release_folder / f"{self.name}.ipynb", as_version=4)

    def graded(self, kind: str) -> Graded:
        """What "source", "blank", "dressed" or one of the module's submissions gets."""
        if kind not in self._graded:
            if kind == "source":
                submission = self.source
            elif kind == "blank":
                submission = answers.blank(self.release)
            elif kind == "dressed":
                submission = dressed(self.submissions.right(self.release))
            else:
                submission = getattr(self.submissions, kind)(self.release)
            self._graded[kind] = grade(submission, self.source, "seed")
        return self._graded[kind]

    def states(self, kind: str) -> set[State]:
        return set(states(self.graded(kind)).values())

    def namespace(self) -> dict:
        """What the solution's cells define, the checks apart."""
        namespace = {"__name__": "__main__"}
        for cell in self.source.cells:
            if cell.cell_type == "code" and not cell.source.startswith("# Checks"):
                exec(cell.source, namespace)
        return namespace


problem = cache(Problem)


def states(graded: Graded) -> dict[str, State]:
    return {name: verdict.state for name, verdict in graded.verdicts.items()}


def without_plots(notebook: NotebookNode) -> NotebookNode:
    """A copy of a notebook of p3 that runs fast."""
    notebook = copy.deepcopy(notebook)
    notebook.cells = [cell for cell in notebook.cells if grade_id(cell) not in SHOWN_OFF]
    return notebook
