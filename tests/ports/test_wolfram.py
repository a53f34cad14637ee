"""The arm derived in Mathics3 is the derivation exactly, and the closed form in numbers."""

import importlib.util
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

from armdyn import Pendulum, Planar2R, ports
from armdyn.codegen import numpy_model
from armdyn.derive import from_energies
from armdyn.ports import wolfram
from armdyn.ports.wolfram.session import Session
from armdyn.simulate import simulate
from tests.ports.agreement import (
    PLANAR_2R,
    PLANAR_3R,
    RUBBING_2R,
    TOLERANCE,
    Evaluated,
    assert_agreement,
    closed_form,
    random_arm,
    random_states,
    random_values,
)

SECONDS = 300  # on a busy machine
# What Windows cannot do without, and where builds are kept.
KEPT = {"SYSTEMROOT", "APPDATA", "ARMDYN_CACHE"}
SOURCE = Path(wolfram.__file__).with_name("planar_2r.wl").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def session():
    """The arm by hand, in a Mathics3 that was started with no environment."""
    if line := ports.missing("wolfram"):
        pytest.skip(line)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ARMDYN_CACHE", str(ports.built("wolfram").parents[1]))
        for name in set(os.environ) - KEPT:
            patch.delenv(name)
        started = Session(seconds=SECONDS)
    with started:
        yield started


@pytest.fixture(
    scope="module",
    params=[RUBBING_2R, pytest.param(PLANAR_3R, marks=pytest.mark.long)],
    ids=["2R", "3R"],
)
def generated(request):
    if line := ports.missing("wolfram"):
        pytest.skip(line)
    with Session(request.param, seconds=SECONDS) as started:
        yield request.param, started


def assert_equal(found, right):
    difference = sp.Matrix([found]) - sp.Matrix([right])
    assert all(entry.doit().rewrite(sp.exp).expand() == 0 for entry in difference)


def assert_same(found, right):
    assert_equal(found.M, right.M)
    assert_equal(found.C, right.C)
    assert_equal(found.g_vec, right.g_vec)
    assert_equal(found.f_vec, right.f_vec)
    assert_equal(found.P, right.P)


def flat(arm):
    return [arm.l1, arm.l2, arm.lc1, arm.lc2, arm.m1, arm.m2, arm.I1, arm.I2, arm.g]


def assert_arms_agree(program, rows, seed):
    rng = np.random.default_rng(seed)
    arms = [random_arm(rng, friction=True) for _ in range(rows)]
    states, u = random_states(rng, rows, 2)
    parameters = [[*flat(a), *a.viscous, *a.coulomb] for a in arms]
    found = program.terms(parameters, states, u)
    names = [symbol.name for symbol in RUBBING_2R.parameters]
    values = [dict(zip(names, row, strict=True)) for row in parameters]
    sizes = Evaluated(RUBBING_2R).sizes(values, states)
    assert_agreement(found, closed_form(arms, states, u), sizes, states, u)


def test_the_derivation_by_hand_is_ours_exactly(session):
    assert_same(session.derivation(), RUBBING_2R)


def test_what_is_generated_is_the_derivation_exactly(generated):
    derivation, session = generated
    assert_same(session.derivation(), derivation)


def test_the_christoffel_symbols_are_those_of_the_course(session):
    h = session.read("christoffel")
    M, q = PLANAR_2R.M.doit(), PLANAR_2R.q
    for i in range(2):
        for j in range(2):
            for k in range(2):
                three = M[i, j].diff(q[k]) + M[i, k].diff(q[j]) - M[j, k].diff(q[i])
                assert_equal(h[i][j][k], three / 2)


def test_the_kinetic_energy_is_that_of_the_inertia_matrix(session):
    qd = sp.Matrix(PLANAR_2R.qd)
    assert_equal(session.read("kineticEnergy"), (qd.T * PLANAR_2R.M * qd)[0] / 2)


@pytest.mark.parametrize("rows", [100, pytest.param(1000, marks=pytest.mark.long)])
def test_arms_by_hand(session, rows):
    assert_arms_agree(session.program, rows, seed=1)


def test_generated_arms(generated):
    derivation, session = generated
    rng, rows = np.random.default_rng(2), 30 if derivation.n == 2 else 8
    values = [random_values(rng, derivation) for _ in range(rows)]
    states, u = random_states(rng, rows, derivation.n)
    found = session.program.terms([list(v.values()) for v in values], states, u)
    right = Evaluated(derivation)
    assert_agreement(found, right.terms(values, states, u), right.sizes(values, states), states, u)


def test_one_coordinate():
    """M is a matrix, and not a vector of one entry: LinearSolve takes no vector for it."""
    if line := ports.missing("wolfram"):
        pytest.skip(line)
    q, qd, m, lc, I, g, k = sp.symbols("q qd m lc I g k", real=True)
    pendulum = from_energies(I * qd**2 / 2, m * g * lc * (1 - sp.cos(q)), [q], [qd])
    values = {"m": 2.0, "lc": 0.5, "I": 0.7, "g": 9.81, "k": 0.3}
    arm = Pendulum(2.0, 0.5, 0.7, coulomb=0.3)
    states, u = np.array([[0.4, 1.0], [-2.0, 0.0]]), np.array([[1.0], [2.0]])
    rubbing = pendulum.with_friction(coulomb=[k])
    found = ports.run("wolfram", rubbing, states, u, values=values, seconds=SECONDS)
    right = arm.dynamics(states[:, :1], states[:, 1:], u)
    assert found.qdd == pytest.approx(right, rel=1e-14)
    assert pytest.approx(np.full((2, 1, 1), 0.7)) == found.M


def test_a_motion_by_hand(session):
    arm = Planar2R(1, 0.8, 0.5, 0.3, 2, 1.5, 0.2, 0.1, viscous=(2, 1.5), coulomb=(0.3, 0.2))
    x0, u, t = np.array([0.3, -0.8, 2.0, -1.0]), np.array([4.0, -2.0]), 1e-3 * np.arange(16)
    right = simulate(arm.state_derivative, x0, lambda t, x: u, t)
    found = session.program.simulate(
        [*flat(arm), *arm.viscous, *arm.coulomb], x0, u, t[::3], substeps=3
    )
    assert_same_motion(found, right[::3])


def test_a_generated_motion(generated):
    derivation, session = generated
    rng, n = np.random.default_rng(3), derivation.n
    values = random_values(rng, derivation)
    x0, u, t = rng.uniform(-2, 2, 2 * n), rng.uniform(-2, 2, n), 0.05 * np.arange(4)
    right = simulate(numpy_model(derivation, values).state_derivative, x0, lambda t, x: u, t)
    assert_same_motion(session.program.simulate(list(values.values()), x0, u, t), right)


def assert_same_motion(found, right):
    assert np.ptp(right, axis=0).min() > 1e-3  # it moves
    assert np.max(np.abs(found - right)) <= TOLERANCE * np.max(np.abs(right))


SIGNS = [
    ("l1 along[q1] + lc2 along[q1 + q2]", "l1 along[q1] - lc2 along[q1 + q2]"),
    ("angles = {q1, q1 + q2}", "angles = {q1, q2}"),
    ("x Cos[a - b]", "x Cos[a + b]"),
    ("- slopes[[j, k, i]]", "+ slopes[[j, k, i]]"),
    ("g masses", "-g masses"),
    ("qd + {coulomb1", "qd - {coulomb1"),
    ("u - cMatrix", "u + cMatrix"),
]


def test_a_wrong_sign_is_noticed(session):
    try:
        for line, wrong in SIGNS:
            assert SOURCE.count(line) == 1
            session.evaluate(SOURCE.replace(line, wrong))
            with pytest.raises(AssertionError, match=r"^(M|C|g_vec|f_vec|qdd|potential_energy)\b"):
                assert_arms_agree(session.program, rows=2, seed=4)
    finally:
        session.evaluate(SOURCE)
    assert_arms_agree(session.program, rows=2, seed=4)


def test_text_is_evaluated(session):
    assert session.evaluate("D[Sin[x]^2, x]") == "2*Cos[x]*Sin[x]"
    assert session.evaluate('StringLength["π"]') == "1"
    with pytest.raises(ports.ProgramError, match="SymPy does not know"):
        session.read("armless[q1]")


def test_messages_of_mathics_end_the_program():
    if line := ports.missing("wolfram"):
        pytest.skip(line)
    arm = Planar2R(1.0, 1.0, 0.5, 0.5, 2.0, 2.0, 0.2, 0.1)
    points = replace(arm, lc1=0.0, I1=0.0, I2=0.0)  # M is exactly singular where q2 = 0
    u = np.array([1.0, 0.0])
    with pytest.raises(ports.ProgramError, match="exit status 1: LinearSolve::nosol: "):
        ports.run("wolfram", [arm, points], np.zeros((2, 4)), u, seconds=SECONDS)


def test_a_missing_mathics_is_one_line(monkeypatch):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    line = ports.missing("wolfram")
    assert line == (
        "Mathics3 was not found (the Python package mathics). Debian or Ubuntu, macOS, Windows: "
        "pip install Mathics3 packaging."
    )
    with pytest.raises(ports.MissingToolError, match="pip install Mathics3"):
        ports.start("wolfram")
