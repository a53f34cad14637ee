"""Inputs sampled over time, events on the way, and many arms at once."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from armdyn import Pendulum, Planar2R
from armdyn.integrators import INTEGRATORS
from armdyn.simulate import SCIPY_METHODS, Event, Trajectory, simulate
from tests.armdyn.arms import a_few

PENDULUM = Pendulum(m=1.0, lc=0.5, I=0.3, viscous=0.1)
ARM = Planar2R(1.0, 0.8, 0.5, 0.4, 2.0, 1.5, 0.2, 0.1, viscous=(0.5, 0.3))
GRAVITY = 9.81
METHODS = (*(name for name, one in INTEGRATORS.items() if not one.of_model), *SCIPY_METHODS)

methods = pytest.mark.parametrize("method", METHODS)


def fall(x, u):
    """A ball in free fall, x = [height; velocity]."""
    return np.stack([x[..., 1], np.full_like(x[..., 1], -GRAVITY)], axis=-1)


def height(t, x):
    return x[0]


def thrown(method, events, t, speed=3.0):
    return simulate(fall, [1.0, speed], 0.0, t, method, events=events)


@methods
def test_a_sampled_input_is_held_from_its_time_to_the_next(method):
    # ẋ = u: the integral of the steps, exact for every method that does not step across a jump.
    t = np.array([0.0, 0.1, 0.3, 0.35, 1.0])
    u = np.array([[1.0, 0.0], [1.0, 0.0], [-4.0, 2.0], [0.0, 7.0], [np.pi, -9.0]])
    x = simulate(lambda x, u: u, [0.0, 0.5], u, t, method)
    sums = np.cumsum(u[:-1] * np.diff(t)[:, np.newaxis], axis=0)
    np.testing.assert_allclose(x, np.vstack([[0, 0], sums]) + np.array([0, 0.5]), atol=1e-10)


@methods
def test_equal_samples_are_a_constant(method):
    t = np.linspace(0, 0.05, 6)
    constant = simulate(ARM.state_derivative, [0.4, -0.7, 0.5, 1.0], [2.0, -1.0], t, method)
    rows = np.tile([2.0, -1.0], (6, 1))
    sampled = simulate(ARM.state_derivative, [0.4, -0.7, 0.5, 1.0], rows, t, method)
    np.testing.assert_array_equal(sampled, constant)


@pytest.mark.parametrize("method", ["rk4", "DOP853"])
def test_samples_of_an_arm_are_runs_one_after_the_other(method):
    t = np.linspace(0, 0.3, 7)
    u = np.random.default_rng(3).normal(0, 5, (7, 2))
    x = simulate(ARM.state_derivative, [0.4, -0.7, 0.5, 1.0], u, t, method)
    for k, (start, end) in enumerate(itertools.pairwise(t)):
        alone = simulate(ARM.state_derivative, x[k], u[k], [start, end], method)[-1]
        np.testing.assert_allclose(x[k + 1], alone, atol=1e-9)


@methods
def test_many_arms_have_their_own_inputs(method):
    t = np.linspace(0, 0.04, 5)
    x0 = np.random.default_rng(0).uniform(-1, 1, (3, 4))
    constants = np.array([[3.0, 0.0], [0.0, -2.0], [1.0, 1.0]])
    x = simulate(ARM.state_derivative, x0, constants[:, np.newaxis], t, method)
    rows = constants[:, np.newaxis] * np.linspace(1, 2, 5)[:, np.newaxis]
    sampled = simulate(ARM.state_derivative, x0, rows, t, method)
    assert x.shape == sampled.shape == (3, 5, 4)
    for i in range(3):
        alone = simulate(ARM.state_derivative, x0[i], constants[i], t, method)
        np.testing.assert_allclose(x[i], alone, atol=1e-8)
        alone = simulate(ARM.state_derivative, x0[i], rows[i], t, method)
        np.testing.assert_allclose(sampled[i], alone, atol=1e-8)


@pytest.mark.parametrize("method", SCIPY_METHODS)
def test_each_of_many_arms_keeps_the_tolerance(method):
    """One lively arm among many at rest: an average over all would hide its error."""
    still, lively = np.zeros((200, 2)), [[0.1, 14.0]]
    x0 = np.concatenate([still, lively])
    t = [0, 1.0]
    x = simulate(PENDULUM.state_derivative, x0, [0.0], t, method, 1e-5, 1e-8)[-1, -1]
    alone = simulate(PENDULUM.state_derivative, lively[0], [0.0], t, "DOP853", 1e-12)[-1]
    own = simulate(PENDULUM.state_derivative, lively[0], [0.0], t, method, 1e-5, 1e-8)[-1]
    assert np.max(np.abs(x - alone)) <= 2 * np.max(np.abs(own - alone)) + 1e-9


@pytest.mark.parametrize("method", ["rk4", "implicit_midpoint", "RK45", "DOP853", "LSODA"])
def test_an_event_is_where_the_parabola_says(method):
    t = np.linspace(0, 2, 9)
    top = (3.0 / GRAVITY, 1 + 3.0**2 / 2 / GRAVITY)
    ground = (3 + np.sqrt(9 + 2 * GRAVITY)) / GRAVITY
    run = thrown(method, [height, lambda t, x: x[1]], t)
    assert isinstance(run, Trajectory)
    assert run.event_times[0] == pytest.approx([ground])
    assert run.event_times[1] == pytest.approx([top[0]])
    assert run.event_states[1][0] == pytest.approx([top[1], 0], abs=1e-9)
    np.testing.assert_array_equal(run.t, t)
    np.testing.assert_array_equal(run.x, simulate(fall, [1.0, 3.0], 0.0, t, method))
    assert run.stopped_by is None


@methods
def test_a_terminal_event_ends_the_run_there(method):
    t = np.linspace(0, 2, 201)
    run = thrown(method, [lambda t, x: x[0] + 5, Event(height, terminal=True)], t)
    landed = run.event_times[1][0]
    assert run.stopped_by == 1
    assert run.t[-1] == landed
    assert t[len(run.t) - 2] < landed < t[len(run.t) - 1]
    np.testing.assert_array_equal(run.t[:-1], t[: len(run.t) - 1])
    assert run.x[-1, 0] == pytest.approx(0, abs=1e-9)
    np.testing.assert_array_equal(run.x[-1], run.event_states[1][0])
    assert run.x.shape == (len(run.t), 2)
    assert run.event_times[0].shape == (0,)
    assert run.event_states[0].shape == (0, 2)
    assert landed == pytest.approx((3 + np.sqrt(9 + 2 * GRAVITY)) / GRAVITY, abs=0.02)


@pytest.mark.parametrize("method", ["rk4", "RK45"])
@pytest.mark.parametrize(("direction", "seen"), [(0, [0, 1, 2, 3]), (1, [1, 3]), (-1, [0, 2])])
def test_direction_chooses_rising_or_falling(method, direction, seen):
    # cos t passes zero at π/2, 3π/2, …, falling first.
    def turn(x, u):
        return np.array([x[1], -x[0]])

    t = np.linspace(0, 12, 241)
    run = simulate(turn, [1.0, 0.0], 0.0, t, method, events=Event(height, direction))
    np.testing.assert_allclose(run.event_times[0], np.pi / 2 + np.pi * np.array(seen), atol=1e-5)


@pytest.mark.parametrize("method", ["euler", "rk4", "RK45"])
def test_an_event_on_a_sample_is_one_event(method):
    """g is zero exactly at the end of a step: it belongs to that step and not to the next too."""
    t = np.array([0.0, 0.5, 1.0, 1.5])
    u = np.array([[1.0], [1.0], [2.0], [0.0]])
    run = simulate(lambda x, u: u, [-1.0], u, t, method, events=lambda t, x: x[0])
    assert run.event_times[0] == pytest.approx([1.0], abs=1e-9)


def test_a_start_at_zero_is_no_event():
    run = simulate(fall, [0.0, 3.0], 0.0, np.linspace(0, 1, 11), events=height)
    assert run.event_times[0] == pytest.approx([6 / GRAVITY])


def test_only_the_first_of_two_terminal_events_counts():
    late = Event(lambda t, x: t - 0.46, terminal=True)
    early = Event(lambda t, x: t - 0.41, terminal=True)
    run = thrown("rk4", [late, early], np.linspace(0, 1, 11))
    assert run.stopped_by == 1
    assert run.t[-1] == pytest.approx(0.41)
    assert [len(times) for times in run.event_times] == [0, 1]


@a_few
@given(st.floats(0.2, 3), st.sampled_from(["rk4", "DOP853"]))
def test_a_pendulums_energy_at_its_turning_point_is_potential(q, method):
    free = Pendulum(m=1.0, lc=0.5, I=0.3)
    t = np.linspace(0, 1.5, 76)
    run = simulate(free.state_derivative, [q, -0.5], [0.0], t, method, events=lambda t, x: x[1])
    for x in run.event_states[0]:
        assert free.potential_energy(x[:1]) == pytest.approx(free.energy([q], [-0.5]), abs=1e-4)


@pytest.mark.parametrize(
    ("events", "x0", "says"),
    [
        ("height", [1.0, 0.0], r"^g = 'height': needs a function"),
        ([height], [[1.0, 0.0]], r"^events: for one arm"),
        (lambda t, x: x, [1.0, 0.0], r"^events\[0\]\.g at t = 0 s: got shape \(2,\), needs one"),
        (lambda t, x: None, [1.0, 0.0], r"^events\[0\]\.g at t = 0 s = None"),
        ([height, lambda t, x: np.nan], [1.0, 0.0], r"^events\[1\]\.g at t = 0 s = nan"),
    ],
)
def test_bad_events_are_named(events, x0, says):
    with pytest.raises(ValueError, match=says):
        simulate(fall, x0, 0.0, [0.0, 0.1], events=events)


def test_an_event_has_three_directions():
    with pytest.raises(ValueError, match=r"^direction = 2: needs −1, 0 or 1"):
        Event(height, direction=2)
