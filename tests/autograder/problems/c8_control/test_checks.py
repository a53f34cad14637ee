"""What only c8-control asks: closed loops, whose plant stays with the judge, and the rate of V."""

from types import SimpleNamespace

import numpy as np
import pytest

from armdyn import Planar2R
from armdyn.regressor import parameters, regressor
from armdyn.simulate import simulate
from autograder.judging.check import HIDDEN_CASES, VISIBLE_CASES
from autograder.judging.loops import Loop
from autograder.judging.verdict import State
from autograder.problems import CHECKS
from autograder.problems.c8_control import loops, mistakes, rate_mistakes, regressor_mistakes
from autograder.problems.c8_control.checks import LEAST_RISE, MORE_ERROR, NEAR, SLOW
from autograder.problems.material import planar_2r, sampling
from autograder.problems.material.driven_arm import STEP, Arm
from autograder.protocol import real
from tests.autograder.course_problems import problem
from tests.autograder.problems.c8_control.table import hold
from tests.autograder.verdicts import judged, judged_in

PROBLEM = problem("c8-control")
WITH_LOOPS = ("c8-gravity_compensation", "c8-slotine_li")


def calls_of(check_id, seed=0, count=HIDDEN_CASES):
    return CHECKS[check_id].calls(np.random.default_rng(seed), count)


@pytest.mark.parametrize("seed", range(5))
def test_the_simulated_arm_is_that_of_the_library(seed):
    rng = np.random.default_rng(seed)
    arm, u = sampling.planar_2r(rng), rng.normal(0, 3, 2)
    x = np.concatenate([sampling.angles(rng), sampling.velocities(rng)])
    body = Arm(arm, x[:2], x[2:])
    model = Planar2R(**vars(arm))
    np.testing.assert_allclose(body.rate(tuple(x), u), model.state_derivative(x, u), rtol=1e-9)
    for _ in range(5):
        body.move(u)
    expected = simulate(model.state_derivative, x, u, STEP * np.arange(6))
    np.testing.assert_allclose(body.state, expected[-1], rtol=1e-9)


def test_the_regressor_is_that_of_the_library():
    for q, qd, qd_r, qdd_r, known in (call.args for call in calls_of("c8-regressor_r")):
        arm = sampling.planar_2r(np.random.default_rng(1))
        arm = planar_2r.changed(arm, **vars(known))
        model = Planar2R(**vars(arm))
        theirs = regressor(model, q, qd, qdd_r, qd_r) @ parameters(model)
        ours = regressor_mistakes.regressor_r(q, qd, qd_r, qdd_r, known) @ planar_2r.parameters(arm)
        np.testing.assert_allclose(ours, theirs, rtol=1e-9)


@pytest.mark.parametrize("seed", range(5))
def test_a_payload_is_a_part_of_link_2(seed):
    arm = sampling.planar_2r(np.random.default_rng(seed))
    added = planar_2r.parameters(planar_2r.with_payload(arm, 0.7)) - planar_2r.parameters(arm)
    np.testing.assert_allclose(added, 0.7 * np.array([0, 0, 0, 1, arm.l2, arm.l2**2]), atol=1e-14)


@pytest.mark.parametrize("check_id", ["c8-regressor_r", "c8-slotine_li"])
def test_no_mass_and_no_payload_goes_to_the_student(check_id):
    """Not in any step of a closed loop either."""
    given = []

    def spy(*args):
        given.append(args)
        return CHECKS[check_id].reference(*args)

    assert judged_in({CHECKS[check_id].name: spy}, check_id).state is State.CORRECT
    assert len(given) > (150 if check_id in WITH_LOOPS else 11)
    assert all(set(vars(args[-1])) == {"l1", "l2", "g"} for args in given)


@pytest.mark.parametrize("seed", range(6))
def test_the_right_controller_has_room_in_every_loop(seed):
    """So that what is required never lies at the edge of what it does."""
    for call in calls_of("c8-gravity_compensation", seed):
        if isinstance(call, Loop):
            assert np.all(call.right[:2] < 0.7 * np.array([NEAR, SLOW]))
            assert not call.right[2]
    for call in calls_of("c8-slotine_li", seed):
        if isinstance(call, Loop):
            error, rise, lost = call.right
            assert not lost
            assert rise < 0.5 * LEAST_RISE
            without = loops.loop(call.name, call.plant, loops.NO_ADAPTATION).right
            assert without[0] > 1.5 * MORE_ERROR * error
            assert without[1] > 2 * LEAST_RISE


def figures_of(controller, loop):
    """What a controller leaves in a loop of the check."""
    run = loop.begin()
    while (args := run.args()) is not None:
        run.tell(np.asarray(controller(*map(real, args)), dtype=float))
    return run.figures()


@pytest.mark.parametrize("seed", range(4))
def test_what_is_said_of_gravity_at_the_goal_is_true(seed):
    """A stiff spring brings the arm to q* all the same; a soft one lets it fall from upright."""
    at_goal = mistakes.hold(gravity=lambda w: planar_2r.g_vec(w.q_star, w.arm))
    upright = loops.to_upright(np.random.default_rng(seed))
    q, _, q_star, soft = upright.args
    assert figures_of(at_goal, upright)[0] > 10 * NEAR
    stiff = planar_2r.changed(soft, kp=4 * soft.kp, kd=2 * soft.kd)
    model = Planar2R(
        **{name: value for name, value in vars(soft).items() if name not in ("kp", "kd")}
    )
    x = simulate(
        model.state_derivative,
        [*q, 0, 0],
        lambda t, x: at_goal(x[:2], x[2:], q_star, stiff),
        0.002 * np.arange(3001),
    )
    np.testing.assert_allclose(x[-1, :2], q_star, atol=NEAR)


def test_a_right_torque_that_is_late_fails_in_the_loop_alone():
    """Code that remembers: its numbers are right where each call stands for itself."""
    sent = {}

    def late(q, qd, q_star, arm):
        queue = sent.setdefault(q_star.tobytes(), [])
        queue.append(mistakes.to_goal(q, qd, q_star, arm))
        return queue[max(0, len(queue) - 20)]

    verdict = judged_in({"gravity_compensation": late}, "c8-gravity_compensation", 0, VISIBLE_CASES)
    assert [row.met for row in verdict.rows] == [True, True, True, False]
    assert verdict.credit == 0.75
    assert len(verdict.diagnosis) == 1
    assert "closed loop" in verdict.diagnosis[0]


def test_an_error_in_a_step_is_shown_with_that_step():
    body = hold(first="if np.any(qd) and max(abs(qd)) < 0.2:\n    raise ValueError('slow')\n")
    verdict = judged("c8-gravity_compensation", body)
    assert verdict.state is State.ERROR
    assert "ValueError: slow" in verdict.problem
    assert 0 < np.max(np.abs(verdict.failed.of.args[1])) < 0.2


@pytest.mark.parametrize(
    "value", ["np.full(2, np.nan)", "1e300 * np.ones(2)", "1e8 * np.ones(2)", "np.ones(3)"]
)
def test_a_loop_that_is_lost_ends_and_is_told(value):
    """Whatever comes back while the arm moves; at rest the answer is right."""
    body = hold(first=f"if np.any(qd) and max(abs(qd)) < 0.2:\n    return {value}\n")
    verdict = judged("c8-gravity_compensation", body, 0, VISIBLE_CASES)
    assert [row.met for row in verdict.rows] == [True, True, True, False]
    assert "loses the arm" in verdict.diagnosis[0]
    assert "closed loop that begins here" in verdict.witness.returned


def test_V_dot_is_the_slope_of_V():
    """Along the closed loop with known parameters, for any valid C in the controller."""
    rng = np.random.default_rng(4)
    for _ in range(10):
        arm, q, qd = sampling.planar_2r(rng), sampling.angles(rng), sampling.velocities(rng)
        s, KD = rng.normal(size=2), np.diag(rng.uniform(1, 3, 2))
        C_used = another_C(rng, q, qd, arm)
        gains = SimpleNamespace(KD=KD)
        sd = np.linalg.solve(planar_2r.M(q, arm), -(C_used + KD) @ s)
        dt = 1e-5

        def V(t, q=q, qd=qd, s=s, sd=sd, arm=arm):
            at = s + t * sd
            return at @ planar_2r.M(q + t * qd, arm) @ at / 2

        slope = (V(dt) - V(-dt)) / (2 * dt)
        assert rate_mistakes.rate_of_V(q, qd, s, C_used, gains, arm) == pytest.approx(
            slope, rel=1e-6
        )


def another_C(rng, q, qd, arm):
    C_used = rate_mistakes.valid_C(q, qd, arm, *rng.normal(size=2))
    np.testing.assert_allclose(C_used @ qd, planar_2r.C(q, qd, arm) @ qd)
    return C_used


def test_released_notebook_says_what_comes_first():
    graded = PROBLEM.graded("blank")
    printed = [o.text for c in graded.notebook.cells for o in c.get("outputs", []) if "text" in o]
    assert any("first, then run this cell again" in text for text in printed)
