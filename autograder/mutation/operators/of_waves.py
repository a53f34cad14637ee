"""A sine or cosine that is wrong in a term: of another angle, of another kind, or not there."""

import itertools

import sympy as sp

from autograder.mutation.operators.rewriting import Rewriting, angles, waves


def wrong_angle(term, mechanism):
    """One angle alone for a sum, a sum for one angle, a difference for a sum, another angle.

    Sums run over angles that follow each other, as links do; differences are of two neighbours.
    """
    turning = [c.symbol for c in mechanism.coordinates if c.unit == "rad"]
    candidates = {a: a.name for a in turning}
    for a, b in itertools.pairwise(turning):
        candidates |= {a + b: f"{a} + {b}", a - b: f"{a} − {b}", b - a: f"{b} − {a}"}
    for first, last in itertools.combinations(range(len(turning)), 2):
        chain = turning[first : last + 1]
        candidates.setdefault(sp.Add(*chain), " + ".join(map(str, chain)))
    for argument in angles(term):
        for angle, name in candidates.items():
            if angle != argument:
                changes = {w: w.func(angle) for w in waves(term) if w.args[0] == argument}
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


def wave_lost(term, mechanism):
    for argument in angles(term):
        changes = {w: sp.S.One for w in waves(term) if w.args[0] == argument}
        yield Rewriting("wave lost", term.xreplace(changes), "", str(argument))


def double_angle(term, mechanism):
    """Twice an angle, as where sin q cos q is taken for sin 2q."""
    for argument in angles(term):
        changes = {w: w.func(2 * argument) for w in waves(term) if w.args[0] == argument}
        yield Rewriting("double angle", term.xreplace(changes), "", str(argument))


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
