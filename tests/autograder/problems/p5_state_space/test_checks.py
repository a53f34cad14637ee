"""What only p5-state-space asks: methods, their order and energy, and solvers over a whole run."""

import numpy as np
import pytest

from autograder.judging.check import HIDDEN_CASES, VISIBLE_CASES
from autograder.judging.verdict import State
from autograder.problems import CHECKS
from autograder.problems.material.systems import (
    METHOD,
    FreeRun,
    exact_run,
    fitted,
    free_runs,
    run,
    smooth,
)
from autograder.problems.p5_state_space.checks import LEAST_ORDER
from autograder.problems.p5_state_space.step_mistakes import METHODS, explicit
from autograder.protocol import real
from tests.autograder.course_problems import problem
from tests.autograder.problems.p5_state_space.right import held_ivp
from tests.autograder.problems.p5_state_space.table import drift, loop, rate, step
from tests.autograder.verdicts import judged, judged_in

PROBLEM = problem("p5-state-space")
RALSTON = step(
    k2="f(x + 2 / 3 * dt * k1, u)", k3="0", k4="0", returned="x + dt / 4 * (k1 + 3 * k2)"
)
KUTTA_3 = step(
    k3="f(x + dt * (2 * k2 - k1), u)", k4="0", returned="x + dt / 6 * (k1 + 4 * k2 + k3)"
)
KUTTA = explicit(((), (1 / 2,), (-1, 2)), (1 / 6, 2 / 3, 1 / 6))
LOW_ORDER = [KUTTA, *(mistake.wrong for mistake in METHODS)]


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


@pytest.mark.parametrize("step", LOW_ORDER, ids=["Kutta 3", *(m.name for m in METHODS)])
def test_methods_of_lower_order_never_pass(step):
    of_step = {"rk4_step": step}
    of_run = {"simulate": lambda *args: run(*args, step=step)}
    for seed in range(4):
        assert not judged_in(of_step, "p5-rk4_step", seed, VISIBLE_CASES).rows[1].met
        rows = judged_in(of_run, "p5-simulate", seed, VISIBLE_CASES).rows
        assert [row.met for row in rows[2:]] == [False, False, False]


def test_steps_are_fitted_to_the_error_of_rk4():
    """What the tolerances rest on: RK4 leaves METHOD, and its order is seen where steps are halved."""
    rng = np.random.default_rng(5)
    for _ in range(30):
        f, x0, u = smooth(rng, 4, 2), rng.uniform(0.5, 1.5, 4), rng.uniform(0.5, 1.0, 2)
        t = np.append(0.0, np.cumsum(fitted(f, x0, u, rng.uniform(0.1, 0.25, 6), METHOD)))
        exact = exact_run(real(f), x0, u, t)
        error = np.max(np.abs(run(real(f), x0, u, t) - exact)) / np.max(np.abs(exact))
        assert error < 2 * METHOD
        coarse, fine = free_runs(rng, 2)
        ends = [run(*map(real, call.args))[-1] for call in (coarse, fine)]
        first, second = (np.max(np.abs(end - coarse.end)) for end in ends)
        assert np.log2(first / second) > LEAST_ORDER


def test_reference_run_agrees_with_a_tight_solver():
    calls = CHECKS["p5-simulate"].calls(np.random.default_rng(6), VISIBLE_CASES)
    for call in calls:
        args = [*map(real, call.args)]
        tight = held_ivp(*args, method="DOP853", rtol=1e-12, atol=1e-13)
        np.testing.assert_allclose(exact_run(*args), tight, atol=2e-7)
        if isinstance(call, FreeRun):
            np.testing.assert_allclose(call.end, tight[-1], atol=2e-7)
            energy = call.energy(np.array(tight))
            np.testing.assert_allclose(energy, energy[0], rtol=1e-9)


def test_released_notebook_says_what_comes_first():
    graded = PROBLEM.graded("blank")
    printed = [o.text for c in graded.notebook.cells for o in c.get("outputs", []) if "text" in o]
    assert any("first, then run this cell again" in text for text in printed)


@pytest.mark.parametrize("seed", range(5))
def test_each_joint_stands_still_and_creeps_in_a_visible_check(seed):
    """So that friction which is wrong in one joint alone shows."""
    calls = CHECKS["p5-f"].calls(np.random.default_rng(seed), VISIBLE_CASES)
    speeds = np.abs([call.args[0][2:] for call in calls])
    assert np.all(np.any(speeds == 0, axis=0))
    assert np.all(np.any((speeds > 0) & (speeds < 0.01), axis=0))


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
    for name, method in (("Euler", explicit(((),), (1,))), ("Kutta 3", KUTTA)):
        calls = check.calls(np.random.default_rng(0), HIDDEN_CASES)
        values = [run(*map(real, call.args), step=method) for call in calls]
        orders = [parts[3] for parts in check.quantities(calls, values) if parts[3].size]
        observed[name] = [float(order) for order in orders]
    assert observed["Euler"] == pytest.approx([1.0] * 4, abs=0.4)
    assert observed["Kutta 3"] == pytest.approx([3.0] * 4, abs=0.4)


def test_doing_nothing_earns_nothing():
    """A constant keeps its energy, but is no motion."""
    assert judged("p5-simulate", "np.tile(x0, (len(t), 1))").credit == 0
    assert judged("p5-energy_drift", "np.zeros(len(x))").credit == 0
    assert judged("p5-rk4_step", "x").credit == 0
