"""Honest variants lose nothing, and see what their code showed."""

import nbformat
import pytest

from autograder.grade import grade
from autograder.nbgrader_glue import write_problem
from autograder.repair import grade_id, repair
from autograder.verdict import State
from tests.submissions.answers import cell_of
from tests.submissions.attack import ROOT
from tests.submissions.honest import VARIANTS
from tests.submissions.honest_styles import FILES
from tests.submissions.p3_pendulum import POINTS

P3 = "p3-pendulum"
SOURCE = nbformat.read(ROOT / "solutions" / P3 / f"{P3}.ipynb", as_version=4)
# What takes its time to draw; one variant keeps it.
SHOWN_OFF = ("p3-euler-lagrange", "p3-swing-plot")


def without_plots(notebook):
    notebook.cells = [cell for cell in notebook.cells if grade_id(cell) not in SHOWN_OFF]
    return notebook


@pytest.fixture(scope="module")
def release(tmp_path_factory):
    folder = tmp_path_factory.mktemp("release")
    write_problem(ROOT, P3, folder)
    return nbformat.read(folder / f"{P3}.ipynb", as_version=4)


def states(graded):
    return {name: verdict.state for name, verdict in graded.verdicts.items()}


ALL = dict.fromkeys(POINTS, State.CORRECT)


@pytest.mark.parametrize("edit", VARIANTS.values(), ids=VARIANTS)
def test_honest_variants_lose_nothing(edit, release):
    submission = without_plots(edit(release))
    graded = grade(submission, without_plots(nbformat.from_dict(SOURCE)), "seed")
    assert states(graded) == ALL, "\n".join(map(str, graded.verdicts.values()))
    nbformat.validate(graded.notebook)


def test_a_student_sees_prints_plots_and_errors(release):
    graded = grade(VARIANTS["plots"](release), SOURCE, "seed")
    assert states(graded) == ALL
    at = graded.notebook.cells.index(cell_of(graded.notebook, "answer-g_vec"))
    pictures = [
        sum("image/png" in output.get("data", {}) for output in cell.outputs)
        for cell in graded.notebook.cells[at + 1 : at + 3]
    ]
    assert pictures == [2, 1]
    assert "u =" in cell_of(graded.notebook, "p3-euler-lagrange").outputs[0].text
    assert "image/png" in cell_of(graded.notebook, "p3-swing-plot").outputs[0].data
    assert graded.notes == ()


@pytest.mark.parametrize("make", FILES.values(), ids=FILES)
def test_honest_files_lose_nothing(make, release):
    submission = nbformat.reads(make(without_plots(nbformat.from_dict(release))).decode(), 4)
    graded = grade(submission, without_plots(nbformat.from_dict(SOURCE)), "seed")
    assert states(graded) == ALL
    assert graded.notes == ()


def test_honest_variants_are_no_matter_for_the_instructor(release):
    """Only copied cells are mended; nothing else is reported of the honest."""
    told = {}
    for name, edit in VARIANTS.items():
        _, notes = repair(edit(release), SOURCE)
        told |= {name: notes} if notes else {}
    assert told.keys() == {"copied_cells"}
