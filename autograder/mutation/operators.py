"""The operators: what people do wrong in one term, each as a rewriting of its expressions.

The expressions are the term's energy, from which the answer is then derived, or what the right term
contributes to the answer, where somebody made the mistake later. The same rewriting of all terms at
once is a mistake too: "m1 for m2 everywhere".
"""

import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import sympy as sp

from autograder.mechanisms import Mechanism

EARTH = 9.81


@dataclass(frozen=True)
class Rewriting:
    """A wrong form of expressions. operator: its name; put, instead_of: what stands there, and should
    not.
    """

    operator: str
    expressions: sp.Tuple
    put: str = ""
    instead_of: str = ""
    entry: str = ""


Operator = Callable[[sp.Tuple, Mechanism], Iterator[Rewriting]]


def dropped(term, mechanism):
    yield Rewriting("dropped", _times(0, term))


def wrong_sign(term, mechanism):
    yield Rewriting("wrong sign", _times(-1, term))


def doubled(term, mechanism):
    yield Rewriting("doubled", _times(2, term))


def halved(term, mechanism):
    yield Rewriting("halved", _times(sp.Rational(1, 2), term))


def wrong_parameter(term, mechanism):
    """Another parameter of the same unit."""
    for parameter, other in _pairs(term, mechanism):
        wrong = term.xreplace({parameter.symbol: other.symbol})
        yield Rewriting("wrong parameter", wrong, other.name, parameter.name)


def parameter_added(term, mechanism):
    """A sum of two parameters where one stands alone, as a mass is carried along that is not."""
    for parameter, other in _pairs(term, mechanism):
        total = parameter.symbol + other.symbol
        wrong = term.xreplace({parameter.symbol: total})
        yield Rewriting("parameter added", wrong, other.name, parameter.name)


def parameters_exchanged(term, mechanism):
    for a, b in _pairs(term, mechanism):
        exchanged = term.xreplace({a.symbol: b.symbol, b.symbol: a.symbol})
        first, second = sorted((a.name, b.name))
        yield Rewriting("parameters exchanged", exchanged, first, second)


def wrong_angle(term, mechanism):
    """One angle alone for a sum, a sum for one angle, a difference for a sum, another angle.

    Sums run over angles that follow each other, as links do; differences are of two neighbours.
    """
    angles = [c.symbol for c in mechanism.coordinates if c.unit == "rad"]
    candidates = {a: a.name for a in angles}
    for a, b in itertools.pairwise(angles):
        candidates |= {a + b: f"{a} + {b}", a - b: f"{a} − {b}", b - a: f"{b} − {a}"}
    for first, last in itertools.combinations(range(len(angles)), 2):
        chain = angles[first : last + 1]
        candidates.setdefault(sp.Add(*chain), " + ".join(map(str, chain)))
    for argument in _angles(term):
        for angle, name in candidates.items():
            if angle != argument:
                changes = {w: w.func(angle) for w in _waves(term) if w.args[0] == argument}
                yield Rewriting("wrong angle", term.xreplace(changes), name, str(argument))


def sine_for_cosine(term, mechanism):
    for wave, other, name in (
        (sp.cos, sp.sin, "sine for cosine"),
        (sp.sin, sp.cos, "cosine for sine"),
    ):
        for factor in (1, -1):
            changes = {w: factor * other(w.args[0]) for w in term.atoms(wave)}
            if changes:
                put = "−" if factor < 0 else ""
                yield Rewriting(name, term.xreplace(changes), put)


def velocity_left_out(term, mechanism):
    """One velocity alone where the body turns with a sum of them."""
    for total in sorted({e for e in sp.preorder_traversal(term) if e.is_Add}, key=str):
        if total.free_symbols <= set(mechanism.qd) and sp.total_degree(total) == 1:
            for one in total.args:
                wrong = term.xreplace({total: one})
                yield Rewriting("velocity left out", wrong, str(one), str(total - one))


def wrong_velocity(term, mechanism):
    """The velocity of another joint."""
    for one in mechanism.qd:
        for other in mechanism.qd:
            if one != other and one in term.free_symbols:
                wrong = term.xreplace({one: other})
                yield Rewriting("wrong velocity", wrong, other.name, one.name)


def another_convention(term, mechanism):
    """The energy of an arm whose angle counts from another line: from the one that the angle before
    counts from, or from the link before. Velocities go with it.
    """
    if len(term) > 1:
        return  # entries, which have been derived for these coordinates already
    angles = [(c.symbol, c.velocity) for c in mechanism.coordinates if c.unit == "rad"]
    arguments = [wave.args[0] for wave in _waves(sp.Tuple(mechanism.K, mechanism.P))]
    for (before, its_rate), (angle, rate) in itertools.pairwise(angles):
        for name, sign in (("absolute angle", -1), ("relative angle", 1)):
            if not any(a.coeff(angle) == -sign * a.coeff(before) != 0 for a in arguments):
                continue  # the angle does not count so here, or the two turn about different axes
            changes = {angle: angle + sign * before, rate: rate + sign * its_rate}
            yield Rewriting(name, term.xreplace(changes), angle.name, before.name)


def about_another_point(term, mechanism):
    """An inertia to which the parallel-axis theorem was applied, wrongly, or a point mass for it."""
    for inertia in mechanism.parameters:
        if inertia.unit != "kg·m²" or inertia.symbol not in term.free_symbols:
            continue
        for mass in _beside(inertia, "kg", mechanism):
            for length in _beside(inertia, "m", mechanism):
                moved = mass.symbol * length.symbol**2
                for name, put in (
                    ("parallel axis added", inertia.symbol + moved),
                    ("parallel axis taken off", inertia.symbol - moved),
                    ("point mass", moved),
                ):
                    wrong = term.xreplace({inertia.symbol: put})
                    yield Rewriting(name, wrong, mass.name, inertia.name)
            wrong = term.xreplace({inertia.symbol: mass.symbol})
            yield Rewriting("mass for inertia", wrong, mass.name, inertia.name)


def _beside(parameter, unit, mechanism):
    """The parameters of a unit that have the same number: m2, l2 and lc2 of I2."""
    number = parameter.name[len(parameter.name.rstrip("0123456789")) :]
    for other in mechanism.parameters:
        if other.unit == unit and other.name[len(other.name.rstrip("0123456789")) :] == number:
            yield other


def square_lost(term, mechanism):
    known = {p.symbol for p in mechanism.parameters}
    known |= {c.symbol for c in mechanism.coordinates if c.unit == "m"}
    squares = [e for e in term.atoms(sp.Pow) if e.base in known and e.exp == 2]
    for square in sorted(squares, key=sp.default_sort_key):
        wrong = term.xreplace({square: square.base})
        yield Rewriting("square lost", wrong, square.base.name, f"{square.base.name}²")


def sum_of_lengths(term, mechanism):
    """A length forgotten in a sum such as r0 + s, or the sum squared part by part."""
    lengths = {p.symbol for p in mechanism.parameters if p.unit == "m"}
    lengths |= {c.symbol for c in mechanism.coordinates if c.unit == "m"}
    sums = {e for e in sp.preorder_traversal(term) if e.is_Add and e.free_symbols <= lengths}
    for total in sorted(sums, key=sp.default_sort_key):
        if not all(part.is_Symbol or (-part).is_Symbol for part in total.args):
            continue
        names = [part.free_symbols.pop().name for part in total.args]
        for part, name in zip(total.args, names, strict=True):
            yield Rewriting("length left out", term.xreplace({total: total - part}), "", name)
        squares = sp.Add(*(part**2 for part in total.args))
        yield Rewriting(
            "squared part by part", term.xreplace({total**2: squares}), " and ".join(sorted(names))
        )


def wave_lost(term, mechanism):
    for argument in _angles(term):
        changes = {w: sp.S.One for w in _waves(term) if w.args[0] == argument}
        yield Rewriting("wave lost", term.xreplace(changes), "", str(argument))


def parameter_left_out(term, mechanism):
    for parameter in mechanism.parameters:
        if parameter.symbol in term.free_symbols:
            wrong = term.xreplace({parameter.symbol: sp.S.One})
            yield Rewriting("parameter left out", wrong, "", parameter.name)


def kind_left_out(term, mechanism):
    """All masses, say, where a formula is written for bodies of 1 kg."""
    for unit in dict.fromkeys(p.unit for p in mechanism.parameters):
        there = [p.symbol for p in mechanism.parameters if p.unit == unit]
        if len(there) > 1 and term.free_symbols & set(there):
            wrong = term.xreplace(dict.fromkeys(there, sp.S.One))
            yield Rewriting("kind left out", wrong, "", unit)


def gravity_of_earth(term, mechanism):
    for parameter in mechanism.parameters:
        if parameter.unit == "m/s²" and parameter.symbol in term.free_symbols:
            wrong = term.xreplace({parameter.symbol: sp.Float(EARTH)})
            yield Rewriting("gravity of Earth", wrong, "9.81", parameter.name)


def small_angle(term, mechanism):
    changes = {w: w.args[0] for w in term.atoms(sp.sin)}
    changes |= dict.fromkeys(term.atoms(sp.cos), sp.S.One)
    if changes:
        yield Rewriting("small angle", term.xreplace(changes))


def degrees(term, mechanism):
    for name, factor in (("radians converted", sp.pi / 180), ("angle in degrees", 180 / sp.pi)):
        changes = {w: w.func(w.args[0] * factor) for w in _waves(term)}
        if changes:
            yield Rewriting(name, term.xreplace(changes))


OPERATORS: tuple[Operator, ...] = (
    dropped,
    wrong_sign,
    doubled,
    halved,
    wrong_parameter,
    parameter_added,
    parameters_exchanged,
    wrong_angle,
    sine_for_cosine,
    velocity_left_out,
    wrong_velocity,
    another_convention,
    about_another_point,
    square_lost,
    sum_of_lengths,
    wave_lost,
    parameter_left_out,
    kind_left_out,
    gravity_of_earth,
    small_angle,
    degrees,
)


def rewritings(term: sp.Tuple, mechanism: Mechanism) -> Iterator[Rewriting]:
    """All wrong forms of a term, the likeliest first; some may be equal to each other or to it."""
    for operator in OPERATORS:
        yield from operator(term, mechanism)


def astray(
    entries: sp.Tuple, names: list[str], copies: list[int], moves: bool
) -> Iterator[Rewriting]:
    """What a term contributes to one entry, in another to which it contributes nothing.

    names: of the entries. copies: for each entry the place of the one that equals it by symmetry.
    moves: also where it then lacks in the entry to which it belongs.
    """
    for target, old in enumerate(entries):
        if old != 0 or target > copies[target]:
            continue
        for source, value in enumerate(entries):
            if value == 0 or value in entries[:source]:
                continue
            wrong = list(entries)
            wrong[target] = wrong[copies[target]] = value
            yield Rewriting("astray", sp.Tuple(*wrong), names[source], "", names[target])
            if moves:
                wrong[source] = sp.S.Zero
                yield Rewriting("moved", sp.Tuple(*wrong), names[source], "", names[target])


def _times(factor, term: sp.Tuple) -> sp.Tuple:
    return sp.Tuple(*(factor * expression for expression in term))


def _waves(term: sp.Tuple) -> list[sp.Expr]:
    return sorted(term.atoms(sp.sin, sp.cos), key=sp.default_sort_key)


def _angles(term: sp.Tuple) -> list[sp.Expr]:
    return list(dict.fromkeys(wave.args[0] for wave in _waves(term)))


def _pairs(term: sp.Tuple, mechanism: Mechanism):
    """A parameter of the term, and another parameter of its unit."""
    for parameter in mechanism.parameters:
        for other in mechanism.parameters:
            there = parameter.symbol in term.free_symbols
            if there and other.unit == parameter.unit and other != parameter:
                yield parameter, other
