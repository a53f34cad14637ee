"""p5-state-space: right answers in many styles pass at any seed; whole notebooks; the references."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from armdyn import Planar2R
from autograder.judging.check import HIDDEN_CASES, VISIBLE_CASES
from autograder.judging.verdict import State
from autograder.problems import CHECKS
from autograder.problems.material.systems import (
    METHOD,
    FreeRun,
    exact_run,
    fitted,
    free_runs,
    rk4,
    run,
    smooth,
)
from autograder.problems.p5_state_space.checks import LEAST_ORDER
from autograder.problems.p5_state_space.mistakes import EXAMPLE, METHODS, explicit
from autograder.protocol import real
from tests.autograder.course_problems import problem
from tests.autograder.verdicts import assert_right, judged_in, sentences

PROBLEM = problem("p5-state-space")
SETUP = next(cell.source for cell in PROBLEM.source.cells if cell.id == "p5-setup")

RATES = {
    "solve": "return np.concatenate([qd, np.linalg.solve(M(q, arm), rest)])",
    "inverse": "return np.r_[qd, np.linalg.inv(M(q, arm)) @ rest]",
    "list": "return [*qd, *np.linalg.solve(M(q, arm), rest).tolist()]",
    "tuple": "return tuple(np.hstack((qd, np.linalg.solve(M(q, arm), rest))))",
    "column": "return np.vstack([qd[:, None], np.linalg.solve(M(q, arm), rest[:, None])])",
    "row": "return np.append(qd, np.linalg.solve(M(q, arm), rest))[None]",
    "single precision": "return np.float32(np.append(qd, np.linalg.solve(M(q, arm), rest)))",
    "Cramer": """
(a, b), (c, d) = M(q, arm)
det = a * d - b * c
return np.array([*qd, (d * rest[0] - b * rest[1]) / det, (a * rest[1] - c * rest[0]) / det])
""",
    "least squares": "return np.append(qd, np.linalg.lstsq(M(q, arm), rest)[0])",
    "into a copy": """
xd = x.copy()
xd[0:2], xd[2:4] = x[2:4], np.linalg.solve(M(q, arm), rest)
return xd
""",
    "C from differences of M": """
h = 1e-6
dM = [(M(q + h * e, arm) - M(q - h * e, arm)) / (2 * h) for e in np.eye(2)]
K = [0.5 * qd @ dM[i] @ qd for i in range(2)]
bias = (qd[0] * dM[0] + qd[1] * dM[1]) @ qd - K
friction = arm.viscous * qd + arm.coulomb * np.sign(qd)
return np.append(qd, np.linalg.solve(M(q, arm), u - bias - g_vec(q, arm) - friction))
""",
    "friction by cases": """
rest = u - C(q, qd, arm) @ qd - g_vec(q, arm) - np.diag(arm.viscous) @ qd
rest = rest - np.where(qd > 0, arm.coulomb, np.where(qd < 0, -arm.coulomb, 0))
return np.append(qd, np.linalg.solve(M(q, arm), rest))
""",
}
STEPS = {
    "slopes": rk4,
    "list": lambda f, x, u, dt: list(rk4(f, x, u, dt)),
    "column": lambda f, x, u, dt: rk4(f, x, u, dt)[:, None],
    "single precision": lambda f, x, u, dt: np.float32(rk4(f, x, u, dt)),
    "single precision inside": lambda f, x, u, dt: rk4(
        lambda x, u: np.float32(f(x, u)), np.float32(x), u, np.float32(dt)
    ),
    "three eighths": explicit(
        ((), (1 / 3,), (-1 / 3, 1), (1, -1, 1)), (1 / 8, 3 / 8, 3 / 8, 1 / 8)
    ),
    "two half steps": lambda f, x, u, dt: rk4(f, rk4(f, x, u, dt / 2), u, dt / 2),
    "extrapolated": lambda f, x, u, dt: (
        (16 * rk4(f, rk4(f, x, u, dt / 2), u, dt / 2) - rk4(f, x, u, dt)) / 15
    ),
    "solve_ivp": lambda f, x, u, dt: solve_ivp(
        lambda _, x: f(x, u), (0, dt), x, rtol=1e-8, atol=1e-10
    ).y[:, -1],
    "on a copy": lambda f, x, u, dt: np.copy(x).__iadd__(rk4(f, x, u, dt) - x),
}


def held_ivp(f, x0, u, t, **options):
    """One run of a solver a step, with the torque held."""
    states = [x0]
    for k in range(len(t) - 1):
        torque = u(t[k], states[k]) if callable(u) else u
        rate = lambda _, x, torque=torque: f(x, torque)  # noqa: E731
        states.append(solve_ivp(rate, t[k : k + 2], states[k], **options).y[:, -1])
    return states


def filled(f, x0, u, t):
    states = np.full((len(t), len(x0)), np.nan)
    states[0] = x0
    law = u if callable(u) else lambda t, x: u
    for k, dt in enumerate(np.diff(t)):
        states[k + 1] = rk4(f, states[k], law(t[k], states[k]), dt)
    return states


def stacked(f, x0, u, t):
    states = np.array([x0])
    while len(states) < len(t):
        k = len(states) - 1
        torque = u(t[k], states[k]) if callable(u) else u
        states = np.vstack([states, rk4(f, states[k], torque, t[k + 1] - t[k])])
    return states


RUNS = {
    "list of states": run,
    "filled": filled,
    "stacked": stacked,
    "lists": lambda *args: run(*args).tolist(),
    "single precision": lambda *args: np.float32(run(*args)),
    "three eighths": lambda *args: run(*args, step=STEPS["three eighths"]),
    "two half steps": lambda *args: run(*args, step=STEPS["two half steps"]),
    "RK45, tight": lambda *args: held_ivp(*args, rtol=1e-8, atol=1e-10),
    "RK45, 1e-6": lambda *args: held_ivp(*args, rtol=1e-6),
    "DOP853": lambda *args: held_ivp(*args, method="DOP853", rtol=1e-9, atol=1e-9),
    "LSODA": lambda *args: held_ivp(*args, method="LSODA", rtol=1e-9, atol=1e-9),
}
DRIFTS = {
    "rows": "E = np.array([K(s[:2], s[2:]) + P(s[:2]) for s in x])\nreturn E - E[0]",
    "list": "E = [K(s[:2], s[2:]) + P(s[:2]) for s in x]\nreturn [e - E[0] for e in E]",
    "another zero": "E = np.array([K(s[:2], s[2:]) + P(s[:2]) + 100 for s in x])\nreturn E - E[0]",
    "column": "E = np.array([[K(s[:2], s[2:]) + P(s[:2])] for s in x])\nreturn E - E[0]",
    "row": "E = np.array([[K(s[:2], s[2:]) + P(s[:2]) for s in x]])\nreturn E - E[0, 0]",
    "single precision": "return np.float32([K(s[:2], s[2:]) + P(s[:2]) - K(x[0, :2], x[0, 2:])"
    " - P(x[0, :2]) for s in x])",
    "summed steps": "E = np.array([K(s[:2], s[2:]) + P(s[:2]) for s in x])\n"
    "return np.append(0, np.cumsum(np.diff(E)))",
    "einsum": "Ms = np.array([M(s[:2], arm) for s in x])\n"
    "E = np.einsum('ki,kij,kj->k', x[:, 2:], Ms, x[:, 2:]) / 2 + [P(s[:2]) for s in x]\n"
    "return E - E[0]",
    "speeds of the centres": """
E = []
for q1, q2, w1, w2 in x:
    a, w = q1 + q2, w1 + w2
    v1 = arm.lc1 * w1 * np.array([-np.sin(q1), np.cos(q1)])
    v2 = arm.l1 * w1 * np.array([-np.sin(q1), np.cos(q1)]) \\
        + arm.lc2 * w * np.array([-np.sin(a), np.cos(a)])
    K2 = arm.m1 * v1 @ v1 + arm.m2 * v2 @ v2 + arm.I1 * w1**2 + arm.I2 * w**2
    E.append(K2 / 2 + P(np.array([q1, q2])))
return np.array(E) - E[0]
""",
    "both drifts": "Ks = np.array([K(s[:2], s[2:]) for s in x])\nPs = np.array([P(s[:2]) for s in x])\n"
    "return (Ks - Ks[0]) + (Ps - Ps[0])",
}
PARTS = {
    "f": "q, qd = x[:2], x[2:]\n"
    "rest = u - C(q, qd, arm) @ qd - g_vec(q, arm) - arm.viscous * qd - arm.coulomb * np.sign(qd)\n",
    "energy_drift": """
def K(q, qd):
    return 0.5 * qd @ M(q, arm) @ qd
def P(q):
    y2 = arm.l1 * np.sin(q[0]) + arm.lc2 * np.sin(q[0] + q[1])
    return arm.g * (arm.m1 * arm.lc1 * np.sin(q[0]) + arm.m2 * y2)
""",
}


def function_of(name, body):
    """The student's function with this body, beside the notebook's own M, C and g_vec."""
    body = (PARTS[name] + body).replace("\n", "\n    ")
    namespace = {}
    exec(SETUP.replace("plt", "np").replace("matplotlib.pyplot", "numpy"), namespace)
    exec(f"def {CHECKS[f'p5-{name}'].signature}:\n    {body}", namespace)
    return namespace[name]


VARIANTS = {
    "f": {style: function_of("f", body) for style, body in RATES.items()},
    "rk4_step": STEPS,
    "simulate": RUNS,
    "energy_drift": {style: function_of("energy_drift", body) for style, body in DRIFTS.items()},
}
CASES = [(name, style) for name, variants in VARIANTS.items() for style in variants]


def judged(name, function, seed, count=HIDDEN_CASES):
    return judged_in({name: function}, f"p5-{name}", seed, count)


@pytest.mark.parametrize(("name", "style"), CASES)
def test_right_in_any_style(name, style):
    for seed in (1, 2):
        assert_right(judged(name, VARIANTS[name][style], seed))


@pytest.mark.parametrize(
    ("name", "style", "seeds"),
    [
        ("f", "list", 1000),
        ("energy_drift", "single precision", 200),
        ("rk4_step", "single precision", 200),
        ("simulate", "single precision", 50),
        ("simulate", "three eighths", 20),
    ],
)
def test_no_false_alarm_at_any_seed(name, style, seeds):
    """As many seeds as a few seconds allow; each was tried once with a thousand."""
    right = VARIANTS[name][style]
    for seed in range(seeds):
        assert judged(name, right, seed, VISIBLE_CASES).state is State.CORRECT, seed


SPOILT = {
    "f": lambda x, u, arm: VARIANTS["f"]["solve"](x, u, arm) * 1.0001,
    "rk4_step": lambda f, x, u, dt: rk4(f, x, u, dt) * 1.0001,
    "simulate": lambda *args: run(*args) * 1.0001,
    "energy_drift": lambda x, arm: VARIANTS["energy_drift"]["rows"](x, arm) * 1.0001,
}


@pytest.mark.parametrize("name", SPOILT)
def test_wrong_by_1e_4_fails_at_any_seed(name):
    for seed in range(10):
        verdict = judged(name, SPOILT[name], seed, VISIBLE_CASES)
        assert verdict.credit == 0
        known = {mistake.sentence for mistake in CHECKS[f"p5-{name}"].mistakes}
        assert not known & set(verdict.diagnosis)


KUTTA_3 = explicit(((), (1 / 2,), (-1, 2)), (1 / 6, 2 / 3, 1 / 6))
LOW_ORDER = [KUTTA_3, *(m.wrong for m in METHODS)]


@pytest.mark.parametrize("step", LOW_ORDER, ids=["Kutta 3", *(m.name for m in METHODS)])
def test_methods_of_lower_order_never_pass(step):
    for seed in range(4):
        assert not judged("rk4_step", step, seed, VISIBLE_CASES).rows[1].met
        rows = judged("simulate", lambda *args: run(*args, step=step), seed, VISIBLE_CASES).rows
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


def test_references_agree_with_the_library():
    """The checks' own references against armdyn.Planar2R, at the checks' own cases."""
    rng = np.random.default_rng(3)
    for call in CHECKS["p5-f"].calls(rng, 30):
        x, u, arm = call.args
        expected = Planar2R(**vars(arm)).state_derivative(x, u)
        np.testing.assert_allclose(CHECKS["p5-f"].reference(x, u, arm), expected, rtol=1e-9)
    for call in CHECKS["p5-energy_drift"].calls(rng, 30):
        x, arm = call.args
        energy = Planar2R(**vars(arm)).energy(x[:, :2], x[:, 2:])
        drift = CHECKS["p5-energy_drift"].reference(x, arm)
        np.testing.assert_allclose(drift, energy - energy[0], atol=1e-10)


def test_example_arm_is_that_of_the_notebook():
    namespace = {}
    exec(SETUP, namespace)
    shown = vars(namespace["picker"])
    assert shown.keys() == vars(EXAMPLE).keys()
    assert all(np.array_equal(shown[key], value) for key, value in vars(EXAMPLE).items())


def test_released_notebook_says_what_comes_first():
    graded = PROBLEM.graded("blank")
    printed = [o.text for c in graded.notebook.cells for o in c.get("outputs", []) if "text" in o]
    assert any("first, then run this cell again" in text for text in printed)


def test_partly_right_submission():
    verdicts = PROBLEM.graded("partly_right").verdicts
    credits = {name: round(verdict.credit, 3) for name, verdict in verdicts.items()}
    assert credits == {
        "p5-f": 0.25, "p5-rk4_step": 0.25, "p5-simulate": 0.4, "p5-energy_drift": 0.35,
    }  # fmt: skip
    for check_id, name in (
        ("p5-f", "wrong sign / the viscous friction"),
        ("p5-rk4_step", "Euler"),
        ("p5-simulate", "Euler"),
        ("p5-energy_drift", "P missing"),
    ):
        assert verdicts[check_id].diagnosis == sentences(check_id, name)


def test_wrong_submission_says_why():
    verdicts = PROBLEM.graded("wrong").verdicts
    for check_id, name in (
        ("p5-f", "halves of ẋ swapped"),
        ("p5-simulate", "start repeated"),
        ("p5-energy_drift", "sign of the whole"),
    ):
        assert verdicts[check_id].diagnosis == sentences(check_id, name)


@pytest.mark.parametrize("seed", range(5))
def test_each_joint_stands_still_and_creeps_in_a_visible_check(seed):
    """So that friction which is wrong in one joint alone shows."""
    calls = CHECKS["p5-f"].calls(np.random.default_rng(seed), VISIBLE_CASES)
    speeds = np.abs([call.args[0][2:] for call in calls])
    assert np.all(np.any(speeds == 0, axis=0))
    assert np.all(np.any((speeds > 0) & (speeds < 0.01), axis=0))
