"""Writes the right answers of a mechanism as the Python that a model answer in a notebook is made of."""

import numpy as np
import sympy as sp
from sympy.printing.numpy import NumPyPrinter

from autograder.mechanisms import Mechanism
from autograder.mutation.answers import ANSWERS


def model_answer(mechanism: Mechanism, answer: str) -> list[str]:
    """The lines of the function's body: a name for each entry that is not 0, then what is returned."""
    asked = ANSWERS[answer]
    texts = [_python(mechanism, entry) for entry in asked.entries(mechanism)]
    shape = asked.shape(mechanism.n)
    if not shape:
        return [f"return {texts[0]}"]
    head = answer.removesuffix("_vec")
    lines, shown = [], np.empty(shape, dtype=object)
    named = {"0": "0.0"}
    for at, text in zip(np.ndindex(shape), texts, strict=True):
        if text not in named:
            named[text] = head + "".join(str(i + 1) for i in at)
            lines.append(f"{named[text]} = {text}")
        shown[at] = named[text]
    rows = shown if len(shape) == 1 else [f"[{', '.join(row)}]" for row in shown]
    return [*lines, f"return np.array([{', '.join(rows)}])"]


def _python(mechanism: Mechanism, expression: sp.Expr) -> str:
    """The expression in q, qd and arm, as derived or with its common factors out, as is shorter."""
    shorter = min(expression, sp.factor_terms(sp.expand(expression)), key=sp.count_ops)
    written = {s: sp.Symbol(f"q[{i}]") for i, s in enumerate(mechanism.q)}
    written |= {s: sp.Symbol(f"qd[{i}]") for i, s in enumerate(mechanism.qd)}
    written |= {p.symbol: sp.Symbol(f"arm.{p.name}") for p in mechanism.parameters}
    return NumPyPrinter().doprint(shorter.xreplace(written)).replace("numpy.", "np.")
