"""What holds of the drawn numbers holds of real mechanisms, and the other way round."""

from dataclasses import replace
from functools import cache
from unittest.mock import patch

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.mechanisms import MECHANISMS
from autograder.proofs import DERIVATIONS, mark, marking
from autograder.proofs.energy import CHAIN, FREE, SYMMETRY, WITH_FRICTION, N
from autograder.proofs.parsing import relation_and_sides
from autograder.proofs.subject import WORLDS, World
from autograder.protocol import handed_in
from tests.autograder.proofs.models import models

MOVING = ("planar-2r", "planar-3r", "cart-pole", "furuta", "spherical-pendulum", "slider-crank")
SEEDS = st.integers(0, 2**32 - 1)


@cache
def jets(name: str):
    """P, ∂P/∂q, M, ∂M/∂q_k of a mechanism, as a function of its symbols' numbers."""
    mechanism = MECHANISMS[name]
    M = sp.hessian(mechanism.K, mechanism.qd)
    slopes = [M.diff(q) for q in mechanism.q]
    gradient = [mechanism.P.diff(q) for q in mechanism.q]
    symbols = [*mechanism.q, *(p.symbol for p in mechanism.parameters)]
    return sp.lambdify(symbols, [mechanism.P, gradient, M, slopes], cse=True)


def drawn(name: str):
    """Draws what `energy.draw` draws, of a real mechanism in random states."""
    mechanism = MECHANISMS[name]

    def draw(rng, given):
        states = []
        for _ in range(WORLDS):
            q, qd = mechanism.placed(rng), mechanism.moving(rng)
            P, gradient, M, slopes = jets(name)(*q, *vars(mechanism.drawn(rng)).values())
            dM = np.array(slopes, dtype=float)
            Mdot = np.einsum("kij,k->ij", dM, qd)
            W = np.einsum("jik,k->ij", dM, qd)
            n = mechanism.n
            states.append(
                {
                    "qd": qd, "qdd": rng.normal(size=n), "z": rng.normal(size=n), "u": np.zeros(n),
                    "g": np.zeros(n), "f": rng.normal(size=n), "dPdq": np.array(gradient, dtype=float),
                    "P": P, "K": 0.0, "E": 0.0, "Pdot": 0.0, "M": np.array(M, dtype=float),
                    "Mdot": Mdot, "W": W, "C": np.zeros((n, n)),
                }
            )  # fmt: skip
        return {key: stacked([state[key] for state in states]) for key in states[0]}

    return draw


def stacked(values) -> np.ndarray:
    made = np.array(values, dtype=float)
    return made.reshape(*made.shape, *[1] * (3 - made.ndim))


@pytest.mark.parametrize("name", MOVING)
@settings(max_examples=5, deadline=None)
@given(SEEDS)
def test_the_energy_proofs_hold_on_every_mechanism(name, seed):
    for id, subject in (("p2-E", FREE), ("p2-skew", FREE), ("p5-E", WITH_FRICTION)):
        real = replace(subject, draw=drawn(name))
        world = World(real, np.random.default_rng(seed), (subject.everything,), subject.truth)
        start = world.value(subject.parser.read(DERIVATIONS[id].start))
        for text, *_ in models()[id]:
            value = world.value(subject.parser.read(relation_and_sides(text)[2]))
            difference = abs(value.numbers - start.numbers)
            assert (difference <= 1e-10 * (value.size + start.size)).all(), text


@pytest.mark.parametrize("name", MOVING)
def test_the_false_facts_are_false_on_real_mechanisms(name):
    """Else a student's step would be called a mistake although it is right."""
    real = replace(FREE, draw=drawn(name))
    world = World(real, np.random.default_rng(1), (FREE.everything,), FREE.truth)
    for zero in ("Mdot", "C + C'", "Mdot - C"):
        assert abs(world.value(FREE.parser.read(zero)).numbers).max() > 1e-6, zero


@given(SEEDS)
@settings(max_examples=20, deadline=None)
def test_drawn_mechanisms_have_the_jets_of_mechanisms(seed):
    numbers = FREE.draw(np.random.default_rng(seed), frozenset({SYMMETRY, CHAIN}))
    M, Mdot, W, qd = (numbers[name] for name in ("M", "Mdot", "W", "qd"))
    assert M.shape == (WORLDS, N, N)
    assert np.linalg.eigvalsh(M).min() > 0
    np.testing.assert_allclose(Mdot, np.swapaxes(Mdot, 1, 2))
    # Both are Σ ∂M_ik/∂q_j q̇_j q̇_k.
    np.testing.assert_allclose(W @ qd, Mdot @ qd, rtol=1e-9, atol=1e-9)


TRUE = [
    ("qd' M qdd", "qdd' M qd", "symmetry of M"),
    ("Pdot", "qd' dPdq", "chain rule"),
    ("d/dt(M qd)", "Mdot qd + M qdd", "product rule"),
    ("2 C", "Mdot + W - W'", "Christoffel symbols"),
    ("qd' (Mdot - 2 C) qd", "0", "skew-symmetry"),
    ("u - g", "M qdd + C qd", "equation of motion"),
    ("d/dt(M^-1 g)", "-M^-1 Mdot M^-1 g + M^-1 d/dt(g)", "product rule"),
]
SCALARS = ("K", "qd' g", "u' C qdd", "P^2", "g' M^-1 u")


@given(st.sampled_from(TRUE), st.sampled_from(SCALARS), st.integers(1, 9), SEEDS)
@settings(max_examples=60, deadline=None)
def test_a_true_step_holds_in_any_dress_and_a_false_one_in_none(step, scalar, factor, seed):
    before, after, reason = step
    rng = np.random.default_rng(seed)
    dress = rng.choice(["{f} ({x})", "({x})' {f}", "({x}) ({s})", "{f} ({x}) / {f}"])
    one, other = (dress.format(x=x, s=scalar, f=factor) for x in (before, after))
    assert stepped(one, other, reason) == ""
    broken = rng.choice(["{x} + {f} {s} ({y})", "2 ({x})", "({x}) - ({y})"])
    false = broken.format(x=other, y=one, s=scalar, f=factor)
    if after != "0":
        assert stepped(one, false, reason) != ""


def stepped(before: str, after: str, reason: str) -> str:
    started = replace(DERIVATIONS["p2-E"], start=before, to_prove=(), mistakes=())
    given = handed_in([(f"= {after}", reason)])
    with patch.object(marking, "MOST_DIAGNOSED", 0):  # why a line does not hold takes the time
        return mark(started, given, np.random.default_rng(5)).lines[0].said
