"""Honest variants lose nothing, and see what their code showed."""

import nbformat
import pytest

from autograder.judging.verdict import State
from autograder.notebook.grade import grade
from autograder.notebook.repair import repair
from tests.autograder.course_problems import problem, states, without_plots
from tests.submissions.answers import cell_of
from tests.submissions.honest import VARIANTS
from tests.submissions.honest_styles import FILES
from tests.submissions.p3_pendulum import POINTS

P3 = "p3-pendulum"
SOURCE = problem(P3).source


@pytest.fixture(scope="module")
def release():
    return problem(P3).release


ALL = dict.fromkeys(POINTS, State.CORRECT)


@pytest.mark.parametrize("edit", VARIANTS.values(), ids=VARIANTS)
def test_honest_variants_lose_nothing(edit, release):
    submission = without_plots(edit(release))
    graded = grade(submission, without_plots(SOURCE), "seed")
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
    submission = nbformat.reads(make(without_plots(release)).decode(), 4)
    graded = grade(submission, without_plots(SOURCE), "seed")
    assert states(graded) == ALL
    assert graded.notes == ()


def test_honest_variants_are_no_matter_for_the_instructor(release):
    """Only copied cells are mended; nothing else is reported of the honest."""
    told = {}
    for name, edit in VARIANTS.items():
        _, notes = repair(edit(release), SOURCE)
        told |= {name: notes} if notes else {}
    assert told.keys() == {"copied_cells"}
