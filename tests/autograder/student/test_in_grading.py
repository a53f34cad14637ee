"""A check, and Validate, say what works in the kernel and will not in the grader; and nothing else."""

import copy
import re
import shutil

import nbformat
import pytest
from nbformat.v4 import new_code_cell

from autograder.notebook import budget
from autograder.sandbox import room
from autograder.student import in_grading
from autograder.student.in_grading import Told, of_file
from tests.autograder import courses
from tests.autograder.course_problems import problem, without_plots
from tests.submissions import p3_pendulum
from tests.submissions.answers import cell_of

P3 = "p3-pendulum"


def test_the_limits_are_the_graders():
    assert in_grading.CELL_SECONDS == room.CELL_SECONDS
    assert {in_grading.CELLS_SECONDS} == {budget.GIVEN_SECONDS, budget.OWN_SECONDS}


class Shell:
    """What `Cells` needs of an IPython."""

    def __init__(self, *sources):
        self.user_ns = {"In": ["", *sources]}
        self.events = self
        self.transform_cell = str

    def register(self, event, function):
        pass


def told(*sources: str) -> list[Told]:
    return in_grading.Cells(Shell(*sources)).told()


@pytest.mark.parametrize(
    "source",
    ["import armdyn", "from armdyn.models import Pendulum", "def M():\n    import armdyn as a"],
)
def test_armdyn_is_told(source):
    (one,) = told("import numpy", source)
    assert one.costs
    assert one.said.startswith("A cell of this notebook imports armdyn. The grader has none")


@pytest.mark.parametrize(
    "source",
    [
        "import numpy, sympy, json, math, autograder",
        "# import armdyn",
        "print('import armdyn')",
        "import armdyn_of_mine",
        "import no_such_module",
        "from . import armdyn",
        "import (",
    ],
)
def test_nothing_is_said_of_what_the_grader_has(source):
    assert told(source) == []


def test_a_module_beside_the_notebook_is_told_and_one_elsewhere_costs(tmp_path, monkeypatch):
    here, elsewhere = tmp_path / "here", tmp_path / "elsewhere"
    for folder, name in ((here, "beside_it"), (elsewhere, "far_off")):
        folder.mkdir()
        (folder / f"{name}.py").write_text("x = 1")
        monkeypatch.syspath_prepend(folder)
        __import__(name)
    monkeypatch.chdir(here)
    one, other = told("import beside_it, far_off")
    assert one == Told(
        "This notebook needs beside_it.py beside it. nbgrader's Submit hands it in, too; where you "
        "upload the notebook yourself, upload beside_it.py as well.",
        costs=False,
    )
    assert other.costs
    assert other.said.startswith(
        f"This notebook imports far_off from {elsewhere}, where the grader"
    )


@pytest.mark.parametrize(
    ("seconds", "said", "costs"),
    [
        ([9.0, 9.0], None, False),
        ([1.0, 12.4], "took 12 s of processor time; the grader stops a cell after 10 s.", True),
        ([9.5] * 7, "gives 60 s to the problem's cells, and 60 s to your own.", False),
        ([9.5] * 13, "gives 60 s to the problem's cells, and 60 s to your own.", True),
    ],
)
def test_times_are_told(seconds, said, costs):
    cells = in_grading.Cells(Shell())
    cells._seconds = dict(enumerate(seconds))
    found = cells.told()
    assert [one.said.endswith(said or "") for one in found] == ([True] if said else [])
    assert [one.costs for one in found] == ([costs] if said else [])


def write(folder, notebook, name=f"{P3}.ipynb"):
    nbformat.write(notebook, folder / name)


def test_lost_settings_are_told(tmp_path):
    release = problem(P3).release
    write(tmp_path, release)
    assert of_file("p3-M", tmp_path) == []
    lost = copy.deepcopy(release)
    for name in ("p3-M", "p3-C"):
        del cell_of(lost, name).metadata["nbgrader"]
    write(tmp_path, lost)
    # A notebook to try things in, which calls a check of its own.
    write(tmp_path, nbformat.v4.new_notebook(cells=[new_code_cell('check("p3-M")')]), "a.ipynb")
    (one,) = of_file("p3-g_vec", tmp_path)
    assert one.said.startswith(
        f"In {P3}.ipynb, the cells of p3-M, p3-C have lost nbgrader's settings"
    )
    assert of_file("p4-g_vec", tmp_path) == []


def test_a_lesson_is_not_graded(tmp_path, monkeypatch):
    shutil.copy(courses.ROOT / "lessons" / "00-start-here.ipynb", tmp_path)
    monkeypatch.chdir(tmp_path)
    assert in_grading.told("start-kinetic-energy", None) == []


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "import armdyn",
            "p3-M: correct, but not when it is graded. A cell of this notebook imports",
        ),
        ("lost", "In p3-pendulum.ipynb, the cell of p3-C has lost nbgrader's settings"),
    ],
)
def test_validate_fails_where_points_would_be_lost(tmp_path, text, said):
    shutil.copy(courses.ROOT / "nbgrader_config.py", tmp_path)
    notebook = without_plots(p3_pendulum.right(problem(P3).release))
    if text == "lost":
        del cell_of(notebook, "p3-C").metadata["nbgrader"]
    else:
        notebook.cells.insert(1, new_code_cell(text))
    write(tmp_path, notebook)
    printed = courses.run(tmp_path, "nbgrader", "validate", f"{P3}.ipynb")
    assert said in re.sub(r"\s+", " ", printed)
