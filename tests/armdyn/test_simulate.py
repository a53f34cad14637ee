from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from armdyn import Pendulum, Planar2R
from armdyn.pace import WINDOW
from armdyn.simulate import SCIPY_METHODS, energy_drift, rk4_step, simulate
from tests.armdyn.arms import a_few, between

ARM = Planar2R(1.0, 0.8, 0.5, 0.4, 2.0, 1.5, 0.2, 0.1)
ROUGH = Planar2R(1.0, 0.8, 0.5, 0.4, 2.0, 1.5, 0.2, 0.1, viscous=(0.5, 0.3), coulomb=(0.4, 0.2))
START = np.array([0.4, -0.7, 0.5, 1.0])
FREE = np.zeros(2)
METHODS = ("rk4", *SCIPY_METHODS)


def test_rk4_has_order_four_on_an_arm():
    t_end = 1.0
    exact = simulate(ARM.state_derivative, START, FREE, [0, t_end], "DOP853", 1e-12, 1e-13)[-1]
    errors = []
    for steps in (100, 200, 400):
        x = simulate(ARM.state_derivative, START, FREE, np.linspace(0, t_end, steps + 1))
        errors.append(np.max(np.abs(x[-1] - exact)))
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert np.all(np.abs(orders - 4) < 0.3)


@given(between(-3, 3), between(0.01, 1))
def test_one_rk4_step_is_the_taylor_series_of_a_linear_system(rate, dt):
    z = rate * dt
    series = 1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24
    np.testing.assert_allclose(
        rk4_step(lambda x, _: rate * x, [1.0, 2.0], 0, dt), [series, 2 * series]
    )


@pytest.mark.parametrize("power", [0, 1, 2, 3])
def test_rk4_is_exact_for_cubic_inputs(power):
    # ẋ = u(t) = t^power: Simpson's rule, exact to the third power; a stage at the wrong time is not.
    t = np.array([0.5, 1.0, 2.5])
    x = simulate(lambda _, u: u, [0.0], lambda t, _: [t**power], t)
    np.testing.assert_allclose(x[:, 0], (t ** (power + 1) - 0.5 ** (power + 1)) / (power + 1))


def test_rk4_agrees_with_an_independent_solver_and_holds_energy():
    t = np.linspace(0, 2, 501)
    x = simulate(ARM.state_derivative, START, FREE, t)
    reference = simulate(ARM.state_derivative, START, FREE, t, "DOP853", 1e-10)
    np.testing.assert_allclose(x, reference, atol=1e-5)
    swing = np.max(ARM.kinetic_energy(x[:, :2], x[:, 2:]))
    assert np.max(np.abs(energy_drift(ARM, x))) < 1e-7 * swing
    np.testing.assert_array_equal(x[0], START)


@pytest.mark.parametrize("method", SCIPY_METHODS)
def test_scipy_methods_agree_with_rk4(method):
    t = np.linspace(0, 0.5, 251)
    x = simulate(ARM.state_derivative, START, FREE, t, method, rtol=1e-7, atol=1e-9)
    np.testing.assert_allclose(x, simulate(ARM.state_derivative, START, FREE, t), atol=1e-5)


@pytest.mark.parametrize("method", SCIPY_METHODS)
def test_coulomb_friction_from_rest(method):
    # sign(q̇) jumps at the start: a solver that takes the jump for stiffness would stay there.
    t = np.linspace(0, 0.5, 1001)
    x0 = [1.0, 0.0, 0.0, 0.0]
    x = simulate(ROUGH.state_derivative, x0, FREE, t, method, rtol=1e-6, atol=1e-8)
    fine = simulate(ROUGH.state_derivative, x0, FREE, t)
    np.testing.assert_allclose(x, fine, atol=5e-3)
    assert abs(x[-1, 0] - 1.0) > 0.3


def test_friction_takes_energy_out_at_the_rate_it_says():
    # Pushed so that no joint turns back, where Coulomb friction would jump within a step.
    t = np.linspace(0, 0.1, 201)
    x = simulate(ROUGH.state_derivative, [-1.2, -0.5, 3.0, 3.0], FREE, t)
    qd = x[:, 2:]
    assert np.all(qd > 0)
    power = -np.vecdot(qd, ROUGH.f_vec(qd))
    lost = np.concatenate([[0], np.cumsum((power[1:] + power[:-1]) / 2 * np.diff(t))])
    np.testing.assert_allclose(energy_drift(ROUGH, x), lost, atol=1e-5)
    assert np.all(np.diff(energy_drift(ROUGH, x)) < 0)


def test_an_input_may_be_a_vector_or_a_function():
    t = np.linspace(0, 0.5, 51)
    u = np.array([3.0, -1.0])
    x = simulate(ROUGH.state_derivative, START, u, t)
    np.testing.assert_array_equal(x, simulate(ROUGH.state_derivative, START, list(u), t))
    np.testing.assert_array_equal(x, simulate(ROUGH.state_derivative, START, lambda t, x: u, t))
    assert np.max(np.abs(x - simulate(ROUGH.state_derivative, START, FREE, t))) > 0.01


@pytest.mark.parametrize("method", ["rk4", "DOP853"])
def test_gravity_compensation_holds_the_arm_still(method):
    t = np.linspace(0, 0.5, 21)
    still = [0.4, -0.7, 0.0, 0.0]

    def u(t, x):
        return ARM.g_vec(x[..., :2])

    x = simulate(ARM.state_derivative, still, u, t, method)
    np.testing.assert_allclose(x, np.broadcast_to(still, x.shape), atol=1e-9)


@a_few
@given(st.sampled_from([(1,), (3,), (2, 2)]), st.integers(0, 2**32 - 1))
def test_many_arms_at_once_are_each_alone(batch, seed):
    x0 = np.random.default_rng(seed).uniform(-2, 2, (*batch, 4))
    t = np.linspace(0, 0.1, 6)
    x = simulate(ROUGH.state_derivative, x0, [1.0, 0.5], t)
    assert x.shape == (*batch, 6, 4)
    for at in np.ndindex(batch):
        alone = simulate(ROUGH.state_derivative, x0[at], [1.0, 0.5], t)
        np.testing.assert_allclose(x[at], alone, rtol=1e-10, atol=1e-12)
    drift = energy_drift(ROUGH, x)
    assert drift.shape == (*batch, 6)
    np.testing.assert_array_equal(drift[..., 0], 0)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.filterwarnings("error")
def test_a_blow_up_is_one_clear_error(method):
    # ẋ = x³ from 1 leaves every bound at t = 1/2.
    t = np.linspace(0, 1, 51)
    # Warnings, as NumPy has them for a user, are errors here: none may get out.
    with (
        np.errstate(all="warn", under="ignore"),
        pytest.raises(FloatingPointError, match=r"t = 0\.(5|49)\d* s"),
    ):
        simulate(lambda x, u: x**3, [1.0], 0.0, t, method, rtol=1e-4, atol=1e-6)


class Counted:
    def __init__(self, f, most=25_000):
        self.f, self.calls, self.most = f, 0, most

    def __call__(self, x, u):
        self.calls += 1
        assert self.calls <= self.most, "no end in sight"
        return self.f(x, u)


STICKY = Pendulum(m=1.0, lc=0.5, I=0.3, coulomb=1.0)


@pytest.mark.parametrize(
    ("method", "pendulum", "tolerance"),
    [
        *((method, STICKY, 1e-9) for method in SCIPY_METHODS),  # swings, then sticks
        *((method, STICKY, 1e-4) for method in ("RK45", "LSODA")),
        *((method, replace(STICKY, coulomb=4.0), 1e-9) for method in ("RK45", "LSODA")),
    ],
)
def test_coulomb_friction_that_holds_a_joint_is_said(method, pendulum, tolerance):
    """More than 300,000 calls of f were made here once, without a word."""
    f = Counted(pendulum.state_derivative)
    # LSODA gives up by itself where it starts at the jump.
    says = rf'{method} (makes no more progress at|stopped near) t = \d.*Coulomb .* method="rk4"'
    with pytest.raises(FloatingPointError, match=says):
        simulate(f, [0.5, 0.0], [0.0], [0, 5], method, tolerance, tolerance / 1000)
    # What it advises works.
    x = simulate(pendulum.state_derivative, [0.5, 0.0], [0.0], np.linspace(0, 2, 1001), "rk4")
    chatter = 0.002 * pendulum.coulomb / pendulum.I  # rad/s
    assert np.max(np.abs(x[-100:, 1])) < chatter


def test_lsoda_gets_through_a_stiff_arm_at_which_another_method_stands_still():
    stiff = Pendulum(m=1.0, lc=0.5, I=0.3, viscous=1e8)
    with pytest.raises(FloatingPointError, match=r'stiff without jumps, "LSODA"'):
        simulate(stiff, [0.5, 1.0], [0.0], [0, 100], "RK45", 1e-6, 1e-9)
    x = simulate(stiff, [0.5, 1.0], [0.0], [0, 100], "LSODA")
    # It creeps at q̇ = −g/d, after the first 1e-8 s.
    np.testing.assert_allclose(x[-1, 1], -stiff.g_vec([0.5])[0] / stiff.viscous, rtol=1e-3)


@pytest.mark.parametrize("method", SCIPY_METHODS)
@pytest.mark.parametrize(
    "f",
    [
        lambda x, u: np.sign(0.5 - x),  # slides along its own jump
        lambda x, u: np.sqrt(1 - x),  # NaN beyond 1
        lambda x, u: np.where(x < 0.5, 1.0, np.nan),
        lambda x, u: -1e9 * (x - np.cos(x)) if method_is_explicit(u) else -1e3 * x,
    ],
    ids=["jump", "root", "nan", "stiff"],
)
@pytest.mark.filterwarnings("ignore:invalid value")
def test_every_adaptive_method_comes_to_an_end(method, f):
    explicit = float(method != "LSODA")
    with suppress(FloatingPointError):
        simulate(Counted(f), [0.0], [explicit], [0, 10], method, 1e-6, 1e-9)


def method_is_explicit(u):
    return u[0] == 1


def test_a_long_run_is_no_standstill():
    """Many windows of calls, at one pace."""
    f = Counted(lambda x, u: np.stack([x[..., 1], -x[..., 0]], axis=-1))
    x = simulate(f, [1.0, 0.0], 0.0, [0, 200], "RK45", 1e-8, 1e-10)
    assert f.calls > 4 * WINDOW
    np.testing.assert_allclose(x[-1], [np.cos(200), -np.sin(200)], atol=1e-4)


def test_an_overflow_in_plain_python_is_the_same_error():
    with pytest.raises(FloatingPointError, match=r"stopped being finite at t = 0\.1 s"):
        simulate(lambda x, u: [float(x[0]) ** 90], [10.0], 0.0, [0, 0.1, 0.2])


def test_too_large_a_step_for_an_arm_says_when():
    with pytest.raises(FloatingPointError, match=r"the state stopped being finite at t = \d+"):
        simulate(ARM.state_derivative, [1.0, 1.0, 50.0, -90.0], FREE, np.arange(0, 100, 5.0))


def test_a_singular_arm_is_not_simulated():
    arm = Planar2R(1, 1, 0.5, 0, 1, 1, 0, 0)
    with pytest.raises(np.linalg.LinAlgError, match=r"M\(q\) is singular"):
        simulate(arm.state_derivative, START, FREE, [0, 0.1])


def simulate_with(**changes):
    arguments = {"f": ARM.state_derivative, "x0": START, "u": FREE, "t": [0.0, 0.1, 0.2]}
    return simulate(**arguments | changes)


BAD = {
    "x0 too short": ({"x0": [1.0, 0.0, 0.0]}, r"^f\(x0, u\).*x: got shape \(3,\).*\(\.\.\., 4\)"),
    "x0 scalar": ({"x0": 1.0}, r"^x0: got shape \(\)"),
    "x0 empty": ({"x0": []}, r"^x0: got shape \(0,\)"),
    "x0 nan": ({"x0": [0.0, np.nan, 0.0, 0.0]}, r"^x0\[1\] = nan"),
    "x0 none": ({"x0": None}, r"^x0 = None"),
    "x0 text": ({"x0": "abcd"}, r"^x0 = 'abcd'"),
    "x0 complex": ({"x0": [1j, 0, 0, 0]}, r"^x0 = .*not complex128"),
    "x0 odd": (
        {"x0": [1.0], "f": lambda x, u: -x, "method": "semi_implicit_euler"},
        r"^x0: got shape \(1,\); semi_implicit_euler needs \(\.\.\., 2n\)",
    ),
    "u too long": ({"u": [0.0, 0.0, 0.0]}, r"u: got shape \(3,\).*\(\.\.\., 2\)"),
    "u scalar": ({"u": 0.0}, r"u: got shape \(\)"),
    "u nan": ({"u": [0.0, np.nan]}, r"^u\[1\] = nan"),
    "u rows": ({"u": np.zeros((2, 2))}, r"^u: got shape \(2, 2\), .*one row per time, \(\.\.\., 3"),
    "u none": ({"u": None}, r"^u = None"),
    "u function shape": ({"u": lambda t, x: [0.0]}, r"u: got shape \(1,\).*\(\.\.\., 2\)"),
    "u function batch": (
        {"u": lambda t, x: np.zeros((5, 2))},
        r"f\(x, u\) at t = 0 s: got shape \(5, 4\), needs that of x, \(4,\)",
    ),
    "u function none": ({"u": lambda t, x: None}, r"u\(t, x\) = None"),
    "u function late": (
        {"u": lambda t, x: np.zeros(2 if t < 0.15 else 3)},
        r"u: got shape \(3,\)",
    ),
    "u function nan": ({"u": lambda t, x: [np.nan, 0.0]}, r"^f\(x0, u\) at t = 0 s.*needs finite"),
    "f shape": ({"f": lambda x, u: x[:2]}, r"got shape \(2,\), needs that of x, \(4,\)"),
    "f none": ({"f": lambda x, u: None}, r"f\(x, u\) at t = 0 s = None"),
    "f late": (
        {"f": lambda x, u: x if x[0] < 0.42 else x[:1]},
        r"f\(x, u\) at t = 0\.\d+ s: got shape \(1,\)",
    ),
    "t back": ({"t": [0.0, 0.2, 0.1]}, r"^t: .*t\[2\] = 0\.1 s follows t\[1\] = 0\.2 s"),
    "t repeated": ({"t": [0.0, 0.0]}, r"^t: needs increasing times"),
    "t alone": ({"t": [0.0]}, r"^t: got shape \(1,\), needs two or more"),
    "t scalar": ({"t": 1.0}, r"^t: got shape \(\)"),
    "t table": ({"t": [[0.0, 1.0]]}, r"^t: got shape \(1, 2\)"),
    "t nan": ({"t": [0.0, np.nan]}, r"^t\[1\] = nan"),
    "t inf": ({"t": [0.0, np.inf]}, r"^t\[1\] = inf"),
    "t text": ({"t": "now"}, r"^t = 'now'"),
    "method": ({"method": "heun"}, r"^method = 'heun': needs one of euler, .*rk4, .*RK45"),
    "implicit method": ({"method": "BDF"}, r"^method = 'BDF': needs"),
    "method none": ({"method": None}, r"^method = None: needs"),
    "atol": ({"method": "RK45", "atol": -1e-3}, r"^atol = -0\.001"),
    "rtol": ({"method": "RK45", "rtol": -1e-3}, r"^rtol = -0\.001"),
}


@pytest.mark.parametrize(("changes", "says"), BAD.values(), ids=BAD)
def test_bad_input_is_named(changes, says):
    with pytest.raises(ValueError, match=says):
        simulate_with(**changes)


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"x": [np.nan]}, r"^x\[0\] = nan"),
        ({"x": None}, r"^x = None"),
        ({"dt": np.inf}, r"^dt = inf"),
        ({"dt": "1"}, r"^dt = '1'"),
        ({"f": lambda x, u: [1.0, 2.0]}, r"^f\(x, u\): got shape \(2,\), needs that of x, \(1,\)"),
    ],
)
def test_rk4_step_names_bad_input(changes, says):
    with pytest.raises(ValueError, match=says):
        rk4_step(**{"f": lambda x, u: -x, "x": [1.0], "u": 0.0, "dt": 0.1} | changes)


@pytest.mark.parametrize("x", [START, np.zeros((3, 2)), np.zeros((0, 4)), None])
def test_energy_drift_needs_states_over_time(x):
    with pytest.raises(ValueError, match=r"^x"):
        energy_drift(ARM, x)


def test_integers_are_numbers_and_the_start_is_not_changed():
    x0 = np.array([1, 0])
    x = simulate(Pendulum(1, 1, 1).state_derivative, x0, [0], [0, 1, 2])
    assert x.dtype == float
    np.testing.assert_array_equal(x0, [1, 0])
