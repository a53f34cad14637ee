"""A sine or cosine that is wrong in a term: of another angle, of another kind, or not there."""

import itertools

import sympy as sp

from autograder.mutation.operators.rewriting import Rewriting, angles, waves


def wrong_angle(term, mechanism):
    """One angle alone for a sum, a sum for one angle, a difference for a sum, another angle.

    Sums run over angles that follow each other, as links do; differences, and sums that count an angle
    twice, are of two neighbours.
    """
    turning = _turning(mechanism)
    candidates = _sums(turning)
    for a, b in itertools.pairwise(turning):
        candidates |= {a - b: f"{a} − {b}", b - a: f"{b} − {a}"}
        candidates |= {a + 2 * b: f"{a} + 2 {b}", 2 * a + b: f"2 {a} + {b}"}
    for argument in angles(term):
        for angle, name in candidates.items():
            if angle != argument:
                changes = {w: w.func(angle) for w in waves(term) if w.args[0] == argument}
                yield Rewriting("wrong angle", term.xreplace(changes), name, str(argument))


def wrong_wave(term, mechanism):
    """A cosine for a sine, or a sine for a cosine, and of another angle: as sin(q1 + q2 + π/2) is."""
    candidates = _sums(_turning(mechanism))
    other = {sp.sin: sp.cos, sp.cos: sp.sin}
    for argument in angles(term):
        of = [w for w in waves(term) if w.args[0] == argument]
        for angle, name in candidates.items():
            for sign in (1, -1) if angle != argument else ():
                changes = {w: sign * other[w.func](angle) for w in of}
                operator = "wrong wave" if sign > 0 else "wrong wave with a minus"
                yield Rewriting(operator, term.xreplace(changes), name, str(argument))


def _turning(mechanism) -> list[sp.Symbol]:
    """The coordinates that are angles."""
    return [c.symbol for c in mechanism.coordinates if c.unit == "rad"]


def _sums(turning: list[sp.Symbol]) -> dict[sp.Expr, str]:
    """Each angle, and each sum of angles that follow each other, with its name."""
    found: dict[sp.Expr, str] = {a: a.name for a in turning}
    for first, last in itertools.combinations(range(len(turning)), 2):
        chain = turning[first : last + 1]
        found[sp.Add(*chain)] = " + ".join(map(str, chain))
    return found


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


def wave_lost(term, mechanism):
    for argument in angles(term):
        changes = {w: sp.S.One for w in waves(term) if w.args[0] == argument}
        yield Rewriting("wave lost", term.xreplace(changes), "", str(argument))


def double_angle(term, mechanism):
    """Twice an angle, as where sin q cos q is taken for sin 2q."""
    for argument in angles(term):
        changes = {w: w.func(2 * argument) for w in waves(term) if w.args[0] == argument}
        yield Rewriting("double angle", term.xreplace(changes), "", str(argument))


def half_angle(term, mechanism):
    """Half of an angle."""
    for argument in angles(term):
        changes = {w: w.func(argument / 2) for w in waves(term) if w.args[0] == argument}
        yield Rewriting("half angle", term.xreplace(changes), "", str(argument))


def triple_angle(term, mechanism):
    """Three times an angle."""
    for argument in angles(term):
        changes = {w: w.func(3 * argument) for w in waves(term) if w.args[0] == argument}
        yield Rewriting("triple angle", term.xreplace(changes), "", str(argument))


def wave_power(term, mechanism):
    """A sine or cosine squared that belongs once, or once that belongs squared."""
    squares = {e for e in term.atoms(sp.Pow) if e.exp == 2 and isinstance(e.base, sp.sin | sp.cos)}
    changes = {e: e.base for e in squares}
    if not squares:
        changes = {w: w**2 for w in waves(term)}
    if changes:
        yield Rewriting("wave power", term.xreplace(changes))


def wave_without_sign(term, mechanism):
    """The size of a sine or cosine, as |sin q|."""
    changes = {w: sp.Abs(w) for w in waves(term)}
    if changes:
        yield Rewriting("wave without its sign", term.xreplace(changes))


def small_angle(term, mechanism):
    changes = {w: w.args[0] for w in term.atoms(sp.sin)}
    changes |= dict.fromkeys(term.atoms(sp.cos), sp.S.One)
    if changes:
        yield Rewriting("small angle", term.xreplace(changes))


def degrees(term, mechanism):
    for name, factor in (("radians converted", sp.pi / 180), ("angle in degrees", 180 / sp.pi)):
        changes = {w: w.func(w.args[0] * factor) for w in waves(term)}
        if changes:
            yield Rewriting(name, term.xreplace(changes))
