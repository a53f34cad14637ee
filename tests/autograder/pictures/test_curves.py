"""Curves of a student's answer against the right one: their numbers, their words, their axes."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest

from armdyn import Planar2R
from armdyn.simulate import energy_drift, rk4_step, simulate
from autograder.pictures.curves import POINTS, curves_of
from autograder.pictures.equations import NoMotionError
from autograder.pictures.plot import Axis, Line, document, plot
from autograder.problems import known_check
from autograder.problems.material import planar_2r
from autograder.problems.material.systems import FreeRun
from autograder.protocol import real
from tests.autograder.pictures.wrong import COSINE, UPWARD, function

SVG = "{http://www.w3.org/2000/svg}"
EULER = """
    states = [x0]
    for k in range(len(t) - 1):
        torque = u(t[k], states[-1]) if callable(u) else u
        states.append(states[-1] + (t[k + 1] - t[k]) * f(states[-1], torque))
    return np.array(states)
"""
MIDPOINT = "x + dt * f(x + dt / 2 * f(x, u), u)"
ONE_MASS = """
    E = [arm.m1 * arm.lc1 * np.sin(q1) * arm.g for q1 in x[:, 0]]
    return np.array(E) - E[0]
"""


def drawn(id: str, body: str):
    """The curves, and the call from which they start."""
    check = known_check(id)
    calls = check.calls(np.random.default_rng(3), 6)
    return curves_of(check)(check, function(id, body), calls[0], calls), calls


def test_gravity_goes_round_with_the_other_angle_held():
    curves, calls = drawn("p4-g_vec", UPWARD)
    q0, arm = calls[0].args
    i = int(curves.y.label[1]) - 1
    assert curves.x.label == f"q{i + 1} (rad)"
    assert curves.y.label == f"g{i + 1} (N·m)"
    assert len(curves.right.x) == POINTS + 1
    assert (curves.right.x[0], curves.right.x[-1]) == (-np.pi, np.pi)
    for angle, right, theirs in zip(curves.right.x, curves.right.y, curves.theirs.y, strict=True):
        q = q0.copy()
        q[i] = angle
        exact = Planar2R(**vars(arm)).g_vec(q)[i]
        assert (right, theirs) == pytest.approx((exact, -exact))
    held = f"q{2 - i} = {q0[1 - i]:.3g} rad".replace("-", "−")
    assert curves.title == f"g{i + 1} over q{i + 1}, with {held}"


@pytest.mark.parametrize(
    ("body", "said"),
    [
        (
            "-pend.m * pend.g * pend.lc * np.sin(q)",
            "Your curve is the right one turned upside down.",
        ),
        (COSINE, "Your curve is the right one, moved 90° to the left."),
        (f"-{COSINE}", "Your curve is the right one, moved 90° to the right."),
        (
            "2 * pend.m * pend.g * pend.lc * np.sin(q)",
            "Your curve is 2 times as high as the right one everywhere.",
        ),
        (
            "pend.m * pend.g * pend.lc + 0 * q",
            "Your curve does not change with q; the right one does.",
        ),
        (
            "pend.m * pend.g * pend.lc * np.sin(q) - 0.5",
            "Your curve is 0.5 N·m below the right one everywhere.",
        ),
        ("pend.m * pend.g * pend.lc * q", "They are furthest apart at q = −3.14 rad: yours is −"),
        (
            "q**3 + q",
            "They are furthest apart at q = −3.14 rad: yours is −34.1 N·m, the right one 0 N·m.",
        ),
    ],
)
def test_likeness_is_said_where_it_holds(body, said):
    (sentence,) = drawn("p3-g_vec", body)[0].said
    assert sentence.startswith(said)


@pytest.mark.parametrize("wrong", ["1.001 *", "1e-3 * pend.g +", "np.cos(q) * 1e-3 +"])
def test_likeness_is_not_said_where_it_nearly_holds(wrong):
    body = f"{wrong} -pend.m * pend.g * pend.lc * np.sin(q)"
    (sentence,) = drawn("p3-g_vec", body)[0].said
    assert "turned upside down" not in sentence


def test_a_constant_in_the_potential_energy_is_no_difference():
    body = "arm.g * arm.m1 * arm.lc1 * np.sin(q[0]) + 1000"
    curves, calls = drawn("p4-potential_energy", body)
    (arm, q0) = calls[0].args[-1], calls[0].args[0]
    exact = []
    for angle in curves.right.x:
        q = q0.copy()
        q[["q1", "q2"].index(curves.x.label[:2])] = angle
        exact.append(planar_2r.potential_energy(q, arm))
    np.testing.assert_allclose(curves.right.y, np.array(exact) - exact[0], atol=1e-9)
    assert np.max(np.abs(curves.theirs.y)) < 500


def test_the_drift_is_that_of_armdyns_motion():
    curves, calls = drawn("p5-energy_drift", ONE_MASS)
    x, arm = calls[0].args
    model = Planar2R(**vars(arm))
    states = simulate(model.state_derivative, x[0], [0, 0], curves.right.x)
    exact = energy_drift(model, states)
    np.testing.assert_allclose(curves.right.y, exact, atol=1e-6)
    theirs = function("p5-energy_drift", ONE_MASS)(states, arm)
    np.testing.assert_allclose(curves.theirs.y, theirs, atol=1e-6)
    (said,) = curves.said
    assert f"yours is at {curves.theirs.y[-1]:.3g} J".replace("-", "−") in said


def test_the_energy_of_a_free_run_is_that_of_their_states():
    curves, calls = drawn("p5-simulate", EULER)
    free = next(call for call in calls if isinstance(call, FreeRun))
    f, x0, u, _ = map(real, free.args)
    np.testing.assert_allclose(curves.right.y, 1.0, atol=1e-4)
    states = simulate(f, x0, u, curves.theirs.x, method="euler")
    np.testing.assert_allclose(curves.theirs.y, free.energy(states) / free.energy(x0[None]))
    (said,) = curves.said
    assert said.startswith("After ")
    assert f"yours is at {curves.theirs.y[-1]:.3g}" in said


def test_the_error_of_a_step_falls_with_the_order_of_the_method():
    curves, calls = drawn("p5-rk4_step", MIDPOINT)
    smooth = next(call for call in calls if "x[" in call.args[0].returns)
    f, x, u, _ = map(real, smooth.args)
    for dt, right, theirs in zip(curves.right.x, curves.right.y, curves.theirs.y, strict=True):
        exact = simulate(f, x, u, [0, dt], method="DOP853", rtol=1e-13)[-1]
        size = max(np.max(np.abs(exact)), 1)
        own = np.max(np.abs(function("p5-rk4_step", MIDPOINT)(f, x, u, dt) - exact)) / size
        assert theirs == pytest.approx(own, rel=1e-3, abs=1e-12)
        rk4 = np.max(np.abs(rk4_step(f, x, u, dt) - exact)) / size
        assert right == pytest.approx(rk4, rel=1e-2, abs=1e-11)
    (said,) = curves.said
    own, rk4 = map(float, re.findall(r"by ([\d.]+)", said))
    assert own == pytest.approx(8, rel=0.15)
    assert rk4 == pytest.approx(32, rel=0.15)


def test_a_right_step_is_called_as_good():
    body = """
    k1 = f(x, u); k2 = f(x + dt / 2 * k1, u); k3 = f(x + dt / 2 * k2, u); k4 = f(x + dt * k3, u)
    return x + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    """
    assert drawn("p5-rk4_step", body)[0].said == ("On this system your step is as good as RK4's.",)


def test_a_curve_that_cannot_be_drawn_says_why():
    with pytest.raises(NoMotionError, match=r"g_vec\(q, pend\) raised KeyError: 'm'"):
        drawn("p3-g_vec", "if q[0] < -3: raise KeyError('m')\nreturn q")
    with pytest.raises(NoMotionError, match=r"more than 0\.3 s of computing"):
        drawn("p3-g_vec", "while True:\n    pass\nreturn q")


def texts(svg: str) -> list[str]:
    return [element.text for element in ElementTree.fromstring(svg).iter(f"{SVG}text")]


def test_a_plot_has_units_ticks_labels_and_both_lines():
    curves, _ = drawn("p3-g_vec", COSINE)
    svg = curves.svg('Two "curves" & <more>')
    root = ElementTree.fromstring(svg)
    assert root.get("aria-label") == 'Two "curves" & <more>'
    assert root.get("role") == "img"
    written = texts(svg)
    assert {"right", "yours", "q (rad)", "g (N·m)", "−2", "0", "2"} <= set(written)
    paths = [p for p in root.iter(f"{SVG}path") if p.get("stroke-width") == "2.2"]
    assert sorted(p.get("stroke-dasharray", "") for p in paths) == ["", "7 4"]
    # In colours of the page's theme: nothing but the two lines has one of its own.
    assert len(svg) < 8000
    fills = {e.get("fill") for e in root.iter(f"{SVG}text")}
    assert fills == {"currentColor"}


@pytest.mark.parametrize(
    "y", [np.zeros(9), np.full(9, np.nan), np.linspace(0, 1e308, 9), np.array([1.0] * 8 + [np.inf])]
)
def test_a_plot_holds_what_is_not_finite_or_does_not_change(y):
    x = np.linspace(0, 1, 9)
    lines = [Line("right", x, x), Line("yours", x, y, is_theirs=True)]
    svg = document(plot(lines, Axis("x (m)"), Axis("y (m)"), 300, 150), 300, 150, "two lines")
    assert "nan" not in svg
    assert "inf" not in svg
    assert len(texts(svg)) > 5


def test_ends_that_meet_are_labelled_where_the_lines_are_apart():
    x = np.linspace(0, np.pi, 41)
    lines = [Line("right", x, np.sin(x)), Line("yours", x, -np.sin(x), is_theirs=True)]
    svg = document(plot(lines, Axis("x"), Axis("y"), 400, 200), 400, 200, "two lines")
    at = {e.text: float(e.get("x")) for e in ElementTree.fromstring(svg).iter(f"{SVG}text")}
    assert at["right"] == at["yours"] == pytest.approx((58 + 342) / 2, abs=1)
