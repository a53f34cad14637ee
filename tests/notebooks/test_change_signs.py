"""The tool that changes signs finds what no assert holds."""

import subprocess
import sys
from pathlib import Path

import nbformat
from nbformat.v4 import new_code_cell, new_notebook

TOOL = Path(__file__).with_name("change_signs.py")


def run(folder, *cells):
    notebook = new_notebook(cells=[new_code_cell(c, id=f"c{i}") for i, c in enumerate(cells)])
    nbformat.write(notebook, folder / "lesson.ipynb")
    command = [sys.executable, str(TOOL), "lesson.ipynb"]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def test_what_is_listed(tmp_path):
    done = run(
        tmp_path,
        "from math import cos, pi, sin\nx = 2 - 1\nassert x == 1",
        "x = 2 - 1\nassert x > 0",
        "y = -3",  # the cell after the next holds it
        "z = -4\nassert z**2 == 16",
        "assert y < 0\ny += 3\nassert y == 0",
        "\n\nassert cos(2 * pi) == 1",
        "abs(cos(0.5))",
        "[1, 2][-1]",
    )
    assert done.stdout.splitlines() == [
        "lesson: c1, line 1: 2 - 1",
        "lesson: c3, line 1: -4",
        "lesson: c6, line 1: cos",
    ]
    assert done.returncode == 0


def test_a_notebook_that_fails_by_itself_is_no_result(tmp_path):
    done = run(tmp_path, "assert 1 + 1 == 3")
    assert done.returncode != 0
    assert "AssertionError" in done.stderr
