"""Writes a derivation as a C++ header for Eigen."""

from sympy.printing.c import C99CodePrinter, get_math_macros
from sympy.printing.cxx import CXX17CodePrinter

from armdyn.codegen.printing import CFamily, code
from armdyn.codegen.program import ARGUMENTS, FUNCTIONS, Program, program, rows, wrapped
from armdyn.derive import Derivation

RESERVED = {
    *CXX17CodePrinter.reserved_words,
    *("register", "std", "Eigen", "Vector", "Matrix", "value"),
    # Macros of the headers that <cmath> may bring.
    *("INFINITY", "NAN", "HUGE_VAL", "NULL", "errno", *get_math_macros().values()),
    *FUNCTIONS,
    *ARGUMENTS,
}


def cpp(derivation: Derivation, name: str = "Arm") -> str:
    """A C++ header (C++11, Eigen 3) with a struct `name`: parameters, and the equation's functions.

    M(q), C(q, qd), g_vec(q), f_vec(qd), potential_energy(q) and dynamics(q, qd, u), which solves
    for q̈ by `ldlt`. A name that C++ reserves gets `_` added; the header's first comment says so.
    Raises ValueError for names and expressions that cannot be written: see `program`.
    """
    model = program(derivation, "C++", name, RESERVED)
    return "\n".join([*(f"// {line}" for line in model.header()), *_file(model), ""])


def _file(model: Program):
    yield from ("#pragma once", "", "#include <cmath>", "")
    yield from ("#include <Eigen/Dense>", "", f"struct {model.name} {{")
    yield f"  using Vector = Eigen::Matrix<double, {model.n}, 1>;"
    yield f"  using Matrix = Eigen::Matrix<double, {model.n}, {model.n}>;"
    yield ""
    yield from model.fields("  double {};", "//")
    yield ""
    yield "  // The inertia matrix."
    yield from _function("Matrix M", model.M, "q")
    yield "  // The Coriolis and centrifugal matrix, in Christoffel form."
    yield from _function("Matrix C", model.C, "q", "qd")
    yield "  // The gravity vector, the gradient of the potential energy."
    yield from _function("Vector g_vec", model.g_vec, "q")
    yield "  // The friction; it opposes the motion."
    yield from _function("Vector f_vec", model.f_vec, "qd")
    yield "  // The potential energy, J."
    yield from _function("double potential_energy", model.P, "q")
    yield "  // The accelerations qdd for the inputs u; M(q) must be positive definite."
    yield "  Vector dynamics(const Vector& q, const Vector& qd, const Vector& u) const {"
    yield "    return M(q).ldlt().solve(u - C(q, qd) * qd - g_vec(q) - f_vec(qd));"
    yield "  }"
    yield "};"


def _function(head, routine, *vectors):
    reads = {"q": routine.q, "qd": routine.qd}
    arguments = [f"const Vector& {v if reads[v] else f'/* {v} */'}" for v in vectors]
    yield f"  {head}({', '.join(arguments)}) const {{"
    for vector, read in reads.items():
        if read:
            named = ", ".join(f"{symbol.name} = {vector}[{i}]" for i, symbol in read)
            yield from wrapped(f"const double {named};", 4)
    for symbol, term in routine.steps:
        yield from wrapped(f"const double {symbol.name} = {_code(term)};", 4)
    if head.startswith("double"):
        yield from wrapped(f"return {_code(routine.result)};", 4)
    else:
        kind = head.split()[0]
        first = f"    {kind} value;\n    value << "
        yield first + f",\n{' ' * 13}".join(rows(routine.result, _code)) + ";"
        yield "    return value;"
    yield "  }"
    yield ""


class _CppPrinter(CFamily, CXX17CodePrinter):
    # std::max would not take 0 and a double; fmax does.
    _print_Max = C99CodePrinter._print_Max
    _print_Min = C99CodePrinter._print_Min


def _code(expression):
    return code(_CppPrinter({"strict": True, "math_macros": {}}), expression)
