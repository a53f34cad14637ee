"""Writes the right answers of a mechanism as the Python that a model answer in a notebook is made of."""

import re
from collections.abc import Iterator

import numpy as np
import sympy as sp
from sympy.printing.numpy import NumPyPrinter
from sympy.simplify.fu import TR8

from autograder.mechanisms import Mechanism
from autograder.mutation.answers import ANSWERS
from autograder.mutation.inertial_parameters import in_inertial_parameters


def model_answer(mechanism: Mechanism, answer: str) -> list[str]:
    """The lines of the function's body: a name for each entry that is not 0, then what is returned."""
    if answer in MADE_OF_OTHERS:
        return MADE_OF_OTHERS[answer](mechanism)
    lines, value = _entries(mechanism, answer)
    return [*lines, f"return {value}"]


def _entries(mechanism: Mechanism, answer: str) -> tuple[list[str], str]:
    """The lines that name the entries, and the array or number that they make."""
    asked = ANSWERS[answer]
    texts = [_python(mechanism, entry) for entry in asked.entries(mechanism)]
    shape = asked.shape(mechanism.n)
    if not shape:
        return [], texts[0]
    head = answer.removesuffix("_vec")
    lines, shown = [], np.empty(shape, dtype=object)
    named = {"0": "0.0"}
    for at, text in zip(np.ndindex(shape), texts, strict=True):
        if text not in named:
            named[text] = head + "".join(str(i + 1) for i in at)
            lines.append(f"{named[text]} = {text}")
        shown[at] = named[text]
    rows = shown if len(shape) == 1 else [f"[{', '.join(row)}]" for row in shown]
    return lines, f"np.array([{', '.join(rows)}])"


def _first_order(mechanism: Mechanism) -> list[str]:
    lines = [f"q, qd = x[:{mechanism.n}], x[{mechanism.n}:]"]
    for answer in ("M", "C", "g_vec"):
        entries, value = _entries(mechanism, answer)
        lines += [*entries, f"{answer.removesuffix('_vec')} = {value}"]
    rest = "u - C @ qd - g"
    if mechanism.friction:
        torques = [
            sum(t.torque for t in mechanism.friction if mechanism.place(t) == i)
            for i in range(mechanism.n)
        ]
        shown = ", ".join(_python(mechanism, torque) for torque in torques)
        lines.append(f"friction = np.array([{shown}])")
        rest += " - friction"
    return [*lines, f"return np.concatenate([qd, np.linalg.solve(M, {rest})])"]


def _energy_drift(mechanism: Mechanism) -> list[str]:
    return [
        f"q, qd = x[:, :{mechanism.n}].T, x[:, {mechanism.n}:].T",
        f"K = {_python(mechanism, mechanism.K)}",
        f"P = {_python(mechanism, mechanism.P)}",
        "E = K + P",
        "return E - E[0]",
    ]


def _regressor(mechanism: Mechanism) -> list[str]:
    linear = in_inertial_parameters(mechanism)
    n, qdd = mechanism.n, sp.symbols(f"qdd0:{mechanism.n}")
    M, C = (sp.Matrix(n, n, ANSWERS[answer].entries(linear)) for answer in ("M", "C"))
    torque = M * sp.Matrix(qdd) + C * sp.Matrix(mechanism.qd)
    torque += sp.Matrix(ANSWERS["g_vec"].entries(linear))
    unknown = [p.symbol for p in linear.parameters if not p.known]
    rows = [[_python(linear, line.diff(pi)) for pi in unknown] for line in torque]
    shown = [f"    [{', '.join(row)}]," for row in rows]
    places = {f"qdd{i}": f"qdd[{i}]" for i in range(n)}
    lines = [re.sub(r"\bqdd\d\b", lambda at: places[at[0]], line) for line in shown]
    return ["return np.array([", *lines, "])"]


MADE_OF_OTHERS = {"f": _first_order, "energy_drift": _energy_drift, "regressor": _regressor}


def _forms(expression: sp.Expr) -> Iterator[sp.Expr]:
    """As it was derived, with its common factors out, and with products of sines and cosines as those
    of sums: velocities squared give sin² + cos², which is 1.
    """
    yield expression
    expanded = sp.expand(expression)
    yield sp.factor_terms(expanded)
    yield sp.factor_terms(sp.expand(TR8(expanded)))


def _python(mechanism: Mechanism, expression: sp.Expr) -> str:
    """The expression in q, qd and arm, in the shortest of its forms."""
    shorter = min(_forms(sp.sympify(expression)), key=sp.count_ops)
    written = {s: sp.Symbol(f"q[{i}]") for i, s in enumerate(mechanism.q)}
    written |= {s: sp.Symbol(f"qd[{i}]") for i, s in enumerate(mechanism.qd)}
    written |= {p.symbol: sp.Symbol(f"arm.{p.name}") for p in mechanism.parameters}
    written |= {
        t.symbol: sp.Symbol(f"arm.{t.coefficient}[{mechanism.place(t)}]")
        for t in mechanism.friction
    }
    return NumPyPrinter().doprint(shorter.xreplace(written)).replace("numpy.", "np.")
