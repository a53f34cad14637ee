"""Answers as people dress them: below lines about figures, packages and the notebook itself."""

import copy

from nbformat import NotebookNode

# Any backend, of which not one is there without a screen, and what asks for a network or a person.
LINES = """
%matplotlib inline
%pylab
import matplotlib
matplotlib.use("TkAgg")
%pip install pandas
""".strip()


def dressed(notebook: NotebookNode, lines: str = LINES) -> NotebookNode:
    """A copy with the lines above each answer in code."""
    notebook = copy.deepcopy(notebook)
    answers = [
        cell
        for cell in notebook.cells
        if cell.cell_type == "code" and cell.metadata.get("nbgrader", {}).get("solution")
    ]
    if any("sum(" in cell.source for cell in answers):
        # In a kernel, too, it would put NumPy's sum in the place of Python's.
        lines = lines.replace("%pylab", "%pylab --no-import-all")
    for cell in answers:
        cell.source = f"{lines}\n{cell.source}"
    return notebook
