"""Makes NumPy callables of a derivation, with batch axes."""

import math
from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, field
from functools import cached_property, partial

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike

from armdyn.codegen import straight_line
from armdyn.codegen.buffers import in_buffers
from armdyn.codegen.numpy_printer import ArrayPrinter, FloatPrinter
from armdyn.codegen.printing import code
from armdyn.codegen.vocabulary import writable
from armdyn.derive import Derivation
from armdyn.manipulator import TERMS, Manipulator
from armdyn.parameters import finite, state_vector, state_vectors

# As many states at a time as keep every temporary in the processor's cache.
BLOCK = 8192

# A pivot of M below this, relative to its trace: close enough to singular for a careful look.
SUSPECT = 1e-11

# Coordinates up to which the second derivatives of the energies are derived.
EXACT_UP_TO = 4


def numpy_model(derivation: Derivation, values: Mapping[str, float]) -> "NumpyModel":
    """The derivation with numbers for its parameters, as a `Manipulator` in NumPy.

    values: a number for each of derivation.parameters, by name. Raises ValueError, naming the
    parameter, for a missing, unknown or non-finite one, or where a constant has no finite value,
    and for a derivation that cannot be written: see `writable`.
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
        _ = self._written

    def __reduce__(self):
        return type(self), (self.derivation, self.values)

    @property
    def n(self) -> int:  # type: ignore[override]  # read only here, and nobody writes it
        """The number of coordinates."""
        return self.derivation.n

    def M(self, q: ArrayLike) -> np.ndarray:
        """Joint-space inertia matrix, (n, n); q: (n,)."""
        return self._inertia(state_vector("q", q, self.n))

    def C(self, q: ArrayLike, qd: ArrayLike) -> np.ndarray:
        """Coriolis and centrifugal matrix in Christoffel form, (n, n); q, qd: (n,)."""
        return self._coriolis(*state_vectors(self.n, q=q, qd=qd))

    def g_vec(self, q: ArrayLike) -> np.ndarray:
        """Gravity vector ∂P/∂q, (n,); q: (n,)."""
        return self._gravity(state_vector("q", q, self.n))

    def f_vec(self, qd: ArrayLike) -> np.ndarray:
        """Friction f(q̇), (n,); qd: (n,)."""
        return self._friction(state_vector("qd", qd, self.n))

    def potential_energy(self, q: ArrayLike) -> np.ndarray:
        """Potential energy P, scalar, J; q: (n,)."""
        return self._potential(state_vector("q", q, self.n))[()]

    def dynamics(self, q: ArrayLike, qd: ArrayLike, u: ArrayLike) -> np.ndarray:
        """q̈ = M⁻¹ (u − C q̇ − g − f), (n,), by M = L D Lᵀ written out; raises as `Manipulator`.

        A subclass with another M, C, g or f moves by its own.
        """
        if not generated_terms(self):
            return super().dynamics(q, qd, u)
        states: Sequence[ArrayLike] = [q, qd, u]
        # Of plain arrays, what is not finite is left to `Manipulator` below, which names it.
        if not all(_plain(s, self.n) for s in states):
            states = state_vectors(self.n, q=q, qd=qd, u=u)
        try:
            with np.errstate(all="ignore"):
                found = self._forward(*states)
        except ValueError:  # batch axes that do not broadcast: `Manipulator` says so
            found = None
        return super().dynamics(*states) if found is None else found

    def slope_in_q(self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike) -> np.ndarray | None:
        """∂(M q̈ + C q̇ + g)/∂q, (n, n), from the derivation's own derivatives; q, qd, qdd: (n,).

        None where they would take long to derive, with more than four coordinates, and where M, C or
        g is another than the derivation's. `armdyn.linearisation` is the way to it.
        """
        if self.n > EXACT_UP_TO or not generated_terms(self):
            return None
        q, qd, qdd = state_vectors(self.n, q=q, qd=qd, qdd=qdd)
        inertia, rest = self._slopes
        by_inertia = np.einsum("...ikj,...j->...ik", inertia(q), qdd)
        return by_inertia + rest(q, qd)

    @cached_property
    def _slopes(self):
        """∂M_ij/∂q_k as (n, n, n), by i, k, j; ∂(C q̇ + g)_i/∂q_k, (n, n)."""
        d, n = self._written, self.n
        rest = d.C * sp.Matrix(d.qd) + d.g_vec if d.bias is None else d.bias
        by_q = d.slopes(list(d.M), d.q)
        entries = [by_q[i * n + j, k] for i in range(n) for k in range(n) for j in range(n)]
        inertia = self._callable("q", entries)
        inertia.shape = (n,) * 3
        return inertia, self._callable("qv", d.slopes(rest, d.q))

    @cached_property
    def _written(self):
        return writable(self.derivation, "NumPy")

    @cached_property
    def _inertia(self):
        return self._callable("q", self._written.M)

    @cached_property
    def _coriolis(self):
        return self._callable("qv", self._written.C)

    @cached_property
    def _gravity(self):
        return self._callable("q", list(self._written.g_vec))

    @cached_property
    def _friction(self):
        return self._callable("v", list(self._written.f_vec))

    @cached_property
    def _potential(self):
        return self._callable("q", self._written.P)

    @cached_property
    def _forward(self):
        program = straight_line.forward_dynamics(self._written)
        return _Callable(program, self._constants(program), "qvu", self.n, (self.n,), _regular)

    def _callable(self, arguments, expressions):
        if isinstance(expressions, sp.MatrixBase):
            shape, expressions = expressions.shape, list(expressions)
        elif isinstance(expressions, list):
            shape = (len(expressions),)
        else:
            shape, expressions = (), [expressions]
        program = straight_line.terms(self._written, expressions)
        return _Callable(program, self._constants(program), arguments, self.n, shape)

    def _constants(self, program):
        return constants(program, self.derivation, self.values)


_M, _C, _G, _F = NumpyModel.M, NumpyModel.C, NumpyModel.g_vec, NumpyModel.f_vec


def generated_terms(model: Manipulator) -> bool:
    """Whether M, C, g and f are the generated ones, whatever others could have come in their place."""
    cls = type(model)
    return (
        cls.M is _M
        and cls.C is _C
        and cls.g_vec is _G
        and cls.f_vec is _F
        and TERMS.isdisjoint(vars(model))
    )


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
        text = partial(code, FloatPrinter())
        self.on_floats = _compiled(_FLOATS, numbers, given, *_lines(program, text, _sincos_call))
        lines = _lines(program, partial(code, ArrayPrinter()), _half_angle)
        statements, results, self.buffers = in_buffers(*lines, given)
        # All cases of a Piecewise are computed, those too that are not defined there.
        self.branches = any(e.has(sp.Piecewise) for _, e in program.steps)
        self.branches |= any(e.has(sp.Piecewise) for e in program.outputs)
        given += [f"b_{i}" for i in range(self.buffers)]
        self.on_arrays = _compiled(vars(np), numbers, given, statements, results)

    def __call__(self, *states):
        batch = np.broadcast_shapes(*(s.shape[:-1] for s in states))
        with np.errstate(all="ignore") if self.branches else nullcontext():
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
            given = [r[start : start + BLOCK] if len(r) == count else r for r in rows]
            # It may not show in q̈: a sign, a minimum, a condition can hide it.
            if self.judge and not all(np.isfinite(g.sum()) for g in given):
                return None
            columns = (column for g in given for column in g.T)
            results = self.on_arrays(*columns, *buffers[:, : len(part)])
            for i in range(self.size):
                part[:, i] = results[i]
            if self.judge and not self.judge(part, *results[self.size :]):
                return None
        return found.reshape(*batch, *self.shape)

    def _one(self, states):
        numbers = [x for s in states for x in s.tolist()]
        if self.judge and not math.isfinite(sum(numbers)):
            return None
        try:
            results = self.on_floats(*numbers)
        except (ArithmeticError, ValueError):
            # Python raises an error where NumPy gives inf or NaN, or warns as the user has set it.
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


def _lines(program, text, sincos) -> tuple[list[str], list[str]]:
    """(statements, results) of the program, as Python expressions."""
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
    space = dict(names)
    exec(compile(source, "<armdyn.codegen>", "exec"), space)
    return space["with_constants"](*numbers)


_FLOATS = {
    **vars(np),
    **{name: getattr(math, name) for name in ("sqrt", "exp", "log", "sin", "cos", "tan", "pow")},
    **{name: getattr(math, name) for name in ("sinh", "cosh", "tanh", "pi", "e")},
    **{f"arc{name}": getattr(math, f"a{name}") for name in ("sin", "cos", "tan", "tan2")},
    **{f"arc{name}h": getattr(math, f"a{name}h") for name in ("sin", "cos", "tan")},
    "abs": abs,
    "minimum": min,
    "maximum": max,
    "sign": lambda x: float((x > 0) - (x < 0)),
    "floor": lambda x: float(math.floor(x)),
    "ceil": lambda x: float(math.ceil(x)),
    "sincos": lambda x: (math.sin(x), math.cos(x)),
}
