"""Nothing in a lesson is what a problem on the same arm asks for: no output, no code, no formula.

A lesson leads to M, C and g of the 2R arm and of the pendulum; the student who writes them in a problem
shall not find them ready. The expressions of outputs, of open code and of texts, and the terms of their
sums, are compared in numbers with the entries that the problems ask for, whatever their letters are
called; in a listing in C++, Java or MATLAB its own names are put in first. Nor are the base parameters
of the 2R arm printed, for which c6 asks.
"""

import re
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path
from types import SimpleNamespace

import nbformat
import numpy as np
import pytest
import sympy as sp

from autograder.problems import CHECKS
from tests.notebooks.formulas import CodeReader, Reader, known_as

LESSONS = sorted((Path(__file__).parents[2] / "lessons").glob("*.ipynb"))
# Formulas that stand in a lesson though a problem asks for them, and why.
STANDS = {
    # The smallest case is derived once, as the model of all that follow; p3 asks to do it again, for its
    # Lagrangian, its traps and its frequency.
    "01-pendulum-hand": {"p3-g_vec"},
    # The columns of link 1 and of J2 are the worked examples of a regressor; c6 asks for all six.
    "06-regressor-hand": {"c6-regressor"},
    "06-regressor-sympy": {"c6-regressor"},
}
RNG = np.random.default_rng(17)
PARAMETERS = ("l1", "l2", "lc1", "lc2", "m1", "m2", "I1", "I2", "m", "lc", "I", "g")
STATES = ("q", "q1", "q2", "qd", "qd1", "qd2", "qdd", "qdd1", "qdd2")
NUMBERS = dict(zip(PARAMETERS + STATES, RNG.uniform(0.5, 2.0, 21), strict=True))
# m1 cx1 + m2 l1 and J1 + m2 l1², as `armdyn.base_parameters` and people write them.
BASE = re.compile(r"\b(m1 l?cx?1|J1) \+ ([\d.]+ )?m2\b")
# How C++, Java and MATLAB write what SymPy writes as cos(q2), q2, lc2 and lc2**2.
SPELLINGS = (
    (r"\bstd::|\bMath\.|\barm\.", ""),
    (r"\b(qd?)(?:\[0\]|\.get\(0\)|\(1\))", r"\g<1>1"),
    (r"\b(qd?)(?:\[1\]|\.get\(1\)|\(2\))", r"\g<1>2"),
    (r"\bpow\((\w+), 2\)", r"\1**2"),
    (r"\^", "**"),
)


@cache
def asked() -> list[tuple[str, float]]:
    """The entries that problems ask for, in numbers; those without a sine or cosine are no secret."""
    arm = SimpleNamespace(**NUMBERS)
    q, qd = np.array([arm.q1, arm.q2]), np.array([arm.qd1, arm.qd2])
    arguments = {
        "p1-M": (q, arm),
        "p2-M_dot": (q, qd, arm),
        "p2-C": (q, qd, arm),
        "p3-g_vec": (np.array([arm.q]), arm),
        "p4-g_vec": (q, arm),
        "p4-potential_energy": (q, arm),
        "c6-regressor": (q, qd, np.array([arm.qdd1, arm.qdd2]), arm),
    }
    found = []
    for id, given in arguments.items():
        value = np.ravel(CHECKS[id].reference(*given))
        turned = [x + 1.0 if np.ndim(x) else x for x in given]
        changes = ~np.isclose(value, np.ravel(CHECKS[id].reference(*turned)))
        found += [(id, float(v)) for v in value[changes]]
    return found


def expressions(text: str) -> Iterator[sp.Expr]:
    """The SymPy expressions of an output: a whole one, or those after a "=" in printed lines."""
    for part in [text, *(line.partition(" = ")[2] for line in text.splitlines())]:
        part = re.sub(r"(?<=Cos|Sin)\[([^]]*)\]", r"(\1)", part).replace("^", "**")
        part = part.replace("Cos(", "cos(").replace("Sin(", "sin(")
        if re.search(r"\b(sin|cos)\(", part):
            found = expression(part, {})
            yield from found if isinstance(found, sp.MatrixBase) else [found] if found else []


def listed(text: str) -> Iterator[sp.Expr]:
    """The expressions of a listing in C++, Java or MATLAB, with its own names put in."""
    for old, new in SPELLINGS:
        text = re.sub(old, new, text)
    known: dict[str, sp.Expr] = {}
    for line in text.splitlines():
        for statement in line.split(";"):
            left, assigned, right = statement.partition(" = ")
            parts = re.split(r"[,{}\[\]]|<<", right if assigned else left)
            found = [one for one in (expression(part, known) for part in parts) if one is not None]
            yield from found
            if assigned and len(parts) == len(found) == 1:
                known[left.split()[-1]] = found[0]


def expression(text: str, known: dict[str, sp.Expr]):
    """What SymPy reads in a text, with known names put in; None where it is no expression."""
    text = text.strip()
    if not re.fullmatch(r"[\w\s()\[\],*+/.-]+", text):
        return None
    names = set(re.findall(r"\b[A-Za-z_]\w*", text)) - {"sin", "cos", "Matrix"}
    try:
        found = sp.sympify(text, locals={name: known.get(name, sp.Symbol(name)) for name in names})
    except (sp.SympifyError, SyntaxError, TypeError, AttributeError):
        return None
    return found if isinstance(found, sp.Expr | sp.MatrixBase) else None


def number(found: sp.Expr) -> float | None:
    """An expression in numbers; None where it has letters that no problem has."""
    values = {}
    for symbol in found.free_symbols:
        name = known_as(symbol.name)
        if name not in NUMBERS:
            return None
        values[symbol] = NUMBERS[name]
    return float(found.subs(values))


def answers_in(text: str) -> set[str]:
    """The checks of which an output holds an entry."""
    found = {"c6-discussion"} if BASE.search(text) else set()
    for whole in (*expressions(text), *(listed(text) if "```" in text else ())):
        for part in (whole, *sp.Add.make_args(sp.expand(whole))):
            value = number(part)
            if value is not None and part.has(sp.sin, sp.cos):
                found |= {id for id, entry in asked() if np.isclose(value, entry, rtol=1e-9)}
    return found


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("-l1*lc2*m2*qdot1*sin(q2)", set()),
        ("l1*lc2*m2*qdot1*sin(q2)", {"p2-C"}),
        ("C12 = -l1*lc2*m2*qd1*Sin[q2] - l1*lc2*m2*qd2*Sin[q2]", {"p2-C", "p2-M_dot"}),
        ("M12 = I2 + l1*lc2*m2*Cos[q2] + lc2^2*m2", {"p1-M"}),
        ("Matrix([\n[ell_c2*g*m2*cos(q1 + q2)]])", {"p4-g_vec"}),
        ("I*qddot + ell_c*g*m*sin(q)", {"p3-g_vec"}),
        ("I2 + lc2**2*m2", set()),
        ("h_122 = -lc2*m2*sin(q2)", set()),
        ("4 base parameters: m1 cx1 + 1.2 m2; J1 + 1.44 m2; m2 cx2; J2", {"c6-discussion"}),
        ("6 base parameters: m1 cx1; m1 cy1; Jzz1 + Jzz2; m2; m2 cx2; m2 cy2", set()),
        (
            "```cpp\nconst double b = m2 * l1 * lc2 * std::cos(q[1]);\n"
            "const double M22 = I2 + m2 * lc2 * lc2;\nconst double M12 = M22 + b;\n```",
            {"p1-M"},
        ),
        (
            "```java\ndouble h = -m2 * l1 * lc2 * Math.sin(q.get(1));\nreturn new SimpleMatrix("
            "new double[][] {{h * qd.get(1), h * (qd.get(0) + qd.get(1))}, {-h * qd.get(0), 0}});\n```",
            {"p2-C", "p2-M_dot"},
        ),
        (
            "```matlab\ngm2 = arm.g*arm.m2*arm.lc2;\ng2 = gm2*cos(q(1) + q(2));\n"
            "value = [g2 + (arm.m1*arm.lc1 + arm.m2*arm.l1)*arm.g*cos(q(1));\n g2];\n```",
            {"p4-g_vec"},
        ),
        ("```matlab\nM11 = arm.I + arm.m*q(2)^2;\nC12 = arm.m*q(2)*qd(1);\n```", set()),
        ("PD alone rests [11.8  7.1] degrees below the target", set()),
    ],
)
def test_an_answer_is_seen(text, found):
    assert answers_in(text) == found


@pytest.mark.parametrize("path", LESSONS, ids=lambda path: path.stem)
def test_a_lesson_prints_no_answer(path):
    printed = {}
    for cell in nbformat.read(path, as_version=4).cells:
        for output in cell.get("outputs", []):
            data = output.get("data", {})
            text = output.get("text") or data.get("text/markdown") or data.get("text/plain", "")
            if found := answers_in(text):
                printed[cell.id] = printed.get(cell.id, set()) | found
    assert printed == {}


def answers_among(worths: Iterable[tuple[float, ...]]) -> set[str]:
    """The checks of which formulas with these numbers are an entry."""
    return {
        id
        for numbers in worths
        for value in numbers
        for id, entry in asked()
        if np.isclose(value, entry, rtol=1e-9)
    }


def typed_in(path: Path) -> dict[str, set[str]]:
    """The checks whose entries stand in a lesson's texts and open code, by the cells' ids."""
    reader, code = Reader(NUMBERS), CodeReader(NUMBERS)
    found = {}
    for cell in nbformat.read(path, as_version=4).cells:
        folded = cell.metadata.get("jupyter", {}).get("source_hidden")
        if cell.cell_type == "markdown":
            found[cell.id] = answers_among(reader.worths(cell.source))
        elif not folded:
            found[cell.id] = answers_among(code.worths(cell.source))
    return {id: checks for id, checks in found.items() if checks}


H = r"$h = -\,m_2\ell_1\ell_{c2}\sin q_2$, so "


@pytest.mark.parametrize(
    ("text", "found"),
    [
        (r"$M_{12} = I_2 + m_2(\ell_{c2}^2 + \ell_1\ell_{c2}\cos q_2)$", {"p1-M"}),
        (r"$M_{12} = I_2 + m_2(\ell_{c2}^2 - \ell_1\ell_{c2}\cos q_2)$", set()),
        (
            r"$\alpha = I_2 + m_2\ell_{c2}^2$, $k = m_2\ell_1\ell_{c2}$: $\alpha + k\cos q_2$",
            {"p1-M"},
        ),
        (
            r"$b = m_2\ell_1\ell_{c2}\cos q_2$, $M_{22} = I_2 + m_2\ell_{c2}^2$, $M_{12} = M_{22} + b$",
            {"p1-M"},
        ),
        (H + r"$$\begin{bmatrix}h\dot q_2 & 0\\ 0 & 1\end{bmatrix}$$", {"p2-C", "p2-M_dot"}),
        (
            H + r"$C\dot q = \bigl(h\,(2\dot q_1\dot q_2 + \dot q_2^2),\ -h\,\dot q_1^2\bigr)$",
            set(),
        ),
        (
            r"$$C = \begin{bmatrix}\sigma\,\dot q_2 & 0\\ -\sigma\,\dot q_1 & 0\end{bmatrix}$$",
            set(),
        ),
        (r"$P = \underbrace{(m_1\ell_{c1} + m_2\ell_1)g}_A\sin q_1$, $g_1 - B = A\cos q_1$", set()),
        (r"$\underbrace{m_2\ell_{c2}\,g}_{B}$ and $g_2 = B\cos(q_1 + q_2)$", {"p4-g_vec"}),
        (r"$$I\,\ddot q + m g\,\ell_c\sin q = u$$", {"p3-g_vec"}),
        (r"$\det M = \alpha\beta - \gamma^2$ and $\sum_k m_k$", set()),
    ],
)
def test_an_answer_is_seen_in_a_text(text, found):
    assert answers_among(Reader(NUMBERS).worths(text)) == found


@pytest.mark.parametrize(
    ("code", "found"),
    [
        ("k = m2 * l1 * lc2\nM12 = I2 + m2 * lc2**2 + k * sp.cos(q2)", {"p1-M"}),
        ("k = m2 * l1 * lc2\nM12 = I2 + m2 * lc2**2 + k * sp.sin(q2)", set()),
        ("h = -arm.m2 * arm.l1 * arm.lc2 * np.sin(q[..., 1])\nC = [[h * qd[..., 1], 0]]", {"p2-C"}),
        ("h = -m2 * l1 * lc2 * np.sin(Q[:, 1])\nC[:, 1, 0] = -h * QD[:, 0]", {"p2-C"}),
        ("def C(qd1):\n    return m2 * l1 * lc2 * sin(q2) * qd1", {"p2-C"}),
        ("u = k * qd1 * qd2\nk = m2 * l1 * lc2 * sin(q2)", set()),
        ("g2 = -P.diff(q2)\nM11 = equation.jacobian(qdd)[0, 0]", set()),
        ("assert equal(a, m2 * lc2 * g * sp.cos(q1 + q2))", {"p4-g_vec"}),
    ],
)
def test_an_answer_is_seen_in_code(code, found):
    assert answers_among(CodeReader(NUMBERS).worths(code)) >= found
    assert bool(answers_among(CodeReader(NUMBERS).worths(code))) == bool(found)


@pytest.mark.parametrize("path", LESSONS, ids=lambda path: path.stem)
def test_a_lesson_types_no_answer(path):
    stands = {id: of for id, of in STANDS.items() if id.startswith(path.name[:2])}
    assert typed_in(path) == stands
