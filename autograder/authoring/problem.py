"""Writes a problem's notebook in nbgrader's source form: symbols, answers, checks and a proof."""

from pathlib import Path
from string import ascii_uppercase

import nbformat
import numpy as np
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from autograder.authoring import proof
from autograder.authoring.model_answer import model_answer
from autograder.authoring.picture import picture
from autograder.authoring.tasks import POINTS, task_of
from autograder.files import put_in_place
from autograder.mechanisms import Coordinate, Mechanism
from autograder.mutation.answers import ANSWERS
from autograder.mutation.trial import nothing_to_ask

USUAL = ("potential_energy", "M", "g_vec", "C")
GREEK = (
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "kappa", "mu", "nu", "xi",
    "rho", "sigma", "tau", "phi", "chi", "psi", "omega",
)  # fmt: skip


class ProblemError(ValueError):
    """The problem cannot be written; the text says why, and what to do."""


def usual_asks(mechanism: Mechanism) -> list[str]:
    """What a problem asks if nobody says: P, M, g and C, less what is 0 for every motion."""
    return [answer for answer in USUAL if not nothing_to_ask(mechanism, answer)]


def write_problem(root: Path, mechanism: Mechanism, asks: list[str]) -> Path:
    """Write solutions/NAME/NAME.ipynb and its picture, and give the notebook's path.

    asks: names of answers, each once. ProblemError for another name, for an answer that is 0 for every
    motion, and where the notebook is there.
    """
    unknown = [answer for answer in asks if answer not in ANSWERS]
    if unknown or not asks or len(set(asks)) < len(asks):
        raise ProblemError(
            f"asks {', '.join(asks) or 'nothing'}: needs some of {', '.join(ANSWERS)}, each once"
        )
    for answer in asks:
        if why := nothing_to_ask(mechanism, answer):
            raise ProblemError(why)
    folder = root / "solutions" / mechanism.name
    path = folder / f"{mechanism.name}.ipynb"
    if path.exists():
        raise ProblemError(
            f"{path.relative_to(root)} is there already; move it away to write the problem again"
        )
    folder.mkdir(parents=True, exist_ok=True)
    put_in_place(folder / f"{mechanism.name}.svg", picture(mechanism))
    put_in_place(path, nbformat.writes(notebook(mechanism, asks)) + "\n")
    return path


def notebook(mechanism: Mechanism, asks: list[str]) -> nbformat.NotebookNode:
    """The problem in nbgrader's source form, with model answers."""
    name = mechanism.name
    has_proof = "C" in asks  # what it asks about
    friction = bool(mechanism.friction) and any(ANSWERS[answer].friction for answer in asks)
    total = sum(POINTS[answer] for answer in asks) + (proof.POINTS if has_proof else 0)
    cells = [
        new_markdown_cell(_title(mechanism, total, friction), id=f"{name}-title"),
        new_markdown_cell(_symbols(mechanism, friction), id=f"{name}-symbols"),
        new_code_cell(
            _setup(mechanism, friction, has_proof),
            id=f"{name}-setup",
            metadata=_locked(f"{name}-setup"),
        ),
    ]
    for letter, answer in zip(ascii_uppercase, asks, strict=False):
        title, task, doc = task_of(mechanism, answer)
        points = POINTS[answer]
        cells += [
            new_markdown_cell(
                f"## {letter}. {title} ({points} points)\n\n{task}\n\n"
                f'`hint("{name}-{answer}")` gives a hint; the next call gives a stronger one.',
                id=f"{name}-{answer}-task",
            ),
            new_code_cell(
                _answer(mechanism, answer, doc),
                id=f"{name}-{answer}-answer",
                metadata=cell_of(f"answer-{answer}", solution=True),
            ),
            new_code_cell(
                f"# Checks {ANSWERS[answer].signature} at random positions of random mechanisms.\n"
                f'check("{name}-{answer}")\n### BEGIN HIDDEN TESTS\n'
                f'check("{name}-{answer}", fresh=True)\n### END HIDDEN TESTS',
                id=f"{name}-{answer}-check",
                metadata=cell_of(f"{name}-{answer}", locked=True, grade=True, points=points),
            ),
        ]
    if has_proof:
        cells += _proof(name, ascii_uppercase[len(asks)], friction)
    cells += [
        new_markdown_cell(
            "## Before you hand in\n\nChoose *Kernel → Restart Kernel and Run All Cells*, look at every "
            "card, and press **Validate**. Then submit the notebook as your instructor says.",
            id=f"{name}-end",
        ),
    ]
    return as_notebook(cells)


def as_notebook(cells: list[nbformat.NotebookNode]) -> nbformat.NotebookNode:
    """A notebook of these cells, for every student's Python."""
    kernel = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
    return new_notebook(
        cells=cells, metadata={"kernelspec": kernel, "language_info": {"name": "python"}}
    )


def _proof(name: str, letter: str, friction: bool) -> list[nbformat.NotebookNode]:
    """Its task, the lines that are marked, and the text that a person reads."""
    derived = proof.lines_of(name, friction)
    cells = [
        new_markdown_cell(proof.task(letter, friction), id=f"{name}-proof-task"),
        new_markdown_cell(proof.lines_task(derived), id=f"{name}-proof-lines"),
    ]
    for lines in derived:
        cells += [
            new_code_cell(
                lines.answer,
                id=f"{lines.id}-answer",
                metadata=cell_of(f"answer-{lines.id}", solution=True),
            ),
            new_code_cell(lines.call, id=f"{lines.id}-lines", metadata=_locked(lines.id)),
        ]
    return [
        *cells,
        new_markdown_cell(
            f"### BEGIN SOLUTION\n{proof.text_of(friction)}\n### END SOLUTION",
            id=f"{name}-proof",
            metadata=cell_of(f"{name}-proof", solution=True, grade=True, points=proof.POINTS),
        ),
    ]


def _title(mechanism: Mechanism, total: int, friction: bool) -> str:
    words = mechanism.name.replace("-", " ")
    resisting = " + f(\\dot q)" if friction else ""
    return (
        f"# Problem: {words}\n\nThe equation of motion of this mechanism has the canonical form\n\n"
        f"$$M(q)\\,\\ddot q + C(q,\\dot q)\\,\\dot q + g(q){resisting} = u .$$\n\n"
        f"You will write its parts as functions of numbers. {total} points."
    )


def _symbols(mechanism: Mechanism, friction: bool) -> str:
    rows = ["| in code | meaning | unit |", "|---|---|---|"]
    for i, c in enumerate(mechanism.coordinates):
        rows.append(f"| `q[{i}]` | ${_latex(c.name)}$: 0 is {c.zero} | {c.unit} |")
    for i, c in enumerate(mechanism.coordinates):
        rows.append(f"| `qd[{i}]` | {_rate(c)} | {c.unit}/s |")
    rows += [
        f"| `arm.{p.name}` | {p.doc.replace('|', '&#124;')} | {p.unit} |"
        for p in mechanism.parameters
    ]
    rows += [
        f"| `arm.{t.coefficient}[{mechanism.place(t)}]` | coefficient of {t.name} | {t.unit} |"
        for t in mechanism.friction
        if friction
    ]
    alt = f"The mechanism {mechanism.name} in one position; its joints are circles."
    return f"![{alt}]({mechanism.name}.svg)\n\n" + "\n".join(rows)


def _rate(coordinate: Coordinate) -> str:
    """A velocity, with the name that a check's sentence gives it."""
    return f"$\\dot{{{_latex(coordinate.name)}}}$; the checks call it {coordinate.velocity.name}"


def _latex(name: str) -> str:
    head = name.rstrip("0123456789")
    head = f"\\{head}" if head in GREEK else head
    index = name[len(name.rstrip("0123456789")) :]
    return f"{head}_{index}" if index else head


def _setup(mechanism: Mechanism, friction: bool, has_proof: bool) -> str:
    calls = "check, derivation, hint" if has_proof else "check, hint"
    drawn = vars(mechanism.drawn(np.random.default_rng(1), friction))
    given = ", ".join(f"{name}={_number(value)}" for name, value in drawn.items())
    return (
        "from types import SimpleNamespace\n\nimport numpy as np\n\n"
        f"from autograder import {calls}\n\narm = SimpleNamespace({given})"
    )


def _number(value: float | np.ndarray) -> str:
    if isinstance(value, np.ndarray):
        return f"np.array([{', '.join(f'{entry:.3g}' for entry in value)}])"
    return f"{value:.3g}"


def _answer(mechanism: Mechanism, answer: str, doc: str) -> str:
    body = ["### BEGIN SOLUTION", *model_answer(mechanism, answer), "### END SOLUTION"]
    lines = [f'"""{doc}"""', *body]
    return f"def {ANSWERS[answer].signature}:\n" + "\n".join(f"    {line}" for line in lines)


def _locked(grade_id: str) -> dict:
    return cell_of(grade_id, locked=True)


def cell_of(grade_id: str, *, solution=False, locked=False, grade=False, points=None) -> dict:
    """The metadata of a cell that nbgrader knows."""
    cell = {
        "grade": grade,
        "grade_id": grade_id,
        "locked": locked,
        "schema_version": 3,
        "solution": solution,
        "task": False,
    }
    return {"nbgrader": cell if points is None else cell | {"points": points}}
