"""No output of a lesson is what a problem on the same arm asks for.

A lesson derives M, C and g of the 2R arm and of the pendulum; the student who writes them in a problem
shall not find them printed. An output's expressions, and the terms of their sums, are compared in
numbers with the entries that the problems ask for, whatever their letters are called; in a listing in
C++, Java or MATLAB its own names are put in first. Nor are the base parameters of the 2R arm printed,
for which c6 asks.
"""

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from types import SimpleNamespace

import nbformat
import numpy as np
import pytest
import sympy as sp

from autograder.problems import CHECKS

LESSONS = sorted((Path(__file__).parents[2] / "lessons").glob("*.ipynb"))
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
LETTERS = {"ell_": "l", "ell": "l", "qddot": "qdd", "qdot": "qd"}


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
        name = symbol.name
        for own, ours in LETTERS.items():
            name = name.replace(own, ours)
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
