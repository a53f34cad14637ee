"""Holds the result of a derivation: the terms of M q̈ + C q̇ + g + f = u as SymPy expressions."""

import re
import reprlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from armdyn.derive import graph
from armdyn.derive.names import refuse_shared


@dataclass(frozen=True)
class Derivation:
    """The equation of motion M(q) q̈ + C(q, q̇) q̇ + g(q) + f(q̇) = u in symbols.

    q, qd: the coordinates and velocities, n symbols each. parameters: all other symbols, those too
    that dropped out on the way (the length of the last link). M, C: (n, n), C in Christoffel form.
    g_vec: (n, 1), the gradient of P. f_vec: (n, 1), the friction, zero where not given. bias: (n, 1),
    C q̇ + g where that is known in fewer operations than C has, and None otherwise; code for q̈ is
    made of it. Units are whatever the parameters bring.
    Raises ValueError for an f_vec or a bias of another shape, for an f_vec that depends on more than q̇
    and parameters, and for two symbols of one name.

    Nothing is simplified: the expressions keep the structure in which subexpressions are shared,
    so that `sympy.cse` finds them. Where sums are nested to that end, `.doit()` flattens them.
    """

    q: tuple[sp.Symbol, ...]
    qd: tuple[sp.Symbol, ...]
    parameters: tuple[sp.Symbol, ...]
    M: sp.ImmutableMatrix
    C: sp.ImmutableMatrix
    g_vec: sp.ImmutableMatrix
    P: sp.Expr
    f_vec: sp.ImmutableMatrix = field(default=None)  # zero, set below
    bias: sp.ImmutableMatrix | None = field(default=None)

    def __post_init__(self):
        refuse_shared((*self.q, *self.qd, *self.parameters), "q, qd, parameters")
        given = sp.zeros(self.n, 1) if self.f_vec is None else self.f_vec
        object.__setattr__(self, "f_vec", _friction(given, self.n, self.qd, self.parameters))
        if self.bias is not None and getattr(self.bias, "shape", None) != (self.n, 1):
            raise ValueError(
                f"bias = {self.bias!r}: needs a matrix of shape ({self.n}, 1), or None"
            )

    def __repr__(self):
        # Written out, M, C and g of a robot would fill a book.
        q = ", ".join(s.name for s in self.q)
        parameters = ", ".join(s.name for s in self.parameters) or "none"
        return f"<Derivation in {q}; parameters: {parameters}>"

    def __getstate__(self):
        state = dict(self.__dict__)
        if self.bias is not None:
            matrices = (self.M, self.C, self.g_vec, self.bias)
            state["bias"] = graph.packed([self.P, *(e for m in matrices for e in m)])
            for name in ("M", "C", "g_vec", "P"):
                del state[name]
        return state

    def __setstate__(self, state):
        if state["bias"] is not None:
            P, *entries = graph.unpacked(state["bias"])
            n = len(state["q"])
            ends = np.cumsum([n * n, n * n, n])
            state["P"] = P
            for name, part in zip(
                ("M", "C", "g_vec", "bias"), np.split(entries, ends), strict=True
            ):
                state[name] = sp.ImmutableMatrix(n, len(part) // n, list(part))
        self.__dict__.update(state)

    @property
    def n(self) -> int:
        """The number of coordinates."""
        return len(self.q)

    def christoffel(self) -> sp.ImmutableDenseNDimArray:
        """h[i, j, k], (n, n, n), the Christoffel symbols of the first kind of M."""
        if self.bias is None:
            return christoffel_symbols(self.M, self.q)
        # C_ij = Σ_k h_ijk q̇_k.
        rows = graph.slopes(list(self.C), self.qd)
        return sp.ImmutableDenseNDimArray(rows, (self.n,) * 3)

    def inverse_dynamics_slopes(
        self, qdd: Sequence[sp.Expr]
    ) -> tuple[sp.ImmutableMatrix, sp.ImmutableMatrix]:
        """∂u/∂q and ∂u/∂q̇ of u = M q̈ + C q̇ + g + f, (n, n) each; ∂u/∂q̈ is M.

        qdd: n symbols or expressions. Raises ValueError for another number of them. sign(q̇), of
        Coulomb friction, counts as constant, as it is while the joint moves.
        """
        qdd = _listed("qdd", qdd, self.n)
        rest = self.C * sp.Matrix(self.qd) + self.g_vec if self.bias is None else self.bias
        left = self.M * sp.Matrix(qdd) + rest
        entries, back = graph.held(self.f_vec)
        friction = sp.Matrix(entries).jacobian(self.qd).xreplace(back)
        by_q, by_qd = (self.slopes(left, symbols) for symbols in (self.q, self.qd))
        return by_q, (by_qd + friction).as_immutable()

    def slopes(
        self, entries: Sequence[sp.Expr], symbols: Sequence[sp.Symbol]
    ) -> sp.ImmutableMatrix:
        """∂e_i/∂s_j of expressions of this derivation, one row each.

        Part by part where they share their parts: written out, those of a robot are long. A sign or a
        Heaviside step counts as constant, as it is but where it jumps.
        """
        entries, back = graph.held(entries)
        if self.bias is None:
            found = sp.Matrix(entries).jacobian(symbols)
        else:
            found = sp.Matrix(graph.slopes(entries, symbols))
        if back:
            found = sp.Matrix(*found.shape, graph.replaced(list(found), back))
        return found.as_immutable()

    def equations(self, qdd: Sequence[sp.Expr], u: Sequence[sp.Expr]) -> tuple[sp.Eq, ...]:
        """The n equations of motion (M q̈ + C q̇ + g + f)_i = u_i.

        qdd, u: n symbols or expressions each. Raises ValueError for another number of them.
        """
        qdd, u = (_listed(name, value, self.n) for name, value in (("qdd", qdd), ("u", u)))
        left = self.M * sp.Matrix(qdd) + self.C * sp.Matrix(self.qd) + self.g_vec + self.f_vec
        return tuple(sp.Eq(a, b, evaluate=False) for a, b in zip(left, u, strict=True))

    def with_friction(
        self, viscous: Sequence[sp.Expr] | None = None, coulomb: Sequence[sp.Expr] | None = None
    ) -> "Derivation":
        """The same model with d_i q̇_i + k_i sign(q̇_i) added to f_i; at rest sign(0) = 0.

        viscous d, coulomb k: n symbols or expressions each (N·m·s/rad and N·m at a revolute joint),
        zero where not given. They may depend on q̇ and parameters; symbols that are new become
        parameters, those of d first.
        Raises ValueError, naming the argument, for another number of them, for one that is no
        expression or depends on q, and for a new symbol with the name of another one.
        """
        zeros = [0] * self.n
        d, k = (
            _listed(name, zeros if given is None else given, self.n)
            for name, given in (("viscous", viscous), ("coulomb", coulomb))
        )
        new: list[sp.Symbol] = []
        for name, entries in (("viscous", d), ("coulomb", k)):
            for i, entry in enumerate(entries):
                if not isinstance(entry, sp.Expr) or entry.is_Matrix:
                    raise ValueError(f"{name}[{i}] = {entry}: needs a symbol or an expression")
                if on_q := (entry.free_symbols & set(self.q)) | entry.atoms(AppliedUndef):
                    raise ValueError(
                        f"{name}[{i}] = {entry}: depends on {min(on_q, key=str)}; friction is a "
                        "function of q̇ and parameters alone"
                    )
                known = {*self.qd, *self.parameters, *new}
                new += sorted(entry.free_symbols - known, key=_by_name)
        names = [s.name for s in (*self.q, *self.qd, *self.parameters, *new)]
        for symbol in new:
            if names.count(symbol.name) > 1:
                raise ValueError(
                    f"viscous, coulomb: {symbol} is not the model's own symbol {symbol.name}; use "
                    "that one, or another name"
                )
        f = [self.f_vec[i] + d[i] * v + k[i] * sp.sign(v) for i, v in enumerate(self.qd)]
        return replace(
            self, parameters=(*self.parameters, *new), f_vec=sp.ImmutableMatrix(self.n, 1, f)
        )


def derivation_given(name: str, value: object) -> Derivation:
    """The value; ValueError, naming the argument, if it is no Derivation."""
    if isinstance(value, Derivation):
        return value
    kind, has = type(value).__name__, getattr(value, "derivation", None)
    where = f"; a {kind} has one: " if has is not None else ""
    if where:
        where += "model.derivation" if isinstance(has, Derivation) else "chain.derivation()"
    raise ValueError(f"{name} = {reprlib.repr(value)}: needs a Derivation{where}")


def christoffel_symbols(M: sp.Matrix, q: Sequence[sp.Symbol]) -> sp.ImmutableDenseNDimArray:
    """h_ijk = ½ (∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i), (n, n, n): the first index is the free one.

    M: symmetric SymPy matrix, (n, n), whose upper triangle is read. q: n symbols.
    Source: R. M. Murray, Z. Li, S. S. Sastry (1994), A Mathematical Introduction to Robotic
    Manipulation, chapter 4.
    """
    n = len(q)
    upper = {(i, j): [_whole(M[i, j]).diff(x) for x in q] for i in range(n) for j in range(i, n)}

    def slope(i, j, k):
        return upper[min(i, j), max(i, j)][k]

    def symbol(i, j, k):
        return (slope(i, j, k) + slope(i, k, j) - slope(j, k, i)) / 2

    h = [[[symbol(i, j, k) for k in range(n)] for j in range(n)] for i in range(n)]
    return sp.ImmutableDenseNDimArray(h, (n, n, n))


def from_inertia(
    M: sp.Matrix,
    P: sp.Expr,
    q: Sequence[sp.Symbol],
    qd: Sequence[sp.Symbol],
    parameters: Sequence[sp.Symbol],
) -> Derivation:
    """The derivation of K = ½ q̇ᵀ M q̇ and P: C_ij = Σ_k h_ijk q̇_k and g = ∂P/∂q."""
    n = len(q)
    h = christoffel_symbols(M, q)
    C = sp.ImmutableMatrix(n, n, lambda i, j: sum(h[i, j, k] * qd[k] for k in range(n)))
    gradient = sp.ImmutableMatrix(n, 1, [_whole(P).diff(x) for x in q])
    return Derivation(tuple(q), tuple(qd), tuple(parameters), sp.ImmutableMatrix(M), C, gradient, P)


def _whole(e):
    """With sinc by its series near 0: SymPy's derivative, cos(x)/x − sin(x)/x², has a hole there."""
    if not e.has(sp.sinc):
        return e

    def sinc(x):
        series = sum((-1) ** k * x ** (2 * k) / sp.factorial(2 * k + 1) for k in range(7))
        return sp.Piecewise((sp.sin(x) / x, x**2 > sp.Rational(1, 16)), (series, True))

    return e.replace(sp.sinc, sinc)


def parameters_of(
    expressions: Iterable[sp.Expr], q: Sequence[sp.Symbol], qd: Sequence[sp.Symbol]
) -> tuple[sp.Symbol, ...]:
    """The symbols that are neither coordinates nor velocities, by name, m2 before m10."""
    found = set().union(*(e.free_symbols for e in expressions)) - set(q) - set(qd)
    return tuple(sorted(found, key=_by_name))


def _by_name(symbol):
    parts = re.split(r"(\d+)", symbol.name)
    return [(int(p), "") if p.isdigit() else (-1, p) for p in parts]


def _friction(given, n, qd, parameters):
    """f_vec as a matrix of n rows; ValueError unless it is one, of q̇ and parameters alone."""
    try:
        f = sp.ImmutableMatrix(given)
    except (TypeError, ValueError):
        f = None
    if f is None or f.shape != (n, 1):
        raise ValueError(f"f_vec = {given!r}: needs shape ({n}, 1), an entry per coordinate")
    others = (f.free_symbols - {*qd, *parameters}) | f.atoms(AppliedUndef)
    if others:
        raise ValueError(
            f"f_vec depends on {', '.join(sorted(map(str, others)))}: friction is a function of q̇ "
            "and parameters alone"
        )
    return f


def _listed(name, value, n):
    try:
        listed = list(value)
    except TypeError:
        raise ValueError(
            f"{name} = {value!r}: needs a sequence of {n}, one per coordinate"
        ) from None
    if len(listed) != n:
        raise ValueError(f"{name}: got {len(listed)} entries, needs {n}, one per coordinate")
    return [sp.sympify(entry) for entry in listed]
