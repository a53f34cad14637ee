"""Says which expressions can be written as code, and puts others in that form where one equals it."""

from collections.abc import Callable
from dataclasses import dataclass, field, fields, replace

import sympy as sp
from sympy.codegen import cfunctions
from sympy.core.function import AppliedUndef
from sympy.functions.elementary.piecewise import ExprCondPair
from sympy.logic.boolalg import Boolean, BooleanFunction

from armdyn.derive import Derivation

LONGEST = 120

# What every language here has, in a library or in words of its own.
COMMON = {
    *(sp.sin, sp.cos, sp.tan, sp.asin, sp.acos, sp.atan, sp.atan2),
    *(sp.sinh, sp.cosh, sp.tanh, sp.asinh, sp.acosh, sp.atanh),
    *(sp.exp, sp.log, sp.Abs, sp.sign, sp.floor, sp.ceiling, sp.Max, sp.Min),
}
_GAMMA = {sp.erf, sp.erfc, sp.gamma, sp.loggamma}
_BESSEL = {sp.besselj, sp.bessely, sp.besseli, sp.besselk}
MORE = {
    "C++": _GAMMA,
    "MATLAB": _GAMMA | _BESSEL,
    "Wolfram": _GAMMA | _BESSEL | {sp.zeta},
}

# What a model's parts are called, and may depend on besides parameters; other parts on all.
_PARTS = {"g_vec": "g", "f_vec": "f"}
_READS = {"M": ("q",), "g_vec": ("q",), "P": ("q",), "f_vec": ("qd",)}

# All symbols stand for real numbers.
_EQUAL: dict[type, Callable[..., sp.Expr]] = {
    sp.re: lambda x: x,
    sp.im: lambda x: sp.S.Zero,
    sp.conjugate: lambda x: x,
    sp.UnevaluatedExpr: lambda x: x,
    sp.cot: lambda x: 1 / sp.tan(x),
    sp.sec: lambda x: 1 / sp.cos(x),
    sp.csc: lambda x: 1 / sp.sin(x),
    sp.coth: lambda x: 1 / sp.tanh(x),
    sp.sech: lambda x: 1 / sp.cosh(x),
    sp.csch: lambda x: 1 / sp.sinh(x),
    sp.acot: lambda x: sp.atan(1 / x),
    sp.asec: lambda x: sp.acos(1 / x),
    sp.acsc: lambda x: sp.asin(1 / x),
    sp.acoth: lambda x: sp.atanh(1 / x),
    sp.asech: lambda x: sp.acosh(1 / x),
    sp.acsch: lambda x: sp.asinh(1 / x),
    sp.sinc: lambda x: sp.Piecewise((sp.sin(x) / x, sp.Ne(x, 0)), (1, True)),
    sp.frac: lambda x: x - sp.floor(x),
    sp.Mod: lambda x, y: x - y * sp.floor(x / y),
    # As the derivative of Max has it, Heaviside(0) = ½.
    sp.Heaviside: lambda x, middle: (
        (1 + sp.sign(x)) / 2
        if middle == sp.S.Half
        else sp.Piecewise((0, x < 0), (1, x > 0), (middle, True))
    ),
}
_KNOWN_BY_EXPANSION = tuple(
    getattr(cfunctions, name)
    for name in ("expm1", "log1p", "exp2", "log2", "log10", "Sqrt", "Cbrt", "hypot", "fma")
)
_CONDITIONS = (sp.And, sp.Or, sp.Not, sp.Eq, sp.Ne, sp.Lt, sp.Le, sp.Gt, sp.Ge)


def writable(derivation: Derivation, language: str) -> Derivation:
    """The derivation with the same values, in nodes that a printer for the language writes.

    Raises ValueError, naming the part, the node and the language, for a node that has no code
    there, and for a part that depends on what its function is not given.
    """
    writing = _Writing(language)
    written = {}
    for part in (f.name for f in fields(derivation)):
        expression = getattr(derivation, part)
        if isinstance(expression, sp.MatrixBase):
            entries = [writing(part, e) for e in expression]
            written[part] = sp.ImmutableMatrix(*expression.shape, entries)
        elif isinstance(expression, sp.Basic | int | float):
            entries = [writing(part, sp.sympify(expression))]
            written[part] = entries[0]
        else:
            continue
        _refuse_unknown_symbols(derivation, part, entries)
    return replace(derivation, **written)


def written(name: str, expressions, language: str) -> list[sp.Expr]:
    """The expressions as `writable` has them; its ValueError says `name`."""
    writing = _Writing(language)
    return [writing(name, e) for e in expressions]


@dataclass
class _Writing:
    """Rewrites expressions, each node once, however often it is shared."""

    language: str
    part: str = ""
    known: dict = field(default_factory=dict)

    def __call__(self, part, expression):
        self.part = _PARTS.get(part, part)
        return self._value(expression)

    def _value(self, e):
        if e not in self.known:
            self.known[e] = self._rewritten(e)
        return self.known[e]

    def _rewritten(self, e):
        if isinstance(e, sp.Symbol):
            return e
        if isinstance(e, sp.Number | sp.NumberSymbol):
            return self._number(e)
        if isinstance(e, sp.Piecewise):
            return self._piecewise(e)
        if isinstance(e, sp.Add):
            return self._sum(e, [self._value(a) for a in e.args])
        if isinstance(e, sp.Mul | sp.Pow) or type(e) in COMMON | MORE.get(self.language, set()):
            return self._rebuilt(e, [self._value(a) for a in e.args])
        if isinstance(e, sp.Derivative | sp.Subs):
            # That of re(x), say, which SymPy leaves open while x might be complex.
            return self._equal(e, e.func(self._value(e.expr), *e.args[1:]).doit())
        if type(e) in _EQUAL:
            return self._equal(e, _EQUAL[type(e)](*map(self._value, e.args)))
        if isinstance(e, _KNOWN_BY_EXPANSION):
            return self._equal(e, e.expand(func=True))
        if isinstance(e, sp.Expr) and e.is_number and isinstance(value := e.evalf(20), sp.Float):
            return self._number(value)  # ζ(3), say
        raise self._error(e)

    def _equal(self, e, equal):
        """What e, of which there is no code, is equal to."""
        if equal == e:
            raise self._error(e)
        return self._value(equal)

    def _rebuilt(self, e, arguments):
        if _same(arguments, e.args) and not all(a.is_Rational for a in arguments):
            return e
        rebuilt = e.func(*arguments)
        return rebuilt if isinstance(rebuilt, type(e)) else self._value(rebuilt)

    def _sum(self, e, arguments):
        if _same(arguments, e.args):
            return e
        # Sums stay nested, as the derivation keeps them: flattened, they would no longer share.
        kept = [a for a in arguments if a != 0]
        return sp.Add(*kept, evaluate=False) if len(kept) > 1 else sum(kept, sp.S.Zero)

    def _number(self, e):
        try:
            finite = e.is_real and abs(float(e)) < float("inf")
        except (OverflowError, TypeError):
            finite = False
        if not finite:
            raise self._error(e, "needs finite real numbers, within the range of doubles")
        if isinstance(e, sp.NumberSymbol) and e not in (sp.pi, sp.E):
            return sp.Float(e.evalf(20), 20)
        return e

    def _piecewise(self, e):
        if e.args[-1].cond != sp.true:
            raise self._error(e, "needs a last case (…, True)")
        cases = [
            ExprCondPair(self._value(case.expr), self._condition(case.cond)) for case in e.args
        ]
        # Of a condition on a Piecewise, such as sinc, SymPy has made an ITE of conditions here.
        cases = [(case.expr, self._condition(case.cond)) for case in cases]
        chosen = sp.Piecewise(*cases)
        return chosen if isinstance(chosen, sp.Piecewise) else self._value(chosen)

    def _condition(self, c):
        if c in (sp.true, sp.false):
            return c
        if isinstance(c, sp.core.relational.Relational) and isinstance(c, _CONDITIONS):
            return c.func(*map(self._value, c.args))
        if isinstance(c, _CONDITIONS):
            return c.func(*map(self._condition, c.args))
        if isinstance(c, BooleanFunction):
            return self._condition(c.to_nnf(simplify=False))
        raise self._error(c)

    def _error(self, e, needs=""):
        if not needs:
            needs = f"it has no {type(e).__name__}"
            if isinstance(e, sp.DiracDelta):
                needs = (
                    "it is the slope of a jump, of sign or Heaviside; write the energy without a jump, "
                    "with Abs or Piecewise, as Abs(x) for x*sign(x)"
                )
            if isinstance(e, AppliedUndef | sp.Derivative | sp.Subs | sp.Integral):
                needs = "needs functions whose values are known"
            elif isinstance(e, Boolean):
                needs = "a condition is no number; needs it in a Piecewise"
        node = str(e) if len(str(e)) <= LONGEST else f"{str(e)[:LONGEST]}…"
        return ValueError(
            f"{self.part} contains {node}, which cannot be written in {self.language}: {needs}"
        )


def _same(these, those):
    return all(a is b for a, b in zip(these, those, strict=True))


def _refuse_unknown_symbols(derivation, part, entries):
    reads = _READS.get(part, ("q", "qd"))
    given = {*derivation.parameters, *(s for vector in reads for s in getattr(derivation, vector))}
    unknown = _symbols(entries) - given
    if unknown:
        raise ValueError(
            f"{_PARTS.get(part, part)} depends on {', '.join(sorted(s.name for s in unknown))}: "
            f"needs {', '.join(reads)} and parameters only"
        )


def _symbols(expressions) -> set[sp.Symbol]:
    """The symbols in the expressions, each node looked at once."""
    waiting, seen = list(expressions), set()
    while waiting:
        e = waiting.pop()
        if e not in seen:
            seen.add(e)
            waiting += e.args
    return {e for e in seen if isinstance(e, sp.Symbol)}
