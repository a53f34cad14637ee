"""Wrong answers about simulation that are no known mistake: terms, methods, solvers, shapes."""

import numpy as np
import pytest
import scipy.integrate  # noqa: F401  (so that no call with a time limit pays for it)

from autograder.judging.check import HIDDEN_CASES, VISIBLE_CASES
from autograder.judging.verdict import State
from autograder.problems import CHECKS
from autograder.problems.material.systems import run
from autograder.problems.p5_state_space.mistakes import explicit
from autograder.protocol import real
from tests.autograder.problems.p5_state_space.table import drift, loop, rate, step
from tests.autograder.verdicts import judged


@pytest.mark.parametrize(
    ("check_id", "body"),
    [
        ("p5-f", rate()),
        ("p5-rk4_step", step()),
        ("p5-simulate", loop()),
        ("p5-energy_drift", drift()),
    ],
)
def test_bodies_are_right_before_they_are_spoilt(check_id, body):
    assert judged(check_id, body).state is State.CORRECT


@pytest.mark.parametrize(
    ("check_id", "body", "said"),
    [
        (
            "p5-f",
            rate("u - C @ qd - 1.1 * g - d * qd - k * np.sign(qd)"),
            "accelerations in ẋ, M⁻¹ g comes out 10 % too large.",
        ),
        (
            "p5-f",
            rate("0.5 * u - C @ qd - g - d * qd - k * np.sign(qd)"),
            "the input u is half of what it should be.",
        ),
        (
            "p5-f",
            rate("u - C @ qd - g - 3 * d * qd - k * np.sign(qd)"),
            "viscous friction is 3 times as large as it should be.",
        ),
        (
            "p5-energy_drift",
            drift(K="0.6 * qd @ M(q) @ qd"),
            "change of the kinetic energy, every value is 20 % too large.",
        ),
    ],
)
def test_unknown_error_is_sought_in_the_terms(check_id, body, said):
    (first, *_) = judged(check_id, body).diagnosis
    assert said in first


RALSTON = step(
    k2="f(x + 2 / 3 * dt * k1, u)", k3="0", k4="0", returned="x + dt / 4 * (k1 + 3 * k2)"
)


KUTTA_3 = step(
    k3="f(x + dt * (2 * k2 - k1), u)", k4="0", returned="x + dt / 6 * (k1 + 4 * k2 + k3)"
)


KUTTA = ((), (1 / 2,), (-1, 2)), (1 / 6, 2 / 3, 1 / 6)


@pytest.mark.parametrize("method", [RALSTON, KUTTA_3])
def test_unknown_method_is_told_its_order_and_no_name(method):
    for seed in range(10):
        verdict = judged("p5-rk4_step", method, seed, VISIBLE_CASES)
        (sentence,) = verdict.diagnosis
        assert "further from the exact motion than one of order 4" in sentence
        assert verdict.credit == 0.25
    verdict = judged("p5-simulate", loop(method=method))
    assert [row.met for row in verdict.rows] == [True, True, False, False, False]
    assert any("sixteenth of the error" in sentence for sentence in verdict.diagnosis)


@pytest.mark.parametrize(
    ("tolerances", "met", "said"),
    [
        ("", [True, False, False, False, False], "tolerances tight enough"),
        (", rtol=1e-8, atol=1e-10", [True, False, True, True, True], "changes inside the step"),
    ],
)
def test_solver_over_the_whole_run(tolerances, met, said):
    """Right where u is a vector and the tolerances are tight; never holds the torque."""
    verdict = judged(
        "p5-simulate",
        f"""
from scipy.integrate import solve_ivp
def rate(s, x):
    return f(x, u(s, x) if callable(u) else u)
return solve_ivp(rate, (t[0], t[-1]), x0, t_eval=t{tolerances}).y.T
""",
    )
    assert [row.met for row in verdict.rows] == met
    assert any(said in sentence for sentence in verdict.diagnosis)


def test_order_is_observed():
    check = CHECKS["p5-simulate"]
    euler = judged("p5-simulate", loop(method=step(k2="k1", k3="k1", k4="k1")))
    assert [row.met for row in euler.rows] == [True, True, False, False, False]
    observed = {}
    for name, method in (("Euler", explicit(((),), (1,))), ("Kutta 3", explicit(*KUTTA))):
        calls = check.calls(np.random.default_rng(0), HIDDEN_CASES)
        values = [run(*map(real, call.args), step=method) for call in calls]
        orders = [parts[3] for parts in check.quantities(calls, values) if parts[3].size]
        observed[name] = [float(order) for order in orders]
    assert observed["Euler"] == pytest.approx([1.0] * 4, abs=0.4)
    assert observed["Kutta 3"] == pytest.approx([3.0] * 4, abs=0.4)


@pytest.mark.parametrize(
    ("returned", "problem"),
    [
        ("states[1:]", "it must return one row for each time, and the state at t[0] is x0"),
        ("states[-1]", "one row for each time and one column for each entry of the state"),
        ("states[:, :1]", "one row for each time and one column for each entry of the state"),
    ],
)
def test_other_shapes_are_refused_with_the_shape_that_is_asked_for(returned, problem):
    verdict = judged("p5-simulate", loop(returned=returned))
    assert verdict.state is State.ERROR
    assert problem in verdict.problem


def test_doing_nothing_earns_nothing():
    """A constant keeps its energy, but is no motion."""
    assert judged("p5-simulate", "np.tile(x0, (len(t), 1))").credit == 0
    assert judged("p5-energy_drift", "np.zeros(len(x))").credit == 0
    assert judged("p5-rk4_step", "x").credit == 0
