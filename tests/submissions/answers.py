"""Answers put into a released notebook, as a student would."""

import copy
import textwrap

from nbformat import NotebookNode


def cell_of(notebook: NotebookNode, grade_id: str) -> NotebookNode:
    """The cell with this grade_id."""
    return next(
        cell
        for cell in notebook.cells
        if cell.metadata.get("nbgrader", {}).get("grade_id") == grade_id
    )


def blank(release: NotebookNode) -> NotebookNode:
    return copy.deepcopy(release)


def answered(release: NotebookNode, **answers: str) -> NotebookNode:
    """The released notebook with answers filled in, by the name of the function."""
    notebook = copy.deepcopy(release)
    for name, source in answers.items():
        cell_of(notebook, f"answer-{name}").source = source.strip("\n")
    return notebook


class Answers(dict[str, str]):
    """The right answers of one problem, by the name of the function."""

    def function(self, name: str, body: str) -> str:
        """The student's function of that name: `body` is the expression it returns, or all its lines."""
        head = self[name].strip().splitlines()[0]
        return f"{head}\n{indented(body)}\n"

    def right_but(self, release: NotebookNode, /, **answers: str) -> NotebookNode:
        """All answers right but these."""
        return answered(release, **(self | answers))


def indented(body: str) -> str:
    """What stands below a function's head: `body` is the expression it returns, or all its lines."""
    body = body if "return" in body else f"return {body.strip()}"
    return textwrap.indent(body.strip("\n"), "    ")
