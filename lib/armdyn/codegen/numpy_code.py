"""Makes NumPy callables of a derivation, with batch axes."""

import builtins
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import CodeType

import numpy as np
import sympy as sp
from sympy.printing.codeprinter import PrintMethodNotImplementedError
from sympy.printing.numpy import NumPyPrinter
from sympy.printing.precedence import PRECEDENCE

from armdyn.codegen import straight_line
from armdyn.codegen.buffers import in_buffers
from armdyn.codegen.program import ShortFloats, unknown_function
from armdyn.derive import Derivation
from armdyn.manipulator import Manipulator
from armdyn.parameters import finite, state_vector, state_vectors

# As many states at a time as keep every temporary in the processor's cache.
BLOCK = 8192

# A pivot of M below this, relative to its trace: close enough to singular for a careful look.
SUSPECT = 1e-11


def numpy_model(derivation: Derivation, values: Mapping[str, float]) -> "NumpyModel":
    """The derivation with numbers for its parameters, as a `Manipulator` in NumPy.

    values: a number for each of derivation.parameters, by name. Raises ValueError, naming the
    parameter, for a missing, unknown or non-finite one, or where a constant has no finite value,
    and for a derivation with functions that are not given.
    """
    return NumpyModel(derivation, values)


@dataclass(frozen=True, eq=False)
class NumpyModel(Manipulator):
    """M, C, g, f, P and q̈ of a derivation, as generated NumPy code.

    Every method takes leading batch axes, as those of `Manipulator`; a large batch is worked
    through in blocks that fit the cache.
    """

    derivation: Derivation = field(metadata={"doc": "what is computed"})
    values: Mapping[str, float] = field(metadata={"doc": "a number for each parameter"})

    def __post_init__(self):
        object.__setattr__(self, "values", _checked(self.derivation, self.values))
        _refuse_unknown(self.derivation)

    def __reduce__(self):
        return type(self), (self.derivation, self.values)

    @property
    def n(self) -> int:  # type: ignore[override]  # read only here, and nobody writes it
        """The number of coordinates."""
        return self.derivation.n

    def M(self, q) -> np.ndarray:
        """Joint-space inertia matrix, (n, n); q: (n,)."""
        return self._inertia(state_vector("q", q, self.n))

    def C(self, q, qd) -> np.ndarray:
        """Coriolis and centrifugal matrix in Christoffel form, (n, n); q, qd: (n,)."""
        return self._coriolis(*state_vectors(self.n, q=q, qd=qd))

    def g_vec(self, q) -> np.ndarray:
        """Gravity vector ∂P/∂q, (n,); q: (n,)."""
        return self._gravity(state_vector("q", q, self.n))

    def f_vec(self, qd) -> np.ndarray:
        """Friction f(q̇), (n,); qd: (n,)."""
        return self._friction(state_vector("qd", qd, self.n))

    def potential_energy(self, q) -> np.ndarray:
        """Potential energy P, scalar, J; q: (n,)."""
        return self._potential(state_vector("q", q, self.n))[()]

    def dynamics(self, q, qd, u) -> np.ndarray:
        """q̈ = M⁻¹ (u − C q̇ − g − f), (n,), by M = L D Lᵀ written out; raises as `Manipulator`."""
        states = [q, qd, u]
        # Plain arrays need no look before: what is not finite shows in q̈.
        if not all(_plain(s, self.n) for s in states):
            states = state_vectors(self.n, q=q, qd=qd, u=u)
        try:
            with np.errstate(all="ignore"):
                found = self._forward(*states)
        except ValueError:  # batch axes that do not broadcast: `Manipulator` says so
            found = None
        return super().dynamics(*states) if found is None else found

    @cached_property
    def _inertia(self):
        return self._callable("q", self.derivation.M)

    @cached_property
    def _coriolis(self):
        return self._callable("qv", self.derivation.C)

    @cached_property
    def _gravity(self):
        return self._callable("q", list(self.derivation.g_vec))

    @cached_property
    def _friction(self):
        return self._callable("v", list(self.derivation.f_vec))

    @cached_property
    def _potential(self):
        return self._callable("q", self.derivation.P)

    @cached_property
    def _forward(self):
        program = straight_line.forward_dynamics(self.derivation)
        return _Callable(program, self._constants(program), "qvu", self.n, (self.n,), _regular)

    def _callable(self, arguments, expressions):
        if isinstance(expressions, sp.MatrixBase):
            shape, expressions = expressions.shape, list(expressions)
        elif isinstance(expressions, list):
            shape = (len(expressions),)
        else:
            shape, expressions = (), [expressions]
        program = straight_line.terms(self.derivation, expressions)
        return _Callable(program, self._constants(program), arguments, self.n, shape)

    def _constants(self, program):
        return constants(program, self.derivation, self.values)


class _Callable:
    """Straight-line code as a function of q, v, u (those of them it takes), each (..., n).

    Gives (..., *shape), of the code's first results; or None where `judge` says no to all of them.
    The same program runs on arrays, in buffers, and with `math` on one state, which is many times
    faster on single numbers.
    """

    def __init__(self, program, numbers, arguments, n, shape, judge=None):
        self.shape, self.n, self.judge = shape, n, judge
        self.size = math.prod(shape)
        given = [f"{name}_{i}" for name in arguments for i in range(n)]
        self.on_floats = _compiled(_FLOATS, numbers, given, *_lines(program, _sincos_call))
        statements, results, self.buffers = in_buffers(*_lines(program, _half_angle), given)
        given += [f"b_{i}" for i in range(self.buffers)]
        self.on_arrays = _compiled(vars(np), numbers, given, statements, results)

    def __call__(self, *states):
        batch = np.broadcast_shapes(*(s.shape[:-1] for s in states))
        return self._many(states, batch) if batch else self._one(states)

    def _many(self, states, batch):
        count = math.prod(batch)
        rows = [
            # One row for the whole batch stays one row.
            s.reshape(-1, self.n)
            if s.size == self.n or s.shape[:-1] == batch
            else np.broadcast_to(s, (*batch, self.n)).reshape(-1, self.n)
            for s in states
        ]
        found = np.empty((count, self.size))
        # Of this call alone: another thread may be in another.
        buffers = np.empty((self.buffers, min(count, BLOCK)))
        for start in range(0, count, BLOCK):
            part = found[start : start + BLOCK]
            given = (r[start : start + BLOCK] if len(r) == count else r for r in rows)
            columns = (column for g in given for column in g.T)
            results = self.on_arrays(*columns, *buffers[:, : len(part)])
            for i in range(self.size):
                part[:, i] = results[i]
            if self.judge and not self.judge(part, *results[self.size :]):
                return None
        return found.reshape(*batch, *self.shape)

    def _one(self, states):
        try:
            results = self.on_floats(*(x for s in states for x in s.tolist()))
        except (ArithmeticError, ValueError):
            # `math` raises an error where NumPy gives inf or NaN, or warns as the user has set it.
            return self._many(states, ())
        found = np.array(results[: self.size], dtype=float)
        if self.judge and not self.judge(found, *results[self.size :]):
            return None
        return found.reshape(self.shape)


def _plain(array, n):
    return isinstance(array, np.ndarray) and array.dtype == float and array.shape[-1:] == (n,)


def _regular(accelerations, pivot, trace):
    """Whether every q̈ is finite and no M close to singular."""
    return np.isfinite(np.sum(accelerations)) and (
        np.min(pivot) > SUSPECT * np.max(trace)  # true most often, and quick to find out
        or np.all(pivot > SUSPECT * trace)
    )


def constants(program, derivation, values) -> list[float]:
    """The numbers of the program's constants; ValueError, naming the expression, if not finite."""
    names = [p.name for p in derivation.parameters]
    compute = sp.lambdify(derivation.parameters, list(program.constants), "math", cse=True)
    try:
        found = [float(c) for c in compute(*(values[name] for name in names))]
    except (ArithmeticError, ValueError, TypeError):
        found = [np.nan]
    if not np.isfinite(found).all():
        raise ValueError(f"values = {dict(values)}: a constant of the model has no finite value")
    return found


def _checked(derivation, values):
    names = [p.name for p in derivation.parameters]
    if not isinstance(values, Mapping):
        raise ValueError(f"values = {values!r}: needs a mapping of names to numbers")
    for what, odd in (
        ("needs a number for", [name for name in names if name not in values]),
        ("the derivation has no parameter", [name for name in values if name not in names]),
    ):
        if odd:
            raise ValueError(
                f"values: {what} {', '.join(map(str, odd))}; its parameters are "
                f"{', '.join(names) or 'none'}"
            )
    return {
        name: finite(f"values[{name!r}]", values[name], "the derivation's units") for name in names
    }


def _refuse_unknown(derivation):
    """ValueError for a function that has no code, now and not when it is first called."""
    parts = [*derivation.M, *derivation.C, *derivation.g_vec, *derivation.f_vec, derivation.P]
    functions = {type(f): f for part in parts for f in sp.sympify(part).atoms(sp.Function)}
    for function in functions.values():
        program = straight_line.terms(derivation, [function])
        given = [f"{name}_{i}" for name in "qv" for i in range(derivation.n)]
        numbers = [0.0] * len(program.constants)
        _compiled(_FLOATS, numbers, given, *_lines(program, _sincos_call))


class _Printer(ShortFloats, NumPyPrinter):
    def __init__(self):
        super().__init__({"fully_qualified_modules": False, "strict": True})

    def expression(self, e):
        try:
            return self.doprint(e)
        except PrintMethodNotImplementedError as error:
            name = unknown_function(error)
            raise ValueError(f"derivation: contains {name}, which NumPy does not have") from None

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

    def _nested(self, function, arguments):
        text = self._print(arguments[0])
        for argument in arguments[1:]:
            text = f"{function}({text}, {self._print(argument)})"
        return text


def _lines(program, sincos) -> tuple[list[str], list[str]]:
    """(statements, results) of the program, as Python expressions."""
    text = _Printer().expression
    lines = [f"{s} = {text(e)}" for s, e in program.angle_steps]
    for s, c, angle in program.angles:
        lines += sincos(s, c, text(angle))
    lines += [f"{s} = {text(e)}" for s, e in program.steps]
    return lines, [text(e) for e in program.outputs]


def _sincos_call(s, c, angle):
    return [f"{s}, {c} = sincos({angle})"]


def _half_angle(s, c, angle):
    """sin x and cos x from tan(x/2), which NumPy computes faster than both."""
    return [
        f"tan_{s} = tan(0.5*({angle}))",
        f"two_{c} = 2/(1 + tan_{s}*tan_{s})",
        f"{s} = tan_{s}*two_{c}",
        f"{c} = two_{c} - 1",
    ]


def _compiled(names, numbers, given, lines, results):
    """The lines as a function of what is given, with the numbers for k_0, k_1, …"""
    constants = ", ".join(f"k_{i}" for i in range(len(numbers)))
    body = "".join(f"        {line}\n" for line in lines)
    source = (
        f"def with_constants({constants}):\n"
        f"    def compute({', '.join(given)}):\n{body}        return ({', '.join(results)},)\n"
        "    return compute\n"
    )
    code = compile(source, "<armdyn.codegen>", "exec")
    if unknown := sorted(_read(code) - names.keys() - vars(builtins).keys()):
        raise ValueError(f"derivation: contains {', '.join(unknown)}, which NumPy does not have")
    space = dict(names)
    exec(code, space)
    return space["with_constants"](*numbers)


def _read(code) -> set[str]:
    """The global names that the functions defined in this code read."""
    inner = [constant for constant in code.co_consts if isinstance(constant, CodeType)]
    names = {name for function in inner for name in function.co_names}
    return names.union(*map(_read, inner))


_FLOATS = {
    **vars(np),
    **{name: getattr(math, name) for name in ("sqrt", "exp", "log", "sin", "cos", "tan")},
    **{name: getattr(math, name) for name in ("sinh", "cosh", "tanh", "pi")},
    "minimum": min,
    "maximum": max,
    "sincos": lambda x: (math.sin(x), math.cos(x)),
}
