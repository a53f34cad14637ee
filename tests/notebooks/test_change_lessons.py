"""The tool that makes small mistakes in a lesson finds what no assert holds."""

import subprocess
import sys
from pathlib import Path

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_notebook

from tests.notebooks.change_lessons import survivors

TOOL = Path(__file__).with_name("change_lessons.py")


def lesson(folder, *cells):
    notebook = new_notebook(cells=[new_code_cell(c, id=f"c{i}") for i, c in enumerate(cells)])
    nbformat.write(notebook, folder / "lesson.ipynb")
    return folder / "lesson.ipynb"


def run(folder, *cells, only=()):
    path = lesson(folder, *cells)
    command = [sys.executable, str(TOOL), *(f"--only={kind}" for kind in only), path.name]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


@pytest.fixture
def listed(tmp_path, monkeypatch):
    """What survives in a lesson of these cells, in this process: a new one for each takes a second."""
    monkeypatch.chdir(tmp_path)

    def go(*cells, only):
        found = survivors(lesson(tmp_path, *cells), only)
        return [f"{cell}, line {line}, {kind}: {words}" for cell, line, kind, words in found]

    return go


def test_signs(listed):
    assert listed(
        "from math import cos, pi, sin\nx = 2 - 1\nassert x == 1",
        "x = 2 - 1\nassert x > 0",
        "y = -3",  # the cell after the next holds it
        "z = -4\nassert z**2 == 16",
        "assert y < 0\ny += 3\nassert y == 0",
        "\n\nassert cos(2 * pi) == 1",
        "abs(cos(0.5))",
        "[1, 2][-1]",
        only=("sign",),
    ) == ["c1, line 1, sign: 2 - 1", "c3, line 1, sign: -4", "c6, line 1, sign: cos"]


def test_numbers(listed):
    assert listed(
        "half = 0.5\nassert half == 0.5\nloose = 3\nassert loose > 1",  # 1 is a bound
        "class ax:\n    plot = print\nax.plot(7, 0.1)",
        "assert abs(half - 0.5) < 1e-9\nno = True\nzero = 0\ntenth = [5, 6][1]",
        only=("number",),
    ) == ["c0, line 3, number: 3", "c2, line 4, number: 5", "c2, line 4, number: 6"]


def test_bounds(listed):
    assert listed(
        "kept = [k for k in range(4) if k < 2]\nassert kept == [0, 1]\nassert 2 < 3",
        "small = [k for k in range(4) if k <= 2.5]",
        only=("bound",),
    ) == ["c1, line 1, bound: k <= 2.5"]


def test_indices(listed):
    assert listed(
        "M = {(0, 1): 7, (1, 0): 7, (0, 2): 8, (2, 0): 9}\nq = [4, 5]",
        "assert M[0, 1] == 7\nassert M[0, 2] == 8\nassert q[0] == 4",
        "seen = q[1]",
        only=("index",),
    ) == ["c1, line 1, index: M[0, 1]", "c2, line 1, index: q[1]"]


def test_statements(listed):
    assert listed(
        "total = 0\nfor k in range(3):\n    total += k\nassert total == 3",
        "total = 3\nprint(total)\ntotal\nfor k in range(3):\n    assert k < total",
        "def twice(x):\n    '''2 x'''\n    x = 2 * x\n    return x\n\n\nassert twice(2)",
        "try:\n    1 / 0\nexcept ZeroDivisionError:\n    pass\nelse:\n    raise AssertionError",
        only=("statement",),
    ) == ["c1, line 1, statement: total = 3", "c2, line 3, statement: x = 2 * x"]


def test_all_kinds_by_default(tmp_path):
    done = run(tmp_path, "x = [2 - 1, 9][0]")
    assert done.returncode == 0, done.stderr
    kinds = {line.split(", ")[2].partition(":")[0] for line in done.stdout.splitlines()}
    assert kinds == {"sign", "number", "index", "statement"}


def test_a_notebook_that_fails_by_itself_is_no_result(tmp_path):
    done = run(tmp_path, "assert 1 + 1 == 3", only=["sign"])
    assert done.returncode != 0
    assert "AssertionError" in done.stderr
