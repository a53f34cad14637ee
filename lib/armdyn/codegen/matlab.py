"""Writes a derivation as MATLAB functions, for Octave too."""

import re
from typing import ClassVar

import sympy as sp
from sympy.printing.octave import OctaveCodePrinter, known_fcns_src1, known_fcns_src2

from armdyn.codegen.printing import Logic, ShortFloats, code
from armdyn.codegen.program import ARGUMENTS, FUNCTIONS, Program, program, rows, wrapped
from armdyn.derive import Derivation

# fmt: off
KEYWORDS = {
    "break", "case", "catch", "classdef", "continue", "else", "elseif", "end", "for",
    "function", "global", "if", "otherwise", "parfor", "persistent", "return", "spmd", "switch",
    "try", "while", "end_try_catch", "end_unwind_protect", "endfor", "endfunction", "endif",
    "endswitch", "endwhile", "until", "do", "unwind_protect", "unwind_protect_cleanup", "pi",
    "sqrt",
}
# fmt: on
RESERVED = {
    *KEYWORDS,
    *known_fcns_src1,
    *known_fcns_src2.values(),
    *("arm", "value", "qdd"),
    *FUNCTIONS,
    *ARGUMENTS,
}


def matlab(derivation: Derivation, name: str = "Arm") -> dict[str, str]:
    """The files of a MATLAB package `name`, one function each: file name → source.

    With the folder that holds `+name` on the path, `name.M(q, arm)`, `name.C(q, qd, arm)`,
    `name.g_vec(q, arm)`, `name.f_vec(qd, arm)`, `name.potential_energy(q, arm)` and
    `name.dynamics(q, qd, u, arm)` take columns and a struct `arm` of the parameters. They run in
    Octave too. A name that MATLAB reserves gets `_` added; the comments say so.
    Raises ValueError for names and expressions that cannot be written: see `program`.
    """
    model = program(derivation, "MATLAB", name, RESERVED, piecewise="steps")
    n = model.n
    called = f"{name}.{{}}".format
    sources = {
        "M": _function(model, "value = M(q, arm)", f"The inertia matrix, {n} x {n}.", model.M),
        "C": _function(
            model,
            "value = C(q, qd, arm)",
            f"The Coriolis and centrifugal matrix, {n} x {n}, in Christoffel form.",
            model.C,
        ),
        "g_vec": _function(
            model,
            "value = g_vec(q, arm)",
            f"The gravity vector, {n} x 1, the gradient of the potential energy.",
            model.g_vec,
        ),
        "f_vec": _function(
            model,
            "value = f_vec(qd, arm)",
            f"The friction, {n} x 1; it opposes the motion.",
            model.f_vec,
        ),
        "potential_energy": _function(
            model, "value = potential_energy(q, arm)", "The potential energy, J.", model.P
        ),
        "dynamics": [
            *_head(
                model,
                "qdd = dynamics(q, qd, u, arm)",
                f"The accelerations, {n} x 1, for the inputs u, {n} x 1.",
            ),
            f"  force = u - {called('C')}(q, qd, arm)*qd - {called('g_vec')}(q, arm) ...",
            f"      - {called('f_vec')}(qd, arm);",
            f"  qdd = {called('M')}(q, arm) \\ force;",
            "end",
        ],
    }
    return {f"+{name}/{f}.m": "\n".join([*lines, ""]) for f, lines in sources.items()}


def _head(model: Program, signature, summary):
    yield f"function {signature}"
    yield f"% {summary}"
    arm = (
        "arm: a struct with" if model.parameters else "arm: not read, as nothing is left to choose"
    )
    coordinates = f"{model.n} x 1: {', '.join(s.name for s in model.q)}"
    if "(qd" in signature:
        yield f"% qd: the velocities of q, {coordinates}. {arm}"
    else:
        velocities = ", and qd, their velocities" if "qd" in signature else ""
        yield f"% q, {coordinates}{velocities}. {arm}"
    yield from model.fields("%   {}", " ")
    yield "%"
    yield from (f"% {line}" for line in model.header())


def _function(model: Program, signature, summary, routine):
    yield from _head(model, signature, summary)
    for symbol in routine.parameters:
        yield f"  {symbol.name} = arm.{symbol.name};"
    for vector, read in (("q", routine.q), ("qd", routine.qd)):
        for i, symbol in read:
            yield f"  {symbol.name} = {vector}({i + 1});"
    for symbol, term in routine.steps:
        yield from _step(symbol.name, term)
    if hasattr(routine.result, "shape"):
        lines = rows(routine.result, _code)
        yield "  value = [" + f";\n{' ' * 11}".join(lines) + "];"
    else:
        yield from wrapped(f"value = {_code(routine.result)};", 2, " ...")
    yield "end"


def _step(name, term):
    if not isinstance(term, sp.Piecewise):
        yield from wrapped(f"{name} = {_code(term)};", 2, " ...")
        return
    # As a sum of products with 0 and 1, a case that does not hold could give 0*Inf, which is NaN.
    word = "if"
    for value, condition in term.args:
        yield from wrapped(
            f"{word} {_code(condition)}" if condition != sp.true else "else", 2, " ..."
        )
        yield from wrapped(f"{name} = {_code(value)};", 4, " ...")
        word = "elseif"
    yield "  end"


class _MatlabPrinter(ShortFloats, Logic, OctaveCodePrinter):
    """SymPy's printer for Octave, with what MATLAB understands, too."""

    _operators: ClassVar[dict[str, str]] = {"and": "&&", "or": "||", "not": "~"}

    def _print_Relational(self, expression):
        return super()._print_Relational(expression).replace(" != ", " ~= ")


def _code(expression):
    # Everything is a scalar here, where .* and * are the same.
    text = code(_MatlabPrinter({"strict": True}), expression)
    return re.sub(r"\.([*/^])", r"\1", text)
