"""The smallest assignment, and submissions to it: three code cells, one graded function, no figure.

It is no assignment of the course: the warm-up of lesson 00 in nbgrader's source form, for tests and
benchmarks that need many submissions and little of each.
"""

from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from tests.submissions.answers import answered

ASSIGNMENT = "start-here"
ANSWER = '''
def kinetic_energy(I, qd):
    """Kinetic energy of a body that turns, J. I: kg·m²; qd: rad/s."""
    {}
'''
SOLUTION = "### BEGIN SOLUTION\n    return I * qd**2 / 2\n    ### END SOLUTION"
CHECK = """
# Checks the kinetic energy of bodies that turn.
check("start-kinetic-energy")
### BEGIN HIDDEN TESTS
check("start-kinetic-energy", fresh=True)
### END HIDDEN TESTS
"""


def source() -> NotebookNode:
    """The source version."""
    notebook = new_notebook(
        cells=[
            new_markdown_cell("# The warm-up\n\nWrite the kinetic energy of a body that turns."),
            _cell("setup", "from autograder import check", locked=True),
            _cell("answer-kinetic_energy", ANSWER.format(SOLUTION), solution=True),
            _cell("start-kinetic-energy", CHECK, locked=True, grade=True, points=2),
        ]
    )
    for number, cell in enumerate(notebook.cells):
        cell.id = f"cell-{number}"
    notebook.metadata["kernelspec"] = {
        "display_name": "Python 3 (ipykernel)",
        "language": "python",
        "name": "python3",
    }
    return notebook


def _cell(grade_id: str, text: str, **claims) -> NotebookNode:
    claims = {"grade": False, "locked": False, "solution": False} | claims
    claims |= {"grade_id": grade_id, "schema_version": 3, "task": False}
    return new_code_cell(text.strip(), metadata={"nbgrader": claims})


def _answered(release, statement):
    return answered(release, kinetic_energy=ANSWER.format(statement))


def right(release):
    return _answered(release, "return 0.5 * I * qd**2")


def wrong(release):
    return _answered(release, "return I * qd**2")


def partly_right(release):
    """Right, where it answers at all."""
    return _answered(release, "return 0.5 * I * qd**2 if qd > 0 else None")
