"""Derives the equation of motion from kinetic and potential energy, or from a Lagrangian."""

from collections.abc import Sequence

import sympy as sp
from sympy.core.function import AppliedUndef

from armdyn.derive.derivation import Derivation, from_inertia, parameters_of
from armdyn.derive.names import refuse_shared, refuse_taken


def from_energies(
    K: sp.Expr, P: sp.Expr, q: Sequence[sp.Expr], qd: Sequence[sp.Symbol] | None = None
) -> Derivation:
    """M, C and g of K(q, q̇) = ½ q̇ᵀ M(q) q̇ and P(q), by the Euler–Lagrange equations.

    K, P: SymPy expressions (J). q: n symbols, and qd as many for the velocities; or q: n functions
    of time (`dynamicsymbols`), and K then holds their derivatives: the result has symbols instead,
    q1 and qd1 for q1(t), x and xd for x(t).
    M_ij = ∂²K/∂q̇_i∂q̇_j, C_ij = Σ_k h_ijk q̇_k with the Christoffel symbols h_ijk, g = ∂P/∂q.

    Raises ValueError, naming the term, if K is not quadratic in q̇ or has terms of lower degree,
    if P depends on q̇, or if time appears by itself; and, naming the symbol, if two symbols have one
    name, or one has the name that a coordinate or a velocity gets.
    """
    K, P = _expression("K", K), _expression("P", P)
    (K, P), q, qd = _in_symbols({"K": K, "P": P}, q, qd)
    for velocity in qd:
        if P.has(velocity) and not _vanishes(P.diff(velocity)):
            raise ValueError(
                f"P = {P}: depends on {velocity}; a potential energy is a function of q alone"
            )
    P = P.subs(dict.fromkeys(qd, 0))
    M = _hessian("K", K, qd)
    low = K.subs(dict.fromkeys(qd, 0))
    if not _vanishes(low):
        raise ValueError(
            f"K: the term {_first(low, lambda term: not _vanishes(term))} does not depend on q̇; "
            "subtract it from P instead"
        )
    return from_inertia(M, P, q, qd, parameters_of((K, P), q, qd))


def from_lagrangian(
    L: sp.Expr, q: Sequence[sp.Expr], qd: Sequence[sp.Symbol] | None = None
) -> Derivation:
    """M, C and g of L(q, q̇) = ½ q̇ᵀ M(q) q̇ − P(q): as `from_energies`, P being −L at q̇ = 0.

    Raises ValueError, naming the term, if L has a term that is neither of degree 2 in q̇ nor free
    of it, or if time appears by itself, and for names that are taken, as `from_energies`.
    """
    (L,), q, qd = _in_symbols({"L": _expression("L", L)}, q, qd)
    at_rest = L.subs(dict.fromkeys(qd, 0))
    return from_inertia(_hessian("L", L, qd), -at_rest, q, qd, parameters_of((L,), q, qd))


def _hessian(name, energy, qd):
    """The matrix of a quadratic form plus terms free of q̇; ValueError for any other energy."""
    n = len(qd)
    rest = dict.fromkeys(qd, 0)
    first = [energy.diff(v) for v in qd]
    M = sp.zeros(n, n)
    for i in range(n):
        if not _vanishes(first[i].subs(rest)):
            _refuse(name, energy, qd)
        for j in range(i, n):
            entry = first[i].diff(qd[j])
            if entry.has(*qd):
                at_rest = entry.subs(rest)
                if not _vanishes(entry - at_rest):
                    _refuse(name, energy, qd)
                entry = at_rest
            M[i, j] = M[j, i] = entry
    return M


def _refuse(name, energy, qd):
    """ValueError with the first term of the energy that is neither quadratic nor free of q̇."""
    rest = dict.fromkeys(qd, 0)

    def degree_fits(term):
        bends = [term.diff(a, b) for a in qd for b in qd]
        quadratic = not any(bend.has(*qd) for bend in bends)
        return quadratic and all(_vanishes(term.diff(v).subs(rest)) for v in qd)

    term = _first(energy, lambda term: not degree_fits(term))
    linear = all(_vanishes(term.diff(a, b)) for a in qd for b in qd)
    reason = (
        "is linear in q̇ (a gyroscopic or time-dependent term)" if linear else "is not quadratic"
    )
    raise ValueError(
        f"{name}: the term {term} {reason}; M q̈ + C q̇ + g = u needs {name} quadratic in q̇ = "
        f"({', '.join(map(str, qd))})"
    )


def _first(expression, wanted):
    terms = sp.Add.make_args(expression.expand())
    return next(filter(wanted, terms), expression)


def _vanishes(expression) -> bool:
    """Whether it is 0: at sight, expanded, or to 30 digits wherever it is tried."""
    if expression == 0:
        return True
    expression = expression.expand()
    if expression == 0:
        return True
    for trial in range(3):
        # Irrational, so that no identity holds by accident; positive, so that roots stay real.
        values = {
            s: sp.sqrt(sp.prime(7 * trial + 2 + k)) / (3 + k)
            for k, s in enumerate(sorted(expression.free_symbols, key=str))
        }
        value = expression.subs(values).evalf(30)
        if not value.is_finite or abs(value) > 1e-20:
            return False
    return True


def _expression(name, value):
    try:
        expression = sp.sympify(value)
    except sp.SympifyError:
        expression = None
    if not isinstance(expression, sp.Expr) or expression.is_Matrix:
        raise ValueError(f"{name} = {value!r}: needs a SymPy expression")
    return expression


def _in_symbols(energies, q, qd):
    """The energies, q and qd in plain symbols, whether q came as symbols or as functions of time."""
    q = _sequence("q", q)
    used = set().union(*(energy.free_symbols for energy in energies.values()))
    refuse_shared(used, " and ".join(energies))
    if q and all(isinstance(x, AppliedUndef) and len(x.args) == 1 for x in q):
        time = _time(q)
        rates = [x.diff(time) for x in q]
        if qd is not None and _sequence("qd", qd) != rates:
            raise ValueError(
                f"qd = {qd!r}: with functions of time as q, leave qd out or give {rates}"
            )
        plain, plain_rates = _plain_names(q, energies)
        # The derivatives first, while they still have a function to be derivatives of.
        found = [e.xreplace(dict(zip(rates, plain_rates, strict=True))) for e in energies.values()]
        found = [e.xreplace(dict(zip(q, plain, strict=True))) for e in found]
        energies = dict(zip(energies, found, strict=True))
        q, qd = plain, plain_rates
        _refuse_time(energies, time)
    else:
        if qd is None:
            raise ValueError(f"qd: needs {len(q)} symbols, the velocities of q = {tuple(q)}")
        qd = _sequence("qd", qd)
        for name, symbols in (("q", q), ("qd", qd)):
            if not symbols or not all(isinstance(s, sp.Symbol) for s in symbols):
                raise ValueError(
                    f"{name} = {symbols!r}: needs SymPy symbols, such as symbols('q1 q2'), or for "
                    "q functions of time, such as dynamicsymbols('q1 q2')"
                )
        if len(q) != len(qd) or len({*q, *qd}) != 2 * len(q):
            raise ValueError(
                f"q = {tuple(q)}, qd = {tuple(qd)}: needs as many velocities as coordinates, "
                "all different"
            )
        refuse_shared(used | {*q, *qd}, f"{', '.join(energies)}, q and qd")
        for name, energy in energies.items():
            functions = energy.atoms(AppliedUndef, sp.Derivative)
            if functions:
                raise ValueError(
                    f"{name}: holds {min(functions, key=str)}, while q and qd are symbols; pass the "
                    "functions of time as q"
                )
    return tuple(energies.values()), tuple(q), tuple(qd)


def _time(q):
    """The one symbol that all coordinates are functions of."""
    times = {x.args[0] for x in q}
    if len(times) > 1 or not isinstance(q[0].args[0], sp.Symbol):
        raise ValueError(f"q = {q}: needs functions of one symbol, time, such as {q[0].func}(t)")
    if len(set(q)) < len(q):
        raise ValueError(f"q = {q}: needs coordinates that are all different")
    return times.pop()


def _plain_names(q, energies):
    """Symbols for coordinates and velocities; ValueError where a name of theirs is taken."""
    coordinates = [x.func.__name__ for x in q]
    velocities = [_rate_name(name) for name in coordinates]
    instead = "pass symbols for q and qd instead of functions of time"
    given: dict[str, str] = {}
    for names, role in ((coordinates, "the coordinate"), (velocities, "the velocity of")):
        for name, x in zip(names, q, strict=True):
            if name in given:
                raise ValueError(
                    f"q = {q}: {role} {x} would be called {name}, as is {given[name]}; rename "
                    f"one of the functions, or {instead}"
                )
            given[name] = f"{role} {x}"
    for where, energy in energies.items():
        refuse_taken(given, energy.free_symbols, where, instead)
    return ([sp.Symbol(name, real=True) for name in names] for names in (coordinates, velocities))


def _refuse_time(energies, time):
    for name, energy in energies.items():
        if energy.has(time) or energy.atoms(AppliedUndef, sp.Derivative):
            raise ValueError(
                f"{name} = {energy}: depends on time other than through q and q̇; M, C and g are "
                "functions of q and q̇ alone"
            )


def _rate_name(name):
    return f"qd{name[1:]}" if name.startswith("q") else f"{name}d"


def _sequence(name, value):
    if isinstance(value, sp.Basic) and not isinstance(value, sp.Tuple):
        return [value]
    try:
        return list(value)
    except TypeError:
        raise ValueError(f"{name} = {value!r}: needs a sequence of symbols") from None
