"""The lists of steps are nbgrader's own, but for ours; and naming them loads nothing."""

import subprocess
import sys

import pytest
from nbgrader.converters import Autograde, GenerateAssignment, GenerateFeedback
from nbgrader.preprocessors import SaveAutoGrades, SaveCells
from traitlets import import_item

from autograder.nbgrader_glue import (
    autograde_preprocessors,
    feedback_preprocessors,
    generate_preprocessors,
    sanitize_preprocessors,
)
from autograder.nbgrader_glue.new_cells import SaveChangedCells
from autograder.nbgrader_glue.preprocessors import (
    ContinuePastErrors,
    GetDecidedGrades,
    Judge,
    RepairCells,
    SaveSuggestions,
    StampVersion,
)

INSTEAD = {SaveAutoGrades: SaveSuggestions, SaveCells: SaveChangedCells}


@pytest.mark.parametrize(
    ("ours", "theirs", "first", "left_out"),
    [
        (sanitize_preprocessors, Autograde.sanitize_preprocessors, [RepairCells], 0),
        (autograde_preprocessors, Autograde.autograde_preprocessors, [Judge], 1),
        (
            generate_preprocessors,
            GenerateAssignment.preprocessors,
            [StampVersion, ContinuePastErrors],
            0,
        ),
        (feedback_preprocessors, GenerateFeedback.preprocessors, [GetDecidedGrades], 1),
    ],
)
def test_steps_are_nbgraders_but_for_ours(ours, theirs, first, left_out):
    assert [import_item(name) for name in ours()] == [
        *first,
        *(INSTEAD.get(step, step) for step in theirs.make_dynamic_default()[left_out:]),
    ]


def test_naming_them_does_not_import_nbgrader():
    code = "import sys; from autograder import nbgrader_glue, pipeline\n"
    code += "print([m for m in ('nbgrader', 'nbconvert', 'scipy', 'sympy', 'IPython', "
    code += "'matplotlib', 'rfc3987_syntax') if m in sys.modules])"
    printed = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert printed.stdout == "[]\n", printed.stderr
