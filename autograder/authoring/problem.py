"""Writes a problem's notebook in nbgrader's source form: symbols, answers, checks and a proof."""

import re
from pathlib import Path
from string import ascii_uppercase

import nbformat
import numpy as np
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from autograder.authoring.model_answer import model_answer
from autograder.authoring.picture import picture
from autograder.files import put_in_place
from autograder.mechanisms import Coordinate, Mechanism
from autograder.mutation.answers import ANSWERS
from autograder.mutation.inertial_parameters import inertial_parameters
from autograder.mutation.trial import nothing_to_ask

POINTS = {
    "potential_energy": 2, "M": 3, "M_dot": 3, "g_vec": 2, "C": 4, "lagrangian": 2, "f": 4,
    "energy_drift": 2, "regressor": 4,
}  # fmt: skip
PROOF_POINTS = 4
USUAL = ("potential_energy", "M", "g_vec", "C")
WHAT = {
    "potential_energy": (
        "The potential energy",
        "Write $P(q)$. Where you put its zero is up to you. Sum the energies of all bodies and springs.",
        "Potential energy, J.",
    ),
    "M": (
        "The inertia matrix",
        "Write $M(q)$, so that the kinetic energy is "
        "$K = \\tfrac12 \\dot q^{\\mathsf T} M(q)\\, \\dot q$. "
        "Before you run the check, say which of its entries change with $q$.",
        "Inertia matrix, ({n}, {n}).",
    ),
    "M_dot": (
        "The rate of the inertia matrix",
        "Write $\\dot M(q, \\dot q)$, the derivative of $M(q(t))$ with respect to time along a motion.",
        "dM/dt along qd, ({n}, {n}).",
    ),
    "g_vec": (
        "The vector $g(q)$",
        "Write $g(q) = \\partial P / \\partial q$, on the **left** of the equation of motion. Predict "
        "its signs for one position before you run the check.",
        "∂P/∂q, ({n},): gravity and springs.",
    ),
    "lagrangian": (
        "The Lagrangian",
        "Write $L = K - P$. Where you put the zero of $P$ is up to you.",
        "Lagrangian K − P, J.",
    ),
    "f": (
        "The first-order form",
        "Write $\\dot x = f(x, u)$ for the state $x = [q;\\, \\dot q]$. Predict $\\dot x$ for a "
        "mechanism at rest before you run the check.{friction}",
        "ẋ of the state x = [q; q̇], ({twice},), under the input u, ({n},).",
    ),
    "regressor": (
        "The regressor",
        "The left side of the equation of motion without friction is linear in the parameters "
        "$\\pi$ = ({pi}). Write $Y(q, \\dot q, \\ddot q)$ with $Y \\pi = M\\ddot q + C\\dot q + g$: "
        "one column for each entry of $\\pi$, in this order. Of `arm`, $Y$ may use only "
        "what is known: {known}.",
        "Y with Y π = M q̈ + C q̇ + g, ({n}, {count}), for π = ({pi}).",
    ),
    "energy_drift": (
        "The drift of the energy",
        "A simulation gives states, one in each row of `x`. Write by how much the energy $E = K + P$ "
        "has changed since the first of them, for each row.",
        "E of each row of x less E of the first, (len(x),), J.",
    ),
    "C": (
        "The matrix $C(q, \\dot q)$",
        "Write $C(q, \\dot q)$ in the Christoffel form. The check looks at $C\\dot q$, at the energy, "
        "and at $\\dot M - 2C$.",
        "Coriolis and centrifugal matrix in Christoffel form, ({n}, {n}).",
    ),
}
FRICTION = (
    " The friction $f(\\dot q)$ has two parts in each coordinate: the viscous one is its "
    "coefficient times the velocity, and the Coulomb one is its coefficient times the sign of "
    "the velocity, 0 at rest."
)
PROOF = """\
The Christoffel symbols $h_{ijk} = \\tfrac12\\left(\\frac{\\partial M_{ij}}{\\partial q_k} + \
\\frac{\\partial M_{ik}}{\\partial q_j} - \\frac{\\partial M_{jk}}{\\partial q_i}\\right)$ give \
$C_{ij} = \\sum_k h_{ijk}\\dot q_k$. By the chain rule $\\dot M_{ij} = \\sum_k \
\\frac{\\partial M_{ij}}{\\partial q_k}\\dot q_k$. In $\\dot M_{ij} - 2C_{ij}$ the first derivative \
cancels, and $\\sum_k\\left(\\frac{\\partial M_{jk}}{\\partial q_i} - \
\\frac{\\partial M_{ik}}{\\partial q_j}\\right)\\dot q_k$ is left. If $i$ and $j$ change places it \
changes its sign, since $M$ is symmetric. So $\\dot M - 2C$ is skew-symmetric. For the energy \
$E = K + P$ follows $\\dot E = \\dot q^{\\mathsf T}(M\\ddot q + \\tfrac12\\dot M\\dot q + g) = \
\\dot q^{\\mathsf T}FORCES + \\tfrac12\\dot q^{\\mathsf T}(\\dot M - 2C)\\dot q = \
\\dot q^{\\mathsf T}FORCES$."""
# What does work: the input alone, or less the friction.
FORCES = {False: "u", True: "(u - f(\\dot q))"}
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
    proof = "C" in asks  # what it asks about
    friction = bool(mechanism.friction) and any(ANSWERS[answer].friction for answer in asks)
    total = sum(POINTS[answer] for answer in asks) + (PROOF_POINTS if proof else 0)
    cells = [
        new_markdown_cell(_title(mechanism, total, friction), id=f"{name}-title"),
        new_markdown_cell(_symbols(mechanism, friction), id=f"{name}-symbols"),
        new_code_cell(
            _setup(mechanism, friction), id=f"{name}-setup", metadata=_locked(f"{name}-setup")
        ),
    ]
    for letter, answer in zip(ascii_uppercase, asks, strict=False):
        title, task, doc = _what(mechanism, answer)
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
                metadata=_cell(f"answer-{answer}", solution=True),
            ),
            new_code_cell(
                f"# Checks {ANSWERS[answer].signature} at random positions of random mechanisms.\n"
                f'check("{name}-{answer}")\n### BEGIN HIDDEN TESTS\n'
                f'check("{name}-{answer}", fresh=True)\n### END HIDDEN TESTS',
                id=f"{name}-{answer}-check",
                metadata=_cell(f"{name}-{answer}", locked=True, grade=True, points=points),
            ),
        ]
    if proof:
        cells += [
            new_markdown_cell(
                _proof_task(ascii_uppercase[len(asks)], friction), id=f"{name}-proof-task"
            ),
            new_markdown_cell(
                f"### BEGIN SOLUTION\n{proof_of(friction)}\n### END SOLUTION",
                id=f"{name}-proof",
                metadata=_cell(f"{name}-proof", solution=True, grade=True, points=PROOF_POINTS),
            ),
        ]
    cells += [
        new_markdown_cell(
            "## Before you hand in\n\nChoose *Kernel → Restart Kernel and Run All Cells*, look at every "
            "card, and press **Validate**. Then submit the notebook as your instructor says.",
            id=f"{name}-end",
        ),
    ]
    kernel = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
    return new_notebook(
        cells=cells, metadata={"kernelspec": kernel, "language_info": {"name": "python"}}
    )


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


def _setup(mechanism: Mechanism, friction: bool) -> str:
    drawn = vars(mechanism.drawn(np.random.default_rng(1), friction))
    given = ", ".join(f"{name}={_number(value)}" for name, value in drawn.items())
    return (
        "from types import SimpleNamespace\n\nimport numpy as np\n\n"
        f"from autograder import check, hint\n\narm = SimpleNamespace({given})"
    )


def _what(mechanism: Mechanism, answer: str) -> list[str]:
    """Title, task and docstring, filled in for this mechanism."""
    entries = [pi.words for pi in inertial_parameters(mechanism)]
    known = {
        "n": mechanism.n,
        "twice": 2 * mechanism.n,
        "count": len(entries),
        "pi": ", ".join(entries),
        "known": ", ".join(f"`{p.name}`" for p in mechanism.parameters if p.known) or "nothing",
        "friction": FRICTION if mechanism.friction else "",
    }
    return [
        re.sub(r"\{(n|twice|count|pi|known|friction)\}", lambda at: str(known[at[1]]), text)
        for text in WHAT[answer]
    ]


def _number(value: float | np.ndarray) -> str:
    if isinstance(value, np.ndarray):
        return f"np.array([{', '.join(f'{entry:.3g}' for entry in value)}])"
    return f"{value:.3g}"


def _answer(mechanism: Mechanism, answer: str, doc: str) -> str:
    body = ["### BEGIN SOLUTION", *model_answer(mechanism, answer), "### END SOLUTION"]
    lines = [f'"""{doc}"""', *body]
    return f"def {ANSWERS[answer].signature}:\n" + "\n".join(f"    {line}" for line in lines)


def proof_of(friction: bool) -> str:
    """The model answer of the proof, for the equation of motion with friction or without."""
    return PROOF.replace("FORCES", FORCES[friction])


def _proof_task(letter: str, friction: bool) -> str:
    return f"""\
## {letter}. By hand ({PROOF_POINTS} points, read by a person)

Show that $\\dot M - 2C$ is skew-symmetric for the Christoffel form of $C$, and what follows for the \
energy of this mechanism. Write it up in the cell below, line by line, with a reason for each line.

| points | for |
|---|---|
| 1 | the definition of the Christoffel symbols, with its three derivatives |
| 1 | $\\dot M$ by the chain rule |
| 1 | the two derivatives that are left, and why they change their sign |
| 1 | $\\dot E = \\dot q^{{\\mathsf T}} {FORCES[friction]}$, and where the skew-symmetry enters |"""


def _locked(grade_id: str) -> dict:
    return _cell(grade_id, locked=True)


def _cell(grade_id: str, *, solution=False, locked=False, grade=False, points=None) -> dict:
    cell = {
        "grade": grade,
        "grade_id": grade_id,
        "locked": locked,
        "schema_version": 3,
        "solution": solution,
        "task": False,
    }
    return {"nbgrader": cell if points is None else cell | {"points": points}}
