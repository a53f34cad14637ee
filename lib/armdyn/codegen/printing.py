"""What the printers of several languages have in common, beside what they take from SymPy."""

import math
import re
from typing import ClassVar

import sympy as sp
from sympy.printing.codeprinter import CodePrinter


class ShortFloats(CodePrinter):
    """For a printer of SymPy's: the shortest decimal that reads as the same double."""

    def _print_Float(self, expression):
        return repr(float(expression))

    def _print_Integer(self, expression):
        # As an integer it would be beyond what the language's integers hold.
        value = int(expression)
        return str(value) if abs(value) < 2**31 else repr(float(value))

    def _print_Rational(self, expression):
        if max(abs(expression.p), expression.q) < 2**53:
            return super()._print_Rational(expression)
        return repr(float(expression))


class Logic(CodePrinter):
    """For a printer of SymPy's: conditions with each part in brackets."""

    _operators: ClassVar[dict[str, str]] = {"and": "&&", "or": "||", "not": "!"}

    def _print_And(self, expression):
        return self._joined("and", expression.args)

    def _print_Or(self, expression):
        return self._joined("or", expression.args)

    def _print_Not(self, expression):
        return f"{self._operators['not']}({self._print(expression.args[0])})"

    def _joined(self, name, conditions):
        return f" {self._operators[name]} ".join(f"({self._print(c)})" for c in conditions)


class CFamily(ShortFloats, Logic):
    """For SymPy's printers of C and its like: values are doubles, never int, and π is in no header."""

    double = "double"

    def _print_sign(self, expression):
        x = self._print(expression.args[0])
        x = x if expression.args[0].is_Atom else f"({x})"
        return f"{self.double}(({x} > 0) - ({x} < 0))"

    def _print_Piecewise(self, expression):
        *cases, (last, _) = expression.args
        text = self._real(last)
        for value, condition in reversed(cases):
            text = f"(({self._print(condition)}) ? {self._real(value)} : {text})"
        return text if cases else f"({text})"

    def _real(self, value):
        # An int here and one there: dividing one Piecewise by another would drop the remainder.
        return f"{int(value)}.0" if value.is_Integer else self._print(value)

    def _print_Pi(self, _):
        return repr(math.pi)

    def _print_Exp1(self, _):
        return repr(math.e)


def code(printer, expression: sp.Expr) -> str:
    """The expression on one line."""
    return re.sub(r"\s+", " ", printer.doprint(expression).replace("...\n", " ")).strip()
