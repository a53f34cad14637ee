"""What counts as a difference between solutions/ and the gradebook or a release."""

import copy

import nbformat
import pytest
from nbformat.v4 import new_markdown_cell
from nbgrader import utils

from autograder.nbgrader_glue import agreement
from autograder.nbgrader_glue.agreement import DisagreementError, Known
from autograder.notebook.recognise import known_cells
from autograder.notebook.released import released
from tests.autograder.course_problems import problem
from tests.submissions.answers import cell_of

SOURCE = problem("p3-pendulum").source


def known(source):
    """The gradebook's cells, as nbgrader makes them of a source."""
    found = {}
    for name, cell in known_cells(source).items():
        graded = utils.is_grade(cell) or utils.is_task(cell)
        points = float(cell.metadata["nbgrader"]["points"]) if graded else None
        found[name] = Known(
            cell.cell_type,
            utils.is_locked(cell),
            cell.source,
            utils.compute_checksum(cell),
            points,
            bool(utils.is_solution(cell)),
        )
    return found


def test_a_cell_that_nbgrader_does_not_keep_is_no_difference():
    source = copy.deepcopy(SOURCE)
    note = new_markdown_cell("A note.")
    note.metadata["nbgrader"] = {
        **{"schema_version": 3, "grade_id": "p3-note", "grade": False},
        **{"locked": False, "solution": False, "task": False},
    }
    source.cells.append(note)
    assert agreement.from_gradebook(source, known(SOURCE)) == []


def test_another_kind_of_cell_is_one():
    source = copy.deepcopy(SOURCE)
    cell_of(source, "answer-M").metadata["nbgrader"].update(solution=False, locked=True)
    assert agreement.from_gradebook(source, known(SOURCE)) == [
        "answer-M is no answer, unlike in the gradebook"
    ]


def test_a_long_list_is_cut():
    cells = {name: one for name, one in known(SOURCE).items() if one.points is None}
    with pytest.raises(DisagreementError, match="gradebook; and 2 more"):
        agreement.require(SOURCE, cells, "p3-pendulum")


def test_a_release_with_an_older_text_is_said():
    then = copy.deepcopy(SOURCE)
    for cell in then.cells:
        cell.source = released(cell)
    assert agreement.from_release(SOURCE, nbformat.writes(then)) == []
    cell_of(then, "p3-setup").source += "\nimport math"
    assert agreement.from_release(SOURCE, nbformat.writes(then)) == ["p3-setup has another text"]
