"""Prints expressions as Python: for NumPy's arrays, and for one state in plain floats."""

from typing import ClassVar

import sympy as sp
from sympy.printing.numpy import NumPyPrinter
from sympy.printing.precedence import PRECEDENCE
from sympy.printing.pycode import PythonCodePrinter

from armdyn.codegen.printing import Logic, ShortFloats


class ArrayPrinter(ShortFloats, NumPyPrinter):
    """For arrays, in functions that broadcast and take a buffer for their result."""

    def __init__(self):
        super().__init__({"fully_qualified_modules": False, "strict": True})

    def _print_Pow(self, expr, rational=False, **kwargs):
        base, power = expr.as_base_exp()
        if power in (-1, 2, 3):
            text = f"({self._print(base)})"
            product = "*".join([text] * abs(int(power)))
            # In brackets, as it may come to stand below a fraction line.
            return f"(1/{text})" if power == -1 else f"({product})"
        return super()._print_Pow(expr, rational=rational)

    def _print_Add(self, expr, order=None):
        # A sum that opens with a minus costs one more pass over the arrays.
        terms = sorted(expr.args, key=lambda term: term.could_extract_minus_sign())
        text = self.parenthesize(terms[0], PRECEDENCE["Add"])
        for term in terms[1:]:
            sign = "-" if term.could_extract_minus_sign() else "+"
            size = -term if sign == "-" else term
            text += f" {sign} {self.parenthesize(size, PRECEDENCE['Mul'])}"
        return text

    def _print_Min(self, expr):
        return self._nested("minimum", expr.args)

    def _print_Max(self, expr):
        return self._nested("maximum", expr.args)

    def _print_And(self, expr):
        return self._nested("logical_and", expr.args)

    def _print_Or(self, expr):
        return self._nested("logical_or", expr.args)

    def _nested(self, function, arguments):
        text = self._print(arguments[0])
        for argument in arguments[1:]:
            text = f"{function}({text}, {self._print(argument)})"
        return text


class FloatPrinter(Logic, ArrayPrinter):
    """For plain floats: of a Piecewise only the case that holds is computed."""

    _operators: ClassVar[dict[str, str]] = {"and": "and", "or": "or", "not": "not "}
    _print_Relational = PythonCodePrinter._print_Relational

    def _print_Pow(self, expr, rational=False, **kwargs):
        if expr.exp.is_Integer or abs(expr.exp) == sp.S.Half:
            return super()._print_Pow(expr, rational=rational, **kwargs)
        # The operator would give a complex number where NumPy gives NaN.
        return f"pow({self._print(expr.base)}, {self._print(expr.exp)})"

    def _print_Piecewise(self, expr):
        *cases, (last, _) = expr.args
        text = self._print(last)
        for value, condition in reversed(cases):
            text = f"({self._print(value)} if {self._print(condition)} else {text})"
        return f"({text})"
