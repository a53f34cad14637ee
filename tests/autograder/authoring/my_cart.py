"""A problem with checks of the course's own, and a mistake that the course adds to p3."""

import nbformat

from autograder.authoring.checks_template import of_a_problem

# The cart-pole by hand; the kit's own asks for cart-pole-M and so on.
CART = of_a_problem("my-cart")
HELD = "Your frequency is that of a trolley which stands still."
RIGHT = "return np.sqrt((arm.mt + arm.ml) * arm.g / (arm.mt * arm.l))"
COUPLED = """c = arm.ml * arm.l * np.cos(q[1])
    return np.array([[arm.mt + arm.ml, c], [c, arm.ml * arm.l**2]])"""
WRONG = "return np.sqrt(arm.g / arm.l)"
HALF = "Your inertia is half of the right one. Which of your lines halves it?"
MISTAKES = f"""
from autograder.checks import Mistake

MISTAKES = {{"p3-M": (Mistake("half", lambda q, pend: pend.I / 2, "{HALF}"),)}}
"""


def written(root, name, text):
    """The file in checks/ with this text."""
    (root / "checks").mkdir(exist_ok=True)
    path = root / "checks" / f"{name}.py"
    path.write_text(text, encoding="utf-8")
    return path


def with_answers(path, *bodies):
    """The notebook, whose answers now are these."""
    notebook = nbformat.read(path, 4)
    cells = [c for c in notebook.cells if c.cell_type == "code" and "def " in c.source]
    for cell, body in zip(cells, bodies, strict=True):
        cell.source = cell.source.replace("raise NotImplementedError  # your model answer", body)
    nbformat.write(notebook, path)
    return notebook
