"""Makes NumPy callables of a derivation, with batch axes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike

from armdyn.codegen import straight_line
from armdyn.codegen.numpy_function import NumpyFunction
from armdyn.codegen.vocabulary import writable, written
from armdyn.derive import Derivation
from armdyn.derive.derivation import derivation_given
from armdyn.manipulator import TERMS, Manipulator
from armdyn.parameters import finite, state_vector, state_vectors

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
        derivation_given("derivation", self.derivation)
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

        None where they would take long to derive, with more than four coordinates, where they have no
        code, and where M, C or g is another than the derivation's. `armdyn.linearisation` is the way
        to it.
        """
        if self.n > EXACT_UP_TO or not generated_terms(self) or self._slopes is None:
            return None
        q, qd, qdd = state_vectors(self.n, q=q, qd=qd, qdd=qdd)
        inertia, rest = self._slopes
        by_inertia = np.einsum("...ikj,...j->...ik", inertia(q), qdd)
        return by_inertia + rest(q, qd)

    @cached_property
    def _slopes(self):
        """∂M_ij/∂q_k as (n, n, n), by i, k, j; ∂(C q̇ + g)_i/∂q_k, (n, n); None without code."""
        d, n = self._written, self.n
        rest = d.C * sp.Matrix(d.qd) + d.g_vec if d.bias is None else d.bias
        try:
            by_q, rest = (d.slopes(list(part), d.q) for part in (d.M, rest))
            entries = [by_q[i * n + j, k] for i in range(n) for k in range(n) for j in range(n)]
            entries, rest = (written("∂u/∂q", part, "NumPy") for part in (entries, rest))
        except ValueError:
            return None
        inertia, others = self._callable("q", entries), self._callable("qv", rest)
        inertia.shape, others.shape = (n,) * 3, (n, n)
        return inertia, others

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
        return NumpyFunction(program, self._constants(program), "qvu", self.n, (self.n,), _regular)

    def _callable(self, arguments, expressions):
        if isinstance(expressions, sp.MatrixBase):
            shape, expressions = expressions.shape, list(expressions)
        elif isinstance(expressions, list):
            shape = (len(expressions),)
        else:
            shape, expressions = (), [expressions]
        program = straight_line.terms(self._written, expressions)
        return NumpyFunction(program, self._constants(program), arguments, self.n, shape)

    def _constants(self, program):
        return constants(program, self.derivation, self.values)


_M, _C, _G, _F = NumpyModel.M, NumpyModel.C, NumpyModel.g_vec, NumpyModel.f_vec
_B = NumpyModel.bias


def generated_terms(model: Manipulator) -> bool:
    """Whether M, C, g, f and bias are the generated ones, whatever others could have come."""
    cls = type(model)
    return (
        cls.M is _M
        and cls.C is _C
        and cls.g_vec is _G
        and cls.f_vec is _F
        and cls.bias is _B
        and TERMS.isdisjoint(vars(model))
    )


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
