"""Right answers about simulation, each found in another way, beside the notebook's own functions."""

from contextlib import redirect_stdout
from functools import cache
from io import StringIO

import numpy as np
from scipy.integrate import solve_ivp

from autograder.problems import CHECKS
from autograder.problems.material.systems import rk4, run
from autograder.problems.p5_state_space.step_mistakes import explicit
from tests.autograder.course_problems import problem
from tests.submissions.answers import indented

SETUP = next(c.source for c in problem("p5-state-space").source.cells if c.id == "p5-setup")
PARTS = {
    "f": """
q, qd = x[:2], x[2:]
rest = u - C(q, qd, arm) @ qd - g_vec(q, arm) - arm.viscous * qd - arm.coulomb * np.sign(qd)
""",
    "energy_drift": """
def K(q, qd):
    return 0.5 * qd @ M(q, arm) @ qd
def P(q):
    y2 = arm.l1 * np.sin(q[0]) + arm.lc2 * np.sin(q[0] + q[1])
    return arm.g * (arm.m1 * arm.lc1 * np.sin(q[0]) + arm.m2 * y2)
""",
}
RATES = [
    "return np.r_[qd, np.linalg.inv(M(q, arm)) @ rest]",
    "return [*qd, *np.linalg.solve(M(q, arm), rest).tolist()]",
    "return np.append(qd, np.linalg.solve(M(q, arm), rest))[None]",
    """
(a, b), (c, d) = M(q, arm)
det = a * d - b * c
return np.array([*qd, (d * rest[0] - b * rest[1]) / det, (a * rest[1] - c * rest[0]) / det])
""",
    "return np.append(qd, np.linalg.lstsq(M(q, arm), rest)[0])",
    """
xd = x.copy()
xd[0:2], xd[2:4] = x[2:4], np.linalg.solve(M(q, arm), rest)
return xd
""",
    """
h = 1e-6
dM = [(M(q + h * e, arm) - M(q - h * e, arm)) / (2 * h) for e in np.eye(2)]
K = [0.5 * qd @ dM[i] @ qd for i in range(2)]
bias = (qd[0] * dM[0] + qd[1] * dM[1]) @ qd - K
friction = arm.viscous * qd + arm.coulomb * np.sign(qd)
return np.append(qd, np.linalg.solve(M(q, arm), u - bias - g_vec(q, arm) - friction))
""",
    """
rest = u - C(q, qd, arm) @ qd - g_vec(q, arm) - np.diag(arm.viscous) @ qd
rest = rest - np.where(qd > 0, arm.coulomb, np.where(qd < 0, -arm.coulomb, 0))
return np.append(qd, np.linalg.solve(M(q, arm), rest))
""",
]
DRIFTS = [
    "E = [K(s[:2], s[2:]) + P(s[:2]) for s in x]\nreturn [e - E[0] for e in E]",
    "E = np.array([K(s[:2], s[2:]) + P(s[:2]) + 100 for s in x])\nreturn E - E[0]",
    "E = np.array([[K(s[:2], s[2:]) + P(s[:2]) for s in x]])\nreturn E - E[0, 0]",
    "E = np.array([K(s[:2], s[2:]) + P(s[:2]) for s in x])\n"
    "return np.append(0, np.cumsum(np.diff(E)))",
    "Ms = np.array([M(s[:2], arm) for s in x])\n"
    "E = np.einsum('ki,kij,kj->k', x[:, 2:], Ms, x[:, 2:]) / 2 + [P(s[:2]) for s in x]\n"
    "return E - E[0]",
    """
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
    "Ks = np.array([K(s[:2], s[2:]) for s in x])\nPs = np.array([P(s[:2]) for s in x])\n"
    "return (Ks - Ks[0]) + (Ps - Ps[0])",
]


@cache
def set_up():
    """What the notebook's first cell defines, without its picture."""
    namespace = {}
    with redirect_stdout(StringIO()):
        exec(SETUP.replace("plt", "np").replace("matplotlib.pyplot", "numpy"), namespace)
    return namespace


def function_of(name, body):
    """The student's function with this body, beside the notebook's own M, C and g_vec."""
    namespace = dict(set_up())
    exec(f"def {CHECKS[f'p5-{name}'].signature}:\n{indented(PARTS[name] + body)}", namespace)
    return namespace[name]


def inside(f, x, u, dt):
    """In single precision inside."""
    return rk4(lambda x, u: np.float32(f(x, u)), np.float32(x), u, np.float32(dt))


def halves(f, x, u, dt):
    return rk4(f, rk4(f, x, u, dt / 2), u, dt / 2)


three_eighths = explicit(((), (1 / 3,), (-1 / 3, 1), (1, -1, 1)), (1 / 8, 3 / 8, 3 / 8, 1 / 8))


def held_ivp(f, x0, u, t, **options):
    """One run of a solver a step, with the torque held."""
    states = [x0]
    for k in range(len(t) - 1):
        torque = u(t[k], states[k]) if callable(u) else u
        run = solve_ivp(
            lambda _, x, torque=torque: f(x, torque), t[k : k + 2], states[k], **options
        )
        states.append(run.y[:, -1])
    return states


def stacked(f, x0, u, t):
    states = np.array([x0])
    while len(states) < len(t):
        k = len(states) - 1
        torque = u(t[k], states[k]) if callable(u) else u
        states = np.vstack([states, rk4(f, states[k], torque, t[k + 1] - t[k])])
    return states


def with_three_eighths(*args):
    return run(*args, step=three_eighths)


RIGHT = {
    "p5-f": [function_of("f", body) for body in RATES],
    "p5-rk4_step": [
        rk4,
        inside,
        three_eighths,
        halves,
        lambda f, x, u, dt: (16 * halves(f, x, u, dt) - rk4(f, x, u, dt)) / 15,
        lambda f, x, u, dt: solve_ivp(lambda _, x: f(x, u), (0, dt), x, rtol=1e-8, atol=1e-10).y[
            :, -1
        ],
        lambda f, x, u, dt: np.copy(x).__iadd__(rk4(f, x, u, dt) - x),
    ],
    "p5-simulate": [
        run,
        stacked,
        with_three_eighths,
        lambda *args: np.float32(run(*args)),
        lambda *args: run(*args, step=halves),
        lambda *args: held_ivp(*args, rtol=1e-8, atol=1e-10),
        lambda *args: held_ivp(*args, rtol=1e-6),
        lambda *args: held_ivp(*args, method="DOP853", rtol=1e-9, atol=1e-9),
        lambda *args: held_ivp(*args, method="LSODA", rtol=1e-9, atol=1e-9),
    ],
    "p5-energy_drift": [function_of("energy_drift", body) for body in DRIFTS],
}
# Those that come nearest to a tolerance.
DELICATE = {"p5-rk4_step": [inside], "p5-simulate": [run, with_three_eighths]}
