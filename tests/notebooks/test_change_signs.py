"""The tool that changes signs finds what no assert holds."""

import subprocess
import sys
from pathlib import Path

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_notebook

TOOL = Path(__file__).with_name("change_signs.py")


@pytest.mark.parametrize(
    ("cells", "unnoticed"),
    [
        (["x = 2 - 1", "assert x == 1"], []),
        (["x = 2 - 1", "assert x > 0"], ["c0, line 1: 2 - 1"]),
        (["x = -3", "assert x < 0"], []),
        (["x = -3", "assert x**2 == 9"], ["c0, line 1: -3"]),
        (["from math import cos, pi", "\n\nassert cos(2 * pi) == 1"], []),
        (["from math import cos, sin", "y = abs(cos(0.5))"], ["c1, line 1: cos"]),
        (["y = [1, 2][-1]"], []),
    ],
)
def test_what_is_listed(tmp_path, cells, unnoticed):
    notebook = new_notebook(cells=[new_code_cell(c, id=f"c{i}") for i, c in enumerate(cells)])
    nbformat.write(notebook, tmp_path / "lesson.ipynb")
    done = subprocess.run(
        [sys.executable, str(TOOL), "lesson.ipynb"],
        cwd=tmp_path, capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert done.stdout.splitlines() == [f"lesson: {line}" for line in unnoticed]


def test_a_notebook_that_fails_by_itself_is_no_result(tmp_path):
    notebook = new_notebook(cells=[new_code_cell("assert 1 + 1 == 3", id="c0")])
    nbformat.write(notebook, tmp_path / "lesson.ipynb")
    command = [sys.executable, str(TOOL), "lesson.ipynb"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode != 0
    assert "AssertionError" in done.stderr
