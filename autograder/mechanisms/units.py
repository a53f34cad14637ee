"""The units of energies: read from the units of coordinates and parameters, term by term."""

import re
from collections.abc import Mapping
from fractions import Fraction
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import sympy as sp

    from autograder.mechanisms.mechanism import Mechanism

# Exponents of kg, m and s. An angle is a number.
Dimension = tuple[Fraction, Fraction, Fraction]
NUMBER: Dimension = (Fraction(0), Fraction(0), Fraction(0))
ENERGY: Dimension = (Fraction(1), Fraction(2), Fraction(-2))
KNOWN = {
    "kg": (1, 0, 0),
    "m": (0, 1, 0),
    "s": (0, 0, 1),
    "rad": (0, 0, 0),
    "1": (0, 0, 0),
    "N": (1, 1, -2),
    "J": (1, 2, -2),
    "W": (1, 2, -3),
    "Hz": (0, 0, -1),
}
SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
FACTOR = re.compile(r"([A-Za-zµ°%]+|1)(?:(?:\^|\*\*)?(-?\d+))?")


class UnitError(ValueError):
    """A unit that is not known, or that does not fit; the text says which, and what is needed."""


def dimension_of(unit: str) -> Dimension:
    """The exponents of kg, m and s of a unit such as "kg·m²", "N·m/rad" or "kg/(m·s)"; no prefixes.

    UnitError for one that cannot be read.
    """
    found = NUMBER
    for name, power in _factors(unit):
        found = _times(found, tuple(map(Fraction, KNOWN[name])), power)  # type: ignore[arg-type]
    return found


def spelled(*units: str, per: str = "1") -> str:
    """A unit in the one spelling that students read, as kg·m² for "kg m^2"; of several, their product.

    per: a unit to divide by. UnitError for one that cannot be read.
    """
    powers: dict[str, int] = {}
    for unit, sign in (*((unit, 1) for unit in units), (per, -1)):
        for name, power in _factors(unit):
            powers[name] = powers.get(name, 0) + sign * power
    # Where products of units meet, kg·m and N·m are usual, and m·kg is not.
    names = sorted(powers, key=lambda name: name == "m") if len(units) > 1 else list(powers)
    above = "·".join(f"{name}{_power(powers[name])}" for name in names if powers[name] > 0)
    below = "·".join(f"{name}{_power(-powers[name])}" for name in names if powers[name] < 0)
    return _quotient(above, below)


def _factors(unit: str) -> list[tuple[str, int]]:
    """(kg, 1), (m, 2) of "kg·m²": what it is made of, and to which power."""
    plain = re.sub(r"\s*([·⋅*/()])\s*", r"\1", unit.translate(SUPERSCRIPTS).strip())
    above, *below = re.sub(r"\s+", "·", plain).split("/")
    factors = _product(unit, above)
    for part in below:
        inner = part[1:-1] if part.startswith("(") and part.endswith(")") else part
        if inner == part and re.search(r"[·*.](?!\*)", part.replace("**", "^")):
            raise UnitError(
                f"the unit {unit!r} may be read in two ways; write …/(…) for what is below"
            )
        factors += [(name, -power) for name, power in _product(unit, inner)]
    return [(name, power) for name, power in factors if name != "1"]


def _product(unit: str, text: str) -> list[tuple[str, int]]:
    factors = []
    for factor in re.split(r"[·⋅.]|(?<!\*)\*(?!\*)", text):
        match = FACTOR.fullmatch(factor)
        if match is None or match[1] not in KNOWN:
            raise UnitError(
                f"the unit {unit!r} holds {factor!r}; known are {', '.join(KNOWN)}, with · / and powers "
                "such as m² or s⁻¹"
            )
        factors.append((match[1], int(match[2] or 1)))
    return factors


def shown(dimension: Dimension) -> str:
    """The unit in words of the field: N·m² for kg·m³/s²."""
    kg, m, s = dimension
    parts = [("kg", kg), ("m", m), ("s", s)]
    if dimension == ENERGY:
        return "J"
    if kg == 1 and s == -2:
        parts = [("N", kg), ("m", m - 1)]
    above = "·".join(f"{name}{_power(p)}" for name, p in parts if p > 0)
    below = "·".join(f"{name}{_power(-p)}" for name, p in parts if p < 0)
    return _quotient(above, below)


def _quotient(above: str, below: str) -> str:
    if not below:
        return above or "1"
    return f"{above or '1'}/({below})" if "·" in below else f"{above or '1'}/{below}"


def _power(exponent: Fraction | int) -> str:
    if exponent == 1:
        return ""
    if exponent.denominator == 1:
        return str(exponent).translate(str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻"))
    return f"^({exponent})"


def dimension_in(expression: "sp.Expr", of: "Mapping[sp.Symbol, Dimension]") -> Dimension:
    """The dimension of an expression. of: that of each symbol.

    UnitError for a sum of different units, for an angle's function of a length, and for a power that is
    no number.
    """
    import sympy as sp  # only an energy's unit pays for it

    if expression.is_Symbol:
        return of[expression]
    if expression.is_number:
        return NUMBER
    inner = [dimension_in(part, of) for part in expression.args]
    if expression.is_Mul:
        found = NUMBER
        for part in inner:
            found = _times(found, part)
        return found
    if expression.is_Pow:
        base, exponent = expression.args
        if inner[1] != NUMBER or not (exponent.is_Rational or inner[0] == NUMBER):
            raise UnitError(f"{base} has the power {exponent}, which needs to be a number")
        if inner[0] == NUMBER:
            return NUMBER
        return _times(NUMBER, inner[0], Fraction(int(exponent.p), int(exponent.q)))
    if expression.is_Add or isinstance(expression, sp.Abs | sp.Max | sp.Min):
        for part, other in zip(inner[1:], expression.args[1:], strict=True):
            if part != inner[0]:
                raise UnitError(
                    f"{expression.args[0]} has the unit {shown(inner[0])}, and {other} has "
                    f"{shown(part)}: they cannot be added or compared; a number that has a unit is a "
                    "Parameter"
                )
        return inner[0]
    if isinstance(expression, sp.atan2) and inner[0] == inner[1]:
        return NUMBER
    for part, argument in zip(inner, expression.args, strict=True):
        if part != NUMBER:
            raise UnitError(
                f"{expression.func.__name__}({argument}) has an argument in {shown(part)}; it needs an "
                "angle in rad, or a number"
            )
    return NUMBER


def _times(one: Dimension, other: Dimension, power: Fraction | int = 1) -> Dimension:
    kg, m, s = (a + b * power for a, b in zip(one, other, strict=True))
    return kg, m, s


def refuse_other_than_joules(where: str, mechanism: "Mechanism") -> None:
    """ValueError for a term of K or P whose unit is not J, and for a unit that cannot be read."""
    import sympy as sp

    units = [(c.name, c.unit, c.symbol) for c in mechanism.coordinates]
    units += [(p.name, p.unit, p.symbol) for p in mechanism.parameters]
    units += [(c.name, f"{c.unit}/s", c.velocity) for c in mechanism.coordinates]
    of = {}
    for name, unit, symbol in units:
        try:
            of[symbol] = dimension_of(unit)
        except UnitError as error:
            raise ValueError(f"{where}: {name}: {error}") from None
    for energy, terms in (("K", mechanism.kinetic), ("P", mechanism.potential)):
        for term in terms:
            expression = sp.sympify(term.energy)
            try:
                found = dimension_in(expression, of)
            except UnitError as error:
                raise ValueError(f"{where}: {term.name!r} of {energy}: {error}") from None
            if found != ENERGY and expression != 0:
                raise ValueError(
                    f"{where}: {term.name!r} of {energy} has the unit {shown(found)}, an energy needs J"
                )
