"""The fixed-step methods: order, symplecticity in canonical variables, symmetry, energy."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from armdyn import Pendulum, Planar2R, PlanarChain
from armdyn.integrators import INTEGRATORS, implicit_midpoint
from armdyn.simulate import energy_drift, observed_order, simulate
from tests.armdyn.arms import between, rate

PENDULUM = Pendulum(m=1.0, lc=0.5, I=0.3)
ARM = Planar2R(1.0, 0.8, 0.5, 0.4, 2.0, 1.5, 0.2, 0.1)
FREE = np.zeros(2)
START = np.array([0.4, -0.7, 0.5, 1.0])

methods = pytest.mark.parametrize("method", INTEGRATORS)


def step_matrix(method, rate_of, x, dt):
    """The Jacobian of one step at x, (N, N)."""
    step = INTEGRATORS[method].step
    columns = [
        rate(lambda x: step(lambda _, x: rate_of(x), 0.0, x, dt), x, e, h=1e-2)
        for e in np.eye(len(x))
    ]
    return np.stack(columns, axis=1)


def area_defect(J):
    """How far a step is from keeping the canonical form, max |Jᵀ Ω J − Ω|."""
    n = len(J) // 2
    omega = np.block([[np.zeros((n, n)), np.eye(n)], [-np.eye(n), np.zeros((n, n))]])
    return np.max(np.abs(J.T @ omega @ J - omega))


def canonical(arm):
    """Hamilton's equations of a free arm, x = [q; p]: q̇ = M⁻¹ p, ṗ = Cᵀ q̇ − g."""

    def f(x):
        q, p = x[: arm.n], x[arm.n :]
        qd = np.linalg.solve(arm.M(q), p)
        return np.concatenate([qd, arm.C(q, qd).T @ qd - arm.g_vec(q)])

    return f


def pendulum_rate(x):
    return PENDULUM.state_derivative(x, [0.0])


@methods
def test_order_on_an_arm(method):
    seen = observed_order(ARM, START, FREE, 0.25, method, steps=16, halvings=3)
    assert seen.orders[-1] == pytest.approx(INTEGRATORS[method].order, abs=0.15)
    np.testing.assert_array_equal(seen.steps, [16, 32, 64, 128])
    np.testing.assert_allclose(seen.orders, np.log2(seen.errors[:-1] / seen.errors[1:]), rtol=1e-12)


@methods
def test_order_with_an_input_that_varies_and_many_arms(method):
    x0 = np.array([[0.3, 0.0], [1.0, -2.0], [3.0, 0.5]])

    def push(t, x):
        return np.array([np.sin(3 * t)])

    seen = observed_order(PENDULUM, x0, push, 0.5, method, halvings=2)
    assert seen.orders[-1] == pytest.approx(INTEGRATORS[method].order, abs=0.15)


@pytest.mark.parametrize("method", [name for name, one in INTEGRATORS.items() if not one.of_model])
def test_errors_estimate_the_true_error(method):
    # ẋ = [v; −x] turns: x(1) = cos 1, v(1) = −sin 1.
    def turn(x, u):
        return np.stack([x[..., 1], -x[..., 0]], axis=-1)

    seen = observed_order(turn, [1.0, 0.0], 0.0, 1.0, method, steps=16, halvings=2)
    end = simulate(turn, [1.0, 0.0], 0.0, np.linspace(0, 1, 17), method)[-1]
    error = np.max(np.abs(end - [np.cos(1), -np.sin(1)]))
    share = 1 - 0.5 ** INTEGRATORS[method].order
    assert seen.errors[0] == pytest.approx(share * error, rel=0.2)


def test_where_nothing_is_left_but_rounding_there_is_no_order():
    seen = observed_order(lambda x, u: u, [0.3, 0.7], [0.1, 1 / 3], 1.0, "rk4")
    assert np.isnan(seen.orders).all()
    assert np.max(seen.errors) < 1e-13


@pytest.mark.parametrize("method", ["semi_implicit_euler", "implicit_midpoint"])
@settings(max_examples=15)
@given(between(-3, 3), between(-4, 4), between(0.01, 0.15))
def test_symplectic_methods_keep_the_area_of_a_pendulum(method, q, qd, dt):
    # M is constant, so that (q, q̇) is canonical up to that constant.
    assert area_defect(step_matrix(method, pendulum_rate, np.array([q, qd]), dt)) < 1e-8


@pytest.mark.parametrize(("method", "power"), [("euler", 2), ("rk4", 6)])
def test_the_others_do_not_keep_it(method, power):
    """The defect shrinks as a power of the step: 2 for Euler's, 6 for the classical method's."""
    x = np.array([0.3, 1.0])
    defects = [area_defect(step_matrix(method, pendulum_rate, x, dt)) for dt in (0.2, 0.1)]
    assert np.log2(defects[0] / defects[1]) == pytest.approx(power, abs=0.3)


def test_midpoint_is_symplectic_in_momenta_and_not_in_velocities():
    x = np.array([0.4, -0.7, 2.0, 1.0])
    dt = 0.05
    assert area_defect(step_matrix("implicit_midpoint", canonical(ARM), x, dt)) < 1e-9
    # dq ∧ dp in velocities is dq ∧ d(M(q) q̇): the step's Jacobian, carried over to momenta.

    def velocities(x):
        return ARM.state_derivative(x, FREE)

    def momenta(x):
        return np.concatenate([x[:2], ARM.M(x[:2]) @ x[2:]])

    def jacobian(function, x):
        return np.stack([rate(function, x, e, h=1e-2) for e in np.eye(4)], axis=1)

    after = implicit_midpoint(lambda _, x: velocities(x), 0.0, x, dt)
    J = step_matrix("implicit_midpoint", velocities, x, dt)
    carried = jacobian(momenta, after) @ J @ np.linalg.inv(jacobian(momenta, x))
    assert area_defect(carried) > 1e-5


def test_semi_implicit_euler_is_not_symplectic_where_M_varies():
    x = np.array([0.4, -0.7, 2.0, 1.0])
    assert area_defect(step_matrix("semi_implicit_euler", canonical(ARM), x, 0.05)) > 1e-3


@given(st.tuples(*[between(-2, 2)] * 4), between(-0.02, 0.02))
def test_midpoint_back_in_time_is_where_it_came_from(x, dt):
    def step(x, dt):
        return implicit_midpoint(lambda _, x: ARM.state_derivative(x, FREE), 0, x, dt)

    np.testing.assert_allclose(step(step(np.array(x), dt), -dt), x, atol=1e-12)


def test_energy_over_a_long_run():
    """Euler's energy runs away, the classical method's drifts, that of the symplectic ones stays."""
    t = np.arange(0, 24, 0.06)
    x0 = [1.0, 0.0]
    scale = PENDULUM.energy([1.0], [0.0])

    def worst(method):
        x = simulate(PENDULUM.state_derivative, x0, [0.0], t, method)
        drift = np.abs(energy_drift(PENDULUM, x)) / scale
        return np.max(drift[: len(t) // 4]), np.max(drift)

    assert worst("euler")[1] > 5
    for method in ("semi_implicit_euler", "implicit_midpoint"):
        early, late = worst(method)
        assert late < 0.2
        assert late < 1.02 * early
    early, late = worst("rk4")
    assert late > 3 * early


def test_semi_implicit_euler_puts_velocity_first():
    x = np.array([0.7, 0.2])
    dt = 0.1
    qd = 0.2 + dt * pendulum_rate(x)[1]
    step = INTEGRATORS["semi_implicit_euler"].step
    np.testing.assert_allclose(step(lambda _, x: pendulum_rate(x), 0, x, dt), [0.7 + dt * qd, qd])


@pytest.mark.parametrize("method", ["rk4", "implicit_midpoint"])
def test_order_on_a_chain_of_links(method):
    chain = PlanarChain((0.5,) * 3, (0.25,) * 3, (1.0,) * 3, (0.02,) * 3)
    x0 = [0.3, -0.4, 0.8, 0.1, 0.2, -0.3]
    seen = observed_order(chain.state_derivative, x0, [0.5, 0.0, 0.0], 0.1, method, 8, 2)
    assert seen.orders[-1] == pytest.approx(INTEGRATORS[method].order, abs=0.2)


@pytest.mark.parametrize(
    ("f", "x0", "dt"),
    [
        (lambda x, u: -100 * x, [1.0], 0.1),  # dt/2 · 100 > 1
        (lambda x, u: -np.sign(x - 0.02), [0.0], 0.1),  # a jump
        (lambda x, u: x**9, [3.0], 0.5),  # overflows on the way
    ],
)
def test_midpoint_says_where_it_does_not_converge(f, x0, dt):
    said = rf"implicit_midpoint did not converge in the step of {dt} s from t = 2 s"
    with pytest.raises(FloatingPointError, match=said):
        simulate(f, x0, 0.0, [2, 2 + dt], "implicit_midpoint")


def test_midpoint_of_a_linear_system_is_its_padé_approximant():
    x = simulate(lambda x, u: -3 * x, [1.0, 2.0], 0.0, [0, 0.1], "implicit_midpoint")
    np.testing.assert_allclose(x[1], np.array([1.0, 2.0]) * (1 - 0.15) / (1 + 0.15), rtol=1e-14)


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"method": "RK45"}, r"^method = 'RK45': needs one of euler"),
        ({"u": np.zeros((3, 2))}, r"^u: needs \(n,\) or a function"),
        ({"t_end": 0.0}, r"^t_end = 0\.0"),
        ({"steps": 0}, r"^steps = 0: needs a whole number, at least 1"),
        ({"halvings": 1}, r"^halvings = 1: needs a whole number, at least 2"),
        ({"x0": [0.0]}, r"^f\(x0, u\)"),
    ],
)
def test_observed_order_names_bad_input(changes, says):
    arguments = {"f": ARM.state_derivative, "x0": START, "u": FREE, "t_end": 1.0}
    with pytest.raises(ValueError, match=says):
        observed_order(**arguments | changes)
