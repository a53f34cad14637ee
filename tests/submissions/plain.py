"""An assignment such as a lecturer brings along: nbgrader's own kinds of cells, and no check of ours."""

from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from tests.submissions.answers import answered

NAME = "week3"
# By grade_id: those that are graded by their code, then those that a person reads.
POINTS = {"test-double": 2.0, "test-mean": 3.0}
READ = {"answer-draw": 4.0, "answer-why": 2.0, "task": 1.0}

DOUBLE = """
def double(x):
    ### BEGIN SOLUTION
    return 2 * x
    ### END SOLUTION
"""
TEST_OF_DOUBLE = """
# Small numbers.
assert double(2) == 4, "double(2) is 4"
### BEGIN HIDDEN TESTS
for x in range(-5, 5):
    assert double(x) == 2 * x, "the sign"
print("all of them")
### END HIDDEN TESTS
"""
MEAN = """
def mean(values):
    ### BEGIN SOLUTION
    return sum(values) / len(values)
    ### END SOLUTION
"""
# A point for each: of two numbers, of one, of an array.
TEST_OF_MEAN = """
cases = [([1, 2], 1.5), ([7], 7), (np.arange(5), 2)]
np.sum([abs(mean(values) - m) < 1e-9 for values, m in cases])
"""
RIGHT = {
    "double": "def double(x):\n    return x + x",
    "mean": "def mean(values):\n    return np.mean(values)",
    "draw": "print('a drawing')",
    "why": "Because it is so.",
}
WRONG = {
    "double": "def double(x):\n    return abs(2 * x)",
    "mean": "def mean(values):\n    return values[0] + 0.5",
}


def source() -> NotebookNode:
    """The source version."""
    return new_notebook(
        cells=[
            new_markdown_cell("# Week 3", id="title"),
            _cell("set-up", "import numpy as np", locked=True),
            _cell("answer-double", DOUBLE, solution=True),
            _cell("test-double", TEST_OF_DOUBLE, points=2, grade=True, locked=True),
            _cell("answer-mean", MEAN, solution=True),
            _cell("test-mean", TEST_OF_MEAN, points=3, grade=True, locked=True),
            _cell("answer-draw", "print('drawn')", points=4, grade=True, solution=True),
            _cell("answer-why", "It is so.", "markdown", points=2, grade=True, solution=True),
            _cell("task", "Add what you like.", "markdown", points=1, task=True, locked=True),
        ],
        metadata={"kernelspec": {"name": "python3", "display_name": "Python 3"}},
    )


def right(release: NotebookNode) -> NotebookNode:
    return answered(release, **RIGHT)


def wrong(release: NotebookNode) -> NotebookNode:
    """The hidden test fails for negative numbers; one of three means is right."""
    return answered(release, **(RIGHT | WRONG))


def _cell(grade_id: str, text: str, kind: str = "code", **claims) -> NotebookNode:
    cell = {"code": new_code_cell, "markdown": new_markdown_cell}[kind](text.strip(), id=grade_id)
    given = {"grade": False, "solution": False, "locked": False, "task": False, **claims}
    cell.metadata.nbgrader = NotebookNode(grade_id=grade_id, schema_version=3, **given)
    return cell
