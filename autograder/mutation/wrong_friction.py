"""What people do wrong with friction, as formulas."""

from collections.abc import Iterator

import sympy as sp

from autograder.mechanisms import FrictionTerm, Mechanism
from autograder.mutation.friction import WORDS
from autograder.mutation.mutant import Mutant
from autograder.mutation.operators import Rewriting

# Widths of what is put for a sign that jumps.
WIDTHS = (1, sp.Rational(1, 10), sp.Rational(1, 20), sp.Rational(1, 100), sp.Rational(1, 1000))


def rewritings(term: FrictionTerm, mechanism: Mechanism) -> Iterator[Rewriting]:
    """The wrong forms of one term's torque."""
    for name, times in (("dropped", 0), ("wrong sign", -1), ("doubled", 2), ("halved", sp.S.Half)):
        yield Rewriting(name, sp.Tuple(times * term.torque))
    i = mechanism.place(term)
    q, v = mechanism.q[i], mechanism.qd[i]
    if sp.sign(v) in term.torque.atoms(sp.sign):
        yield from _of_dry(term, q, v, sp.sqrt(sum(rate**2 for rate in mechanism.qd)))
    else:
        for name, put in (
            ("quadratic friction", v * sp.Abs(v)),
            ("friction in one direction", sp.Abs(v)),
            ("sign for velocity", sp.sign(v)),
        ):
            yield Rewriting(name, sp.Tuple(term.torque.xreplace({v: put})))
    yield Rewriting("coefficient left out", sp.Tuple(term.torque.xreplace({term.symbol: sp.S.One})))
    yield Rewriting("coordinate for velocity", sp.Tuple(term.torque.xreplace({v: q})))
    for put in (*mechanism.qd, sum(mechanism.qd)):
        wrong = sp.Tuple(term.torque.xreplace({v: put}))
        yield Rewriting("wrong velocity", wrong, " + ".join(map(str, sp.Add.make_args(put))))


def _of_dry(term: FrictionTerm, q, v, speed) -> Iterator[Rewriting]:
    """The wrong forms of what has the sign of a velocity alone. speed: the length of q̇."""
    for name, put in (
        ("friction in one direction", sp.S.One),
        ("absolute value for sign", sp.Abs(v)),
        ("velocity for its sign", v),
        ("sign of the coordinate", sp.sign(q)),
        ("direction of all velocities", v / speed),
    ):
        yield Rewriting(name, sp.Tuple(term.torque.xreplace({sp.sign(v): put})))
    for name, detail, put in (
        *(("smooth sign", f"width {float(w):g}", sp.tanh(v / w)) for w in WIDTHS),
        ("friction at rest", "as if forwards", 2 * sp.Heaviside(v, 1) - 1),
        ("friction at rest", "as if backwards", 1 - 2 * sp.Heaviside(-v, 1)),
    ):
        torque = term.torque.xreplace({sp.sign(v): put})
        yield Rewriting(name, sp.Tuple(torque), detail=detail)


def _by_kind(mechanism: Mechanism) -> dict[str, list[int]]:
    """The places of the terms of each kind of friction."""
    found: dict[str, list[int]] = {}
    for k, term in enumerate(mechanism.friction):
        found.setdefault(WORDS.get(term.coefficient, "the friction"), []).append(k)
    return found


def _multiplied(mechanism: Mechanism) -> list[tuple[Mutant, dict[int, sp.Expr]]]:
    """Viscous and Coulomb friction of each joint as one product: of both, of the coefficients with the
    velocity, of the coefficients with its sign.
    """
    found: dict[str, dict[int, sp.Expr]] = {}
    for i, (first, *others) in _by_coordinate(mechanism).items():
        if not others:
            continue
        terms = [mechanism.friction[k] for k in (first, *others)]
        both = sp.Mul(*(term.symbol for term in terms))
        v = mechanism.qd[i]
        for detail, product in (
            ("", sp.Mul(*(term.torque for term in terms))),
            ("with the velocity", both * v),
            ("with its sign", both * sp.sign(v)),
        ):
            found.setdefault(detail, {}).update({first: product} | dict.fromkeys(others, sp.S.Zero))
    return [
        (Mutant("friction multiplied", "the friction", detail=detail), changes)
        for detail, changes in found.items()
    ]


def _by_coordinate(mechanism: Mechanism) -> dict[int, list[int]]:
    """The places of the terms that resist each coordinate."""
    found: dict[int, list[int]] = {}
    for k, term in enumerate(mechanism.friction):
        found.setdefault(mechanism.place(term), []).append(k)
    return found


def mistakes(mechanism: Mechanism) -> list[tuple[Mutant, dict[int, sp.Expr]]]:
    """Each with the torques of all terms, by place: made in one, in all of one kind, or in all."""
    right = {k: sp.sympify(term.torque) for k, term in enumerate(mechanism.friction)}
    found: list[tuple[Mutant, dict[int, sp.Expr]]] = []
    alike: dict[tuple[str, str, str, str], dict[int, sp.Expr]] = {}
    for k, term in enumerate(mechanism.friction):
        for done in rewritings(term, mechanism):
            (torque,) = done.expressions
            mutant = Mutant(done.operator, term.name, put=done.put, detail=done.detail)
            found.append((mutant, {k: torque}))
            words = WORDS.get(term.coefficient, "the friction")
            for kind in (words, "the friction"):
                key = (done.operator, kind, done.put, done.detail)
                alike.setdefault(key, {})[k] = torque
    all_alike = [
        (Mutant(operator, words, put=put, detail=detail), changes)
        for (operator, words, put, detail), changes in alike.items()
        if len(changes) > 1
    ]
    for kind, terms in _by_kind(mechanism).items():
        total = sum(right[k] for k in terms)
        if len(terms) > 1:
            all_alike.append((Mutant("added up", kind), dict.fromkeys(terms, total)))
    kinds = sorted({term.coefficient for term in mechanism.friction})
    swapped = {
        term.symbol: other.symbol
        for term in mechanism.friction
        for other in mechanism.friction
        if term.coordinate == other.coordinate and term != other
    }
    if len(kinds) == 2:
        all_alike += _multiplied(mechanism)
        changes = {k: torque.xreplace(swapped) for k, torque in right.items()}
        all_alike.append((Mutant("coefficients exchanged", "the friction"), changes))
    return [(mutant, right | changes) for mutant, changes in (*all_alike, *found)]
