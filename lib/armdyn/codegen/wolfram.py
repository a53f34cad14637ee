"""Writes a derivation as definitions in the Wolfram Language."""

from sympy.printing.mathematica import MCodePrinter, known_functions

from armdyn.codegen.printing import Logic, code
from armdyn.codegen.program import Program, Routine, program, rows, wrapped
from armdyn.derive import Derivation

HEADS = {"Abs": "Abs", "sign": "Sign", "floor": "Floor", "ceiling": "Ceiling"}
RESERVED = {
    *"CDEIKNO",  # symbols of the system, protected
    *(
        "Pi",
        "Module",
        "LinearSolve",
        "Dot",
        "List",
        "Piecewise",
        "True",
        "False",
        "And",
        "Or",
        "Not",
    ),
    *HEADS.values(),
    *(head for cases in known_functions.values() for _, head in cases),
}


def wolfram(derivation: Derivation, name: str = "arm") -> str:
    """Wolfram Language source: definitions, symbolic in the parameters, whose names begin with `name`.

    nameM[q], nameC[q, qd], nameGVec[q], nameFVec[qd], namePotentialEnergy[q] and
    nameDynamics[q, qd, u] take lists, of symbols or of numbers; parameters are given values with
    /. {l1 -> 1, …}. There are no underscores in the language's names: l_1 becomes l1. A name that
    the system reserves gets `Sym` added; the first comment says which.
    Raises ValueError for names and expressions that cannot be written: see `program`.
    """
    spelling = {"mark": "Sym", "underscores": False}
    model = program(derivation, "Wolfram", name, RESERVED, piecewise="whole", **spelling)
    return "\n".join([*(f"(* {line} *)" for line in model.header()), *_file(model), ""])


def _file(model: Program):
    q, qd = (", ".join(f"{s.name}_" for s in symbols) for symbols in (model.q, model.qd))
    if model.parameters:
        yield "(* The parameters are symbols:"
        yield from model.fields("     {}", " ")
        yield "   give them values by a rule, as in expression /. {g -> 9.81}. *)"
    yield "\n(* The inertia matrix. *)"
    yield from _definition(f"{model.name}M[{{{q}}}]", model.M)
    yield "\n(* The Coriolis and centrifugal matrix, in Christoffel form. *)"
    yield from _definition(f"{model.name}C[{{{q}}}, {{{qd}}}]", model.C)
    yield "\n(* The gravity vector, the gradient of the potential energy. *)"
    yield from _definition(f"{model.name}GVec[{{{q}}}]", model.g_vec, vector=True)
    yield "\n(* The friction; it opposes the motion. *)"
    yield from _definition(f"{model.name}FVec[{{{qd}}}]", model.f_vec, vector=True)
    yield "\n(* The potential energy, J. *)"
    yield from _definition(f"{model.name}PotentialEnergy[{{{q}}}]", model.P)
    yield "\n(* The accelerations qdd for the inputs u. *)"
    yield f"{model.name}Dynamics[q_, qd_, u_] := LinearSolve[{model.name}M[q],"
    yield f"  u - {model.name}C[q, qd] . qd - {model.name}GVec[q] - {model.name}FVec[qd]]"


def _definition(head, routine: Routine, vector=False):
    if not routine.steps:
        yield from (f"{head} :=", *_result(routine.result, vector))
        return
    local = ", ".join(symbol.name for symbol, _ in routine.steps)
    yield from wrapped(f"{head} := Module[{{{local}}},", 0)
    for symbol, term in routine.steps:
        yield from wrapped(f"{symbol.name} = {_code(term)};", 2)
    *lines, last = _result(routine.result, vector)
    yield from (*lines, f"{last}]")


def _result(result, vector):
    if not hasattr(result, "shape"):
        return wrapped(_code(result), 2)
    if vector:
        return wrapped(f"{{{', '.join(map(_code, result))}}}", 2)
    return ["  {" + ",\n   ".join(f"{{{row}}}" for row in rows(result, _code)) + "}"]


class _WolframPrinter(Logic, MCodePrinter):
    """SymPy's printer, with numbers that Wolfram reads as the same double, and with Piecewise."""

    def _print_Piecewise(self, expression):
        cases = ", ".join(f"{{{self._print(e)}, {self._print(c)}}}" for e, c in expression.args)
        return f"Piecewise[{{{cases}}}]"

    def _print_BooleanTrue(self, expression):
        return "True"

    def _print_BooleanFalse(self, expression):
        return "False"

    def _print_Float(self, expression):
        mantissa, _, exponent = repr(float(expression)).partition("e")
        if "." not in mantissa:
            mantissa += "."  # 1*^-9 would be an exact fraction
        # Many digits alone would make a number of that many digits' precision.
        mark = "`" if len(mantissa) > 16 else ""
        return mantissa + mark + (f"*^{int(exponent)}" if exponent else "")


def _code(expression):
    return code(_WolframPrinter({"user_functions": dict(HEADS)}), expression)
