"""One notebook graded: in a warm room, in a cold one, and by stock nbgrader's Execute.

    python tests/benchmarks/grading.py [FILE]

Prints the table, and writes it to FILE if one is given. Each figure is the least wall-clock time of
a notebook, taken in turn: what is timed waits for processes of its own. The start of the warm
process, once a run, is a line below the table. Nothing is recorded: no gradebook on either side.
"""

import copy
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import contextmanager
from pathlib import Path
from unittest import mock

import nbformat
import numpy as np
from nbgrader.preprocessors import Execute
from timing import Row, table

from autograder import sandbox
from autograder.grade import grade
from autograder.sandbox import Room, Way
from autograder.verdict import State
from autograder.wall import Call

ROOT = Path(__file__).parents[2]
NOTEBOOK = ROOT / "solutions" / "p3-pendulum" / "p3-pendulum.ipynb"
SEED = "benchmark"
CELLS = (
    "import numpy as np\nimport sympy as sp",
    "import matplotlib.pyplot as plt",
    "def f(q):\n    return np.sin(q)",
)


@contextmanager
def rooms(way: Way):
    with mock.patch.object(sandbox, "_best_way", return_value=way):
        yield


def grade_in(way: Way, notebook) -> None:
    with rooms(way):
        graded = grade(copy.deepcopy(notebook), notebook, SEED)
    wrong = [
        name for name, verdict in graded.verdicts.items() if verdict.state is not State.CORRECT
    ]
    if wrong:
        raise ValueError(f"the solution must be right in a {way.name} room: {wrong}")


def execute(notebook) -> None:
    """The kernel's part of a stock `nbgrader autograde`: student's cells and checks in one kernel."""
    executed = copy.deepcopy(notebook)
    with tempfile.TemporaryDirectory() as folder:
        Execute().preprocess(executed, {"metadata": {"path": folder}})
    errors = [
        output.evalue
        for cell in executed.cells
        for output in cell.get("outputs", [])
        if output.output_type == "error"
    ]
    if errors:
        raise ValueError(f"the solution must be right in a kernel: {errors}")


def three_cells_and_calls(way: Way) -> None:
    with Room(way) as room:
        for source in CELLS:
            room.run(source)
        replies = room.ask([Call("f", (0.01 * k,)) for k in range(200)])
    np.testing.assert_allclose(
        [float(reply.value) for reply in replies], np.sin(0.01 * np.arange(200))
    )


def elapsed(call: Callable) -> float:
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def least(calls: dict[str, Callable], rounds: dict[str, int]) -> dict[str, float]:
    """The least time of each call, s, taken in turn for as many rounds as it has."""
    best = dict.fromkeys(calls, float("inf"))
    for k in range(max(rounds.values())):
        for name, call in calls.items():
            if k < rounds[name]:
                best[name] = min(best[name], elapsed(call))
    return best


def main(arguments: list[str]) -> None:
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    start = elapsed(lambda: Room(Way.WARM).close())
    times = least(
        {
            "warm": lambda: grade_in(Way.WARM, notebook),
            "cold": lambda: grade_in(Way.COLD, notebook),
            "stock": lambda: execute(notebook),
            "warm room": lambda: three_cells_and_calls(Way.WARM),
            "cold room": lambda: three_cells_and_calls(Way.COLD),
        },
        {"warm": 20, "cold": 5, "stock": 5, "warm room": 20, "cold room": 5},
    )
    what = f"{NOTEBOOK.stem}, the solution"
    rows = [
        Row(f"{what}: grade, warm room", times["warm"], "cold room", times["cold"], 1 / 5),
        Row(f"{what}: grade, warm room", times["warm"], "nbgrader Execute", times["stock"], 1 / 20),
        Row(
            "a room: start, three cells, 200 calls, end; warm",
            times["warm room"],
            "cold",
            times["cold room"],
            1 / 20,
        ),
    ]
    text = table(rows) + f"\nStart of the warm process, once a run: {start:.2g} s.\n"
    print(text)
    if arguments:
        Path(arguments[0]).write_text(text)


if __name__ == "__main__":
    main(sys.argv[1:])
