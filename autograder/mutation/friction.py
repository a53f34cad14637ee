"""Friction: its torques, and what people do wrong with it."""

from collections.abc import Callable, Iterator
from functools import lru_cache

import numpy as np
import sympy as sp

from autograder.mechanisms import FrictionTerm, Mechanism
from autograder.mutation.mutant import Mutant
from autograder.mutation.operators import Rewriting

# Widths of what is put for a sign that jumps.
WIDTHS = (1, sp.Rational(1, 10), sp.Rational(1, 20), sp.Rational(1, 100), sp.Rational(1, 1000))
WORDS = {"viscous": "the viscous friction", "coulomb": "the Coulomb friction"}


def rewritings(term: FrictionTerm, mechanism: Mechanism) -> Iterator[Rewriting]:
    """The wrong forms of one term's torque."""
    for name, times in (("dropped", 0), ("wrong sign", -1), ("doubled", 2), ("halved", sp.S.Half)):
        yield Rewriting(name, sp.Tuple(times * term.torque))
    i = mechanism.place(term)
    q, v = mechanism.q[i], mechanism.qd[i]
    if sp.sign(v) not in term.torque.atoms(sp.sign):
        yield Rewriting("quadratic friction", sp.Tuple(term.torque.xreplace({v: v * sp.Abs(v)})))
        return
    for name, put in (
        ("friction in one direction", sp.S.One),
        ("absolute value for sign", sp.Abs(v)),
        ("velocity for its sign", v),
        ("sign of the coordinate", sp.sign(q)),
    ):
        yield Rewriting(name, sp.Tuple(term.torque.xreplace({sp.sign(v): put})))
    for name, detail, put in (
        *(("smooth sign", f"width {float(w):g}", sp.tanh(v / w)) for w in WIDTHS),
        ("friction at rest", "as if forwards", 2 * sp.Heaviside(v, 1) - 1),
        ("friction at rest", "as if backwards", 1 - 2 * sp.Heaviside(-v, 1)),
    ):
        torque = term.torque.xreplace({sp.sign(v): put})
        yield Rewriting(name, sp.Tuple(torque), detail=detail)


def mistakes(mechanism: Mechanism) -> list[tuple[Mutant, dict[int, sp.Expr]]]:
    """Each with the torques of all terms, by place: made in one, in all of one kind, or in all."""
    right = {k: sp.sympify(term.torque) for k, term in enumerate(mechanism.friction)}
    found: list[tuple[Mutant, dict[int, sp.Expr]]] = []
    alike: dict[tuple[str, str, str], dict[int, sp.Expr]] = {}
    for k, term in enumerate(mechanism.friction):
        for done in rewritings(term, mechanism):
            (torque,) = done.expressions
            found.append((Mutant(done.operator, term.name, detail=done.detail), {k: torque}))
            words = WORDS.get(term.coefficient, "the friction")
            for kind in (words, "the friction"):
                alike.setdefault((done.operator, kind, done.detail), {})[k] = torque
    all_alike = [
        (Mutant(operator, words, detail=detail), changes)
        for (operator, words, detail), changes in alike.items()
        if len(changes) > 1
    ]
    kinds = sorted({term.coefficient for term in mechanism.friction})
    swapped = {
        term.symbol: other.symbol
        for term in mechanism.friction
        for other in mechanism.friction
        if term.coordinate == other.coordinate and term != other
    }
    if len(kinds) == 2:
        changes = {k: torque.xreplace(swapped) for k, torque in right.items()}
        all_alike.append((Mutant("coefficients exchanged", "the friction"), changes))
    return [(mutant, right | changes) for mutant, changes in (*all_alike, *found)]


@lru_cache(maxsize=64)
def torques(mechanism: Mechanism) -> Callable[..., np.ndarray]:
    """A function of q, q̇ (cases, n) and arms to the right torque of each term, (terms, cases, n)."""
    return _compiled(mechanism, [{k: term.torque} for k, term in enumerate(mechanism.friction)])


def wrong_torques(mechanism: Mechanism) -> tuple[list[Mutant], Callable[..., np.ndarray]]:
    """The mistakes, and a function to the whole friction of each, (mutants, cases, n)."""
    known = mistakes(mechanism)
    return [mutant for mutant, _ in known], _compiled(mechanism, [wrong for _, wrong in known])


def _compiled(mechanism: Mechanism, rows: list[dict[int, sp.Expr]]) -> Callable[..., np.ndarray]:
    """For each row the sum of its terms' torques, at the coordinates they resist: (rows, cases, n)."""
    terms = mechanism.friction
    n, names = mechanism.n, [p.name for p in mechanism.parameters]
    symbols = [*mechanism.q, *mechanism.qd, *(p.symbol for p in mechanism.parameters)]
    symbols += [term.symbol for term in terms]
    entries = [
        sp.Add(*(torque for k, torque in row.items() if mechanism.place(terms[k]) == i))
        for row in rows
        for i in range(n)
    ]
    compute = sp.lambdify(symbols, entries, modules="numpy", cse=True)

    def function(q, qd, arms) -> np.ndarray:
        columns = [*np.transpose(q), *np.transpose(qd)]
        columns += [np.array([getattr(arm, name) for arm in arms]) for name in names]
        columns += [
            np.array([getattr(arm, term.coefficient)[mechanism.place(term)] for arm in arms])
            for term in terms
        ]
        values = [np.broadcast_to(value, len(q)) for value in compute(*columns)]
        return np.moveaxis(np.reshape(values, (len(rows), n, len(q))), 1, -1)

    return function
