"""The right answers of lesson 10 once more, by running methods in place of solving conditions."""

import numpy as np
import pytest

from armdyn import Planar2R
from armdyn.simulate import simulate
from autograder.lesson_checks import checks_of
from autograder.lesson_checks.arm import ARM

CHECKS = checks_of("10")
arm = Planar2R(**vars(ARM))


def changes(step, steps=(100, 200, 400)):
    """How the end of x' = x² + t changes from one run to the next, as the steps are doubled."""
    ends = []
    for number in steps:
        dt, x = 1 / number, np.array([0.5, 0.0])  # x and t
        for _ in range(number):
            x = x + dt * step(lambda x: np.array([x[0] ** 2 + x[1], 1.0]), x, dt)
        ends.append(x[0])
    return np.abs(np.diff(ends))


def two_slopes(b2, c=2 / 3):
    def step(f, x, dt):
        k1 = f(x)
        return (1 - b2) * k1 + b2 * f(x + c * dt * k1)

    return step


def order_of(step):
    first, second = changes(step)
    return np.log2(first / second)


def test_the_right_weight_alone_gives_order_2():
    assert np.isclose(order_of(two_slopes(CHECKS["10-ahead"].right)), 2, atol=0.05)
    for wrong in CHECKS["10-ahead"].wrong:
        assert np.isclose(order_of(two_slopes(wrong.number)), 1, atol=0.05), wrong.name


def test_a_method_of_the_measured_order_falls_by_that_ratio():
    """Kutta's method of order 3, measured as the question measures the unknown one."""

    def kutta_3(f, x, dt):
        k1 = f(x)
        k2 = f(x + dt / 2 * k1)
        k3 = f(x + dt * (2 * k2 - k1))
        return (k1 + 4 * k2 + k3) / 6

    first, second = changes(kutta_3)
    ratio = {one.name: one.number for one in CHECKS["10-halved"].wrong}["ratio"]
    assert np.isclose(first / second, ratio, rtol=0.05)
    assert np.isclose(order_of(kutta_3), CHECKS["10-halved"].right, atol=0.05)


def test_what_euler_adds_has_the_sign_of_the_balance():
    """With the works along the run and its energy, as the question gives them."""
    damped = Planar2R(**vars(ARM), viscous=(0.5, 0.3), coulomb=(0.4, 0.2))
    u, t = np.array([6.0, 2.0]), np.linspace(0, 1, 401)
    added = {}
    for method in ("euler", "rk4"):
        x = simulate(damped.state_derivative, [-0.3, 1.2, 0.0, 0.0], u, t, method)
        given = np.trapezoid(x[:, 2:] @ u, t)
        taken = np.trapezoid(np.vecdot(x[:, 2:], damped.f_vec(x[:, 2:])), t)
        E = damped.energy(x[:, :2], x[:, 2:])
        added[method] = (E[-1] - E[0]) - given + taken
    assert added["euler"] > 100 * abs(added["rk4"])
    assert CHECKS["10-balance"].right == pytest.approx(-7.4 - 5.1 + 14.2)


def test_in_momenta_the_drift_is_bounded_and_not_zero():
    """What the options say of implicit midpoint in (q, p): bounds, and no exact energy."""

    def canonical(x, u):
        qd = np.linalg.solve(arm.M(x[:2]), x[2:])
        return np.concatenate([qd, arm.C(x[:2], qd).T @ qd - arm.g_vec(x[:2])])

    start, t = np.array([0.4 - np.pi / 2, 0.3, 0.0, 0.0]), np.linspace(0, 20, 501)
    x = simulate(canonical, start, np.zeros(2), t, "implicit_midpoint")
    qd = np.array([np.linalg.solve(arm.M(q), p) for q, p in zip(x[:, :2], x[:, 2:], strict=True)])
    drift = np.abs(arm.energy(x[:, :2], qd) - arm.energy(start[:2], start[2:]))
    assert drift[:251].max() > 1e-6
    assert drift[251:].max() < 1.2 * drift[:251].max()
