"""Writes a derivation as a Java record for EJML."""

from sympy.printing.c import C89CodePrinter

from armdyn.codegen.printing import CFamily, code
from armdyn.codegen.program import ARGUMENTS, FUNCTIONS, Program, program, rows, wrapped
from armdyn.derive import Derivation

# fmt: off
KEYWORDS = {
    "abstract", "assert", "boolean", "break", "byte", "case", "catch", "char", "class", "const",
    "continue", "default", "do", "double", "else", "enum", "extends", "false", "final",
    "finally", "float", "for", "goto", "if", "implements", "import", "instanceof", "int",
    "interface", "long", "native", "new", "null", "package", "private", "protected", "public",
    "record", "return", "sealed", "short", "static", "strictfp", "super", "switch",
    "synchronized", "this", "throw", "throws", "transient", "true", "try", "var", "void",
    "volatile", "while", "yield",
}
# A record's components may not be named as the methods every object has.
METHODS = {
    "clone", "equals", "finalize", "getClass", "hashCode", "notify", "notifyAll", "toString",
    "wait",
}
FUNCTIONS_OF_MATH = {
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp", "log",
    "floor",
}
# fmt: on
RESERVED = {*KEYWORDS, *METHODS, "Math", "SimpleMatrix", *FUNCTIONS, *ARGUMENTS}


def java(derivation: Derivation, name: str = "Arm") -> str:
    """The file `name`.java (Java 16, EJML): a record of the parameters, with the equation's functions.

    M(q), C(q, qd), g_vec(q), f_vec(qd), potential_energy(q) and dynamics(q, qd, u) take and give
    SimpleMatrix columns. A name that Java reserves gets `_` added; the file's first comment says so.
    Raises ValueError for names and expressions that cannot be written: see `program`.
    """
    model = program(derivation, "Java", name, RESERVED)
    return "\n".join([*(f"// {line}" for line in model.header()), *_file(model), ""])


def _file(model: Program):
    yield from ("import org.ejml.simple.SimpleMatrix;", "", f"public record {model.name}(")
    fields = model.fields("    double {},", "//")
    yield from [*fields[:-1], *(line.replace(",", " ", 1) for line in fields[-1:])]
    yield from (") {", "  /** The inertia matrix. */")
    yield from _function("SimpleMatrix M(SimpleMatrix q)", model.M)
    yield "  /** The Coriolis and centrifugal matrix, in Christoffel form. */"
    yield from _function("SimpleMatrix C(SimpleMatrix q, SimpleMatrix qd)", model.C)
    yield "  /** The gravity vector, the gradient of the potential energy. */"
    yield from _function("SimpleMatrix g_vec(SimpleMatrix q)", model.g_vec)
    yield "  /** The friction; it opposes the motion. */"
    yield from _function("SimpleMatrix f_vec(SimpleMatrix qd)", model.f_vec)
    yield "  /** The potential energy, J. */"
    yield from _function("double potential_energy(SimpleMatrix q)", model.P)
    yield "  /** The accelerations qdd for the inputs u. */"
    yield "  public SimpleMatrix dynamics(SimpleMatrix q, SimpleMatrix qd, SimpleMatrix u) {"
    yield "    SimpleMatrix force = u.minus(C(q, qd).mult(qd)).minus(g_vec(q)).minus(f_vec(qd));"
    yield "    return M(q).solve(force);"
    yield from ("  }", "}")


def _function(head, routine):
    yield f"  public {head} {{"
    for vector, read in (("q", routine.q), ("qd", routine.qd)):
        if read:
            named = ", ".join(f"{symbol.name} = {vector}.get({i})" for i, symbol in read)
            yield from wrapped(f"double {named};", 4)
    for symbol, term in routine.steps:
        yield from wrapped(f"double {symbol.name} = {_code(term)};", 4)
    if head.startswith("double"):
        yield from wrapped(f"return {_code(routine.result)};", 4)
    else:
        yield "    return new SimpleMatrix(new double[][] {"
        yield from (f"      {{{row}}}," for row in rows(routine.result, _code))
        yield "    });"
    yield from ("  }", "")


class _JavaPrinter(CFamily, C89CodePrinter):
    """SymPy's C printer with the functions of java.lang.Math, which lacks three hyperbolic ones."""

    language = "Java"
    reserved_words: frozenset[str] = frozenset()  # what is reserved has another name by now
    _ns = "Math."
    _kf = {name: f"Math.{name}" for name in FUNCTIONS_OF_MATH} | {
        "Abs": "Math.abs",
        "ceiling": "Math.ceil",
    }

    def __init__(self):
        super().__init__({"strict": True, "math_macros": {}})

    def _print_Pi(self, _):
        return "Math.PI"

    def _print_Exp1(self, _):
        return "Math.E"

    # log1p keeps the digits of small arguments.
    def _print_asinh(self, expression):
        x = f"({self._print(expression.args[0])})"
        rest = f"{x}*{x}/(1 + Math.sqrt({x}*{x} + 1))"
        return f"(Math.signum({x})*Math.log1p(Math.abs({x}) + {rest}))"

    def _print_acosh(self, expression):
        x = f"({self._print(expression.args[0])})"
        return f"Math.log1p({x} - 1 + Math.sqrt(({x} - 1)*({x} + 1)))"

    def _print_atanh(self, expression):
        x = f"({self._print(expression.args[0])})"
        return f"(0.5*Math.log1p(2*{x}/(1 - {x})))"

    def _print_sign(self, expression):
        return f"Math.signum({self._print(expression.args[0])})"

    def _print_Max(self, expression):
        return self._nested("max", expression.args)

    def _print_Min(self, expression):
        return self._nested("min", expression.args)

    def _nested(self, function, arguments):
        first, *others = arguments
        if not others:
            return self._print(first)
        return f"Math.{function}({self._print(first)}, {self._nested(function, others)})"


def _code(expression):
    return code(_JavaPrinter(), expression)
