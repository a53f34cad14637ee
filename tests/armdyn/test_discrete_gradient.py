"""The energy–momentum method: energy to rounding, momentum where there is one, work to rounding."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from armdyn import Link, Pendulum, Planar2R, PlanarChain, SerialChain
from armdyn.codegen import numpy_model
from armdyn.derive import planar_2r
from armdyn.simulate import energy_drift, observed_order, simulate
from tests.armdyn.arms import arms_and_states, planar_arms, vectors

ARM = Planar2R(1.0, 0.8, 0.5, 0.4, 2.0, 1.5, 0.2, 0.1)
CHAIN = PlanarChain((0.5,) * 3, (0.25,) * 3, (1.0,) * 3, (0.02,) * 3, ly=(0.1, 0, -0.1))
BALL = np.diag([0.1, 0.2, 0.15])
# Joint 1 about the vertical: nothing depends on q1.
SPATIAL = SerialChain(
    (
        Link("revolute", 2.0, axis=(0, 0, 1), com=(0.1, 0.2, 0.05), inertia=BALL),
        Link(
            "revolute", 1.0, axis=(1, 0, 0), com=(0, 0.1, 0.3), inertia=BALL, translation=(0, 0, 1)
        ),
        Link("prismatic", 1.0, axis=(0, 0, 1), com=(0, 0.1, 0.1), inertia=BALL),
    )
)
NAMES = ("l1", "l2", "lc1", "lc2", "m1", "m2", "I1", "I2", "g")
GENERATED = numpy_model(planar_2r(), {name: getattr(ARM, name) for name in NAMES})


def run(model, x0, dt, steps, u=None):
    u = np.zeros(model.n) if u is None else u
    return simulate(model, x0, u, dt * np.arange(steps + 1), "energy_momentum")


def halves(model, x):
    return x[..., : model.n], x[..., model.n :]


def momenta(model, x):
    q, qd = halves(model, x)
    return np.matvec(model.M(q), qd)


@pytest.mark.parametrize(
    ("model", "dt", "steps"),
    [
        (ARM, 0.02, 400),
        (GENERATED, 0.02, 150),
        (CHAIN, 0.01, 150),
        (SPATIAL, 0.02, 30),
        (Pendulum(1.0, 0.5, 0.3), 0.1, 200),
    ],
    ids=["2R", "generated 2R", "chain", "spatial", "pendulum"],
)
def test_energy_stays_to_rounding(model, dt, steps):
    """A classical step of this size loses 1e-6 of it, and more."""
    x0 = np.concatenate([np.linspace(0.3, 1.1, model.n), np.linspace(1.0, -0.4, model.n)])
    x = run(model, x0, dt, steps)
    swing = np.max(model.kinetic_energy(*halves(model, x)))
    assert np.max(np.abs(energy_drift(model, x))) < 1e-13 * np.sqrt(steps) * swing
    times = dt * np.arange(steps + 1)
    classical = simulate(model.state_derivative, x0, np.zeros(model.n), times, "rk4")
    assert np.max(np.abs(energy_drift(model, classical))) > 1e-8 * swing


@pytest.mark.parametrize(
    ("model", "steps"), [(ARM, 16), (CHAIN, 8), (SPATIAL, 4)], ids=["2R", "chain", "spatial"]
)
def test_order_two(model, steps):
    x0 = np.concatenate([np.linspace(0.3, 1.1, model.n), np.linspace(1.0, -0.4, model.n)])
    seen = observed_order(
        model, x0, np.full(model.n, 0.5), 0.01 * steps, "energy_momentum", steps, 2
    )
    assert seen.orders[-1] == pytest.approx(2, abs=0.1)


@pytest.mark.parametrize(
    ("model", "kept"),
    [
        (SPATIAL, True),
        (Planar2R(1.0, 0.8, 0.5, 0.4, 2.0, 1.5, 0.2, 0.1, g=0.0), True),
        (ARM, False),
    ],
    ids=["vertical axis", "no gravity", "gravity"],
)
def test_momentum_stays_where_nothing_turns_it(model, kept):
    x0 = np.concatenate([np.linspace(0.3, 1.1, model.n), np.linspace(1.0, -0.4, model.n)])
    p = momenta(model, run(model, x0, 0.02, 50))
    assert (np.ptp(p[:, 0]) < 1e-12) == kept
    assert np.ptp(p[:, 1]) > 1e-3


@settings(max_examples=10, deadline=None)
@given(arms_and_states(planar_arms(), parts=3))
def test_the_energy_gained_is_the_work_done(case):
    """(u − f)ᵀ Δq to rounding, with viscous and dry friction; the joints do not come to rest."""
    arm, q, qd, u = case
    qd = np.where(qd < 0, -2, 2) + qd
    x = np.concatenate([q, qd], axis=-1)
    dt = 2e-2 / (1 + np.max(np.abs(qd)))
    try:
        after = simulate(arm, x, u[..., np.newaxis, :], [0, dt], "energy_momentum")[..., 1, :]
    except FloatingPointError:  # the friction turned a joint back within the step
        return
    moved = after[..., :2] - q
    work = np.vecdot(u - arm.f_vec(moved / dt), moved)
    size = arm.kinetic_energy(q, qd) + np.abs(arm.potential_energy(q)) + np.max(np.abs(after))
    gained = arm.energy(*halves(arm, after)) - arm.energy(q, qd)
    assert np.all(np.abs(gained - work) <= 1e-12 * (size + np.max(arm.M(q)) * 36))


def test_a_long_step_through_thick_oil_loses_what_the_oil_takes():
    arm = Planar2R(1.0, 0.8, 0.5, 0.4, 2.0, 1.5, 0.2, 0.1, viscous=(2.0, 0.5))
    x = run(arm, [0.3, 0.4, 3.0, -5.0], 0.05, 10)
    moved = np.diff(x[:, :2], axis=0)
    lost = np.vecdot(arm.f_vec(moved / 0.05), moved)
    assert np.all(lost > 0)
    np.testing.assert_allclose(np.diff(energy_drift(arm, x)), -lost, atol=1e-13 * 50)


@settings(max_examples=15)
@given(vectors(4, 2.0), st.floats(0.001, 0.02))
def test_back_in_time_is_where_it_came_from(x, dt):
    there = run(ARM, x, dt, 1)[-1]
    # Backwards in time is forwards with the velocities turned round.
    back = run(ARM, there * [1, 1, -1, -1], dt, 1)[-1]
    np.testing.assert_allclose(back * [1, 1, -1, -1], x, atol=1e-11)


def test_many_arms_are_each_alone():
    x0 = np.array([[0.3, 0.1, 0.5, -0.4], [1.0, -2.0, 0.0, 0.3], [0.0, 0.0, 0.0, 0.0]])
    u = np.array([[1.0, 0.2], [0.0, 0.0], [-1.0, 2.0]])
    together = run(ARM, x0, 0.02, 5, u[:, np.newaxis, :])
    for k in range(3):
        np.testing.assert_allclose(together[k], run(ARM, x0[k], 0.02, 5, u[k]), atol=1e-12)


def test_at_rest_it_rests():
    x0 = np.array([-np.pi / 2, 0, 0, 0])
    np.testing.assert_allclose(run(ARM, x0, 0.1, 10), np.tile(x0, (11, 1)), atol=1e-14)
    free = Planar2R(1.0, 0.8, 0.5, 0.4, 2.0, 1.5, 0.2, 0.1, g=0.0)
    np.testing.assert_array_equal(run(free, 0 * x0, 0.1, 3), np.zeros((4, 4)))


def test_it_needs_the_arm_and_says_so():
    with pytest.raises(ValueError, match=r"^f: energy_momentum needs the arm, a Manipulator"):
        simulate(ARM.state_derivative, [0.0] * 4, [0.0, 0.0], [0, 1], "energy_momentum")
    with pytest.raises(
        FloatingPointError, match="energy_momentum did not converge in the step of 3"
    ):
        run(ARM, [1.0, 1.0, 5.0, -9.0], 3.0, 1)
    with pytest.raises(np.linalg.LinAlgError, match="singular"):
        run(Planar2R(1, 1, 0.5, 0, 1, 1, 0, 0), [0.1, 0.2, 0.3, 0.4], 0.01, 1)
    with pytest.raises(ValueError, match=r"u: got shape \(3,\)"):
        run(ARM, [0.0] * 4, 0.01, 1, [0.0, 0.0, 0.0])


@pytest.mark.parametrize("method", ["rk4", "DOP853"])
def test_an_arm_stands_for_its_state_form(method):
    x0, u, t = [0.3, 0.1, 0.5, -0.4], [0.1, 0.2], np.linspace(0, 0.3, 7)
    np.testing.assert_array_equal(
        simulate(ARM, x0, u, t, method), simulate(ARM.state_derivative, x0, u, t, method)
    )
