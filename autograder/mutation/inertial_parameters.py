"""The inertial parameters π of a mechanism: what its energies are linear in.

C. G. Atkeson, C. H. An, J. M. Hollerbach (1986), Estimation of Inertial Parameters of Manipulator Loads
and Links, for links in space; here they are read off the energies.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import sympy as sp

from autograder.mechanisms import EnergyTerm, Mechanism, Parameter
from autograder.mechanisms.units import spelled

# Behind the name of a mechanism whose parameters are these.
IN_PI = "-in-pi"


@dataclass(frozen=True)
class InertialParameter:
    """An entry of π: a sum of products of the parameters that are to be found, as I1 + m1·lc1²."""

    value: sp.Expr
    unit: str
    words: str


@lru_cache(maxsize=64)
def inertial_parameters(mechanism: Mechanism) -> tuple[InertialParameter, ...]:
    """π, in the order of the mechanism's parameters. Products that always come together are one."""
    of: dict[sp.Expr, list[sp.Expr]] = {}
    for term in (*mechanism.kinetic, *mechanism.potential):
        sign = 1 if term in mechanism.kinetic else -1
        for product, beside in _products(mechanism, term):
            of.setdefault(product, []).append(sign * beside)
    sums: dict[sp.Expr, sp.Expr] = {}
    for product, parts in of.items():
        function = sp.expand(sp.Add(*parts))
        sums[function] = sums.get(function, sp.S.Zero) + product
    order = {p.symbol: k for k, p in enumerate(mechanism.parameters)}
    known = sorted(sums.values(), key=lambda value: max(order[s] for s in value.free_symbols))
    return tuple(
        InertialParameter(value, _unit(mechanism, value), _words(mechanism, value))
        for value in known
    )


@lru_cache(maxsize=64)
def in_inertial_parameters(mechanism: Mechanism) -> Mechanism:
    """The same mechanism, its energies linear in π: pi1, pi2, … for what is to be found."""
    entries = inertial_parameters(mechanism)
    new = [
        Parameter(f"pi{k}", pi.unit, pi.words, 0.5, 2.0, to_find=True)
        for k, pi in enumerate(entries, 1)
    ]
    # One product stands for all of an entry, as they always come together: I1 for I1 + m1·lc1².
    place = {
        min(sp.Add.make_args(pi.value), key=lambda part: (len(part.free_symbols), str(part))): k
        for k, pi in enumerate(entries)
    }

    def rewritten(terms: tuple[EnergyTerm, ...]) -> tuple[EnergyTerm, ...]:
        found: dict[tuple[str, int], sp.Expr] = {}
        for term in terms:
            for product, beside in _products(mechanism, term):
                if product not in place:
                    continue
                found[term.name, place[product]] = beside + found.get(
                    (term.name, place[product]), 0
                )
        often = [name for name, _ in found]
        return tuple(
            EnergyTerm(
                name if often.count(name) == 1 else f"{name} ({new[k].doc})", energy * new[k].symbol
            )
            for (name, k), energy in found.items()
        )

    return replace(
        mechanism,
        name=f"{mechanism.name}{IN_PI}",
        parameters=(*(p for p in mechanism.parameters if p.known), *new),
        kinetic=rewritten(mechanism.kinetic),
        potential=rewritten(mechanism.potential),
        points=lambda q, arm: [(0.0, 0.0)],
        friction=(),
        draws=None,
    )


def _products(mechanism: Mechanism, term: EnergyTerm) -> list[tuple[sp.Expr, sp.Expr]]:
    """The products of parameters to be found in a term, each with what stands beside it."""
    unknown = [p.symbol for p in mechanism.parameters if not p.known]
    terms = sp.Poly(sp.expand(term.energy), *unknown).terms()
    products = [
        (sp.Mul(*(s**k for s, k in zip(unknown, powers, strict=True))), beside)
        for powers, beside in terms
    ]
    return [(product, beside) for product, beside in products if product != 1]


def _unit(mechanism: Mechanism, value: sp.Expr) -> str:
    """Of its first product: kg·m of m1·lc1."""
    units = {p.symbol: p.unit for p in mechanism.parameters}
    product = sp.Add.make_args(value)[0]
    factors = product.as_powers_dict().items()
    return spelled(*(units[s] for s, k in factors for _ in range(int(k))))


def _words(mechanism: Mechanism, value: sp.Expr) -> str:
    """As people write it: I1 + m1·lc1²."""
    lengths = {p.symbol for p in mechanism.parameters if p.unit == "m"}

    def product(factors: sp.Expr) -> str:
        powers = sorted(
            factors.as_powers_dict().items(), key=lambda at: (at[0] in lengths, str(at[0]))
        )
        return "·".join(f"{s}²" if k == 2 else f"{s}" if k == 1 else f"{s}^{k}" for s, k in powers)

    return " + ".join(sorted(product(part) for part in sp.Add.make_args(value)))
