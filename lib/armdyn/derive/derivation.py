"""Holds the result of a derivation: the terms of M q̈ + C q̇ + g + f = u as SymPy expressions."""

import re
from dataclasses import dataclass, field, replace

import sympy as sp
from sympy.core.function import AppliedUndef


@dataclass(frozen=True)
class Derivation:
    """The equation of motion M(q) q̈ + C(q, q̇) q̇ + g(q) + f(q̇) = u in symbols.

    q, qd: the coordinates and velocities, n symbols each. parameters: all other symbols, those too
    that dropped out on the way (the length of the last link). M, C: (n, n), C in Christoffel form.
    g_vec: (n, 1), the gradient of P. f_vec: (n, 1), the friction, zero where not given. Units are
    whatever the parameters bring.
    Raises ValueError for an f_vec of another shape, or one that depends on more than q̇ and
    parameters.

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

    def __post_init__(self):
        given = sp.zeros(self.n, 1) if self.f_vec is None else self.f_vec
        object.__setattr__(self, "f_vec", _friction(given, self.n, self.qd, self.parameters))

    @property
    def n(self) -> int:
        """The number of coordinates."""
        return len(self.q)

    def christoffel(self) -> sp.ImmutableDenseNDimArray:
        """h[i, j, k], (n, n, n), the Christoffel symbols of the first kind of M."""
        return christoffel_symbols(self.M, self.q)

    def equations(self, qdd, u) -> tuple[sp.Eq, ...]:
        """The n equations of motion (M q̈ + C q̇ + g + f)_i = u_i.

        qdd, u: n symbols or expressions each. Raises ValueError for another number of them.
        """
        qdd, u = (_listed(name, value, self.n) for name, value in (("qdd", qdd), ("u", u)))
        left = self.M * sp.Matrix(qdd) + self.C * sp.Matrix(self.qd) + self.g_vec + self.f_vec
        return tuple(sp.Eq(a, b, evaluate=False) for a, b in zip(left, u, strict=True))

    def with_friction(self, viscous=None, coulomb=None) -> "Derivation":
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


def christoffel_symbols(M, q) -> sp.ImmutableDenseNDimArray:
    """h_ijk = ½ (∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i), (n, n, n): the first index is the free one.

    M: symmetric SymPy matrix, (n, n), whose upper triangle is read. q: n symbols.
    Source: R. M. Murray, Z. Li, S. S. Sastry (1994), A Mathematical Introduction to Robotic
    Manipulation, chapter 4.
    """
    n = len(q)
    upper = {(i, j): [M[i, j].diff(x) for x in q] for i in range(n) for j in range(i, n)}

    def slope(i, j, k):
        return upper[min(i, j), max(i, j)][k]

    def symbol(i, j, k):
        return (slope(i, j, k) + slope(i, k, j) - slope(j, k, i)) / 2

    h = [[[symbol(i, j, k) for k in range(n)] for j in range(n)] for i in range(n)]
    return sp.ImmutableDenseNDimArray(h, (n, n, n))


def from_inertia(M, P, q, qd, parameters) -> Derivation:
    """The derivation of K = ½ q̇ᵀ M q̇ and P: C_ij = Σ_k h_ijk q̇_k and g = ∂P/∂q."""
    n = len(q)
    h = christoffel_symbols(M, q)
    C = sp.ImmutableMatrix(n, n, lambda i, j: sum(h[i, j, k] * qd[k] for k in range(n)))
    gradient = sp.ImmutableMatrix(n, 1, [P.diff(x) for x in q])
    return Derivation(tuple(q), tuple(qd), tuple(parameters), sp.ImmutableMatrix(M), C, gradient, P)


def parameters_of(expressions, q, qd) -> tuple[sp.Symbol, ...]:
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
