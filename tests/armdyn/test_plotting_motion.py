"""Traces, ellipses, landscapes and phase portraits: what is drawn is what the model says."""

import io
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from armdyn import Pendulum, Planar2R, PlanarChain, plotting
from armdyn.simulate import simulate
from tests.armdyn.arms import between

ARM = Planar2R(1.0, 0.8, 0.5, 0.4, 2.0, 1.5, 0.2, 0.1)
PENDULUM = Pendulum(m=1.0, lc=0.5, I=0.3, viscous=0.15)
CHAIN = PlanarChain((0.5, 0.4, 0.3), (0.25, 0.2, 0.1), (1.0,) * 3, (0.02,) * 3, ly=(0, 0.05, -0.1))

angles = st.floats(-2 * math.pi, 2 * math.pi)


def painted(fig):
    """Nothing may fail or warn while the figure is drawn either."""
    fig.savefig(io.BytesIO(), format="png")
    return fig


@settings(max_examples=20)  # each example draws a figure
@given(st.tuples(angles, angles, angles))
def test_a_chains_centres_have_its_potential_energy_and_its_links_their_lengths(q):
    _, ax = plotting.figure()
    plotting.draw_arm(ax, CHAIN, q)
    joints, centres = ax.lines[0].get_xydata(), ax.lines[-2].get_xydata()
    assert CHAIN.g * centres[:, 1] @ CHAIN.m == pytest.approx(
        float(CHAIN.potential_energy(q)), abs=1e-9
    )
    assert np.linalg.norm(np.diff(joints, axis=0), axis=1) == pytest.approx(CHAIN.l)
    assert np.all(np.linalg.norm(joints, axis=1) < ax.get_xlim()[1])
    assert np.all(np.linalg.norm(centres, axis=1) < ax.get_xlim()[1])


@given(angles, angles)
def test_a_chain_of_two_stands_as_the_2r(q1, q2):
    twin = PlanarChain((1.0, 0.8), (0.5, 0.4), (2.0, 1.5), (0.2, 0.1))
    assert plotting.tip(twin, [q1, q2]) == pytest.approx(plotting.tip(ARM, [q1, q2]))


def test_the_trace_is_the_way_of_the_tip():
    t = np.linspace(0, 0.5, 26)
    q = simulate(ARM.state_derivative, [0.4, -0.7, 0.5, 1.0], [0, 0], t)[:, :2]
    fig, ax = plotting.figure()
    plotting.draw_trace(ax, ARM, q)
    path, start, end = (line.get_xydata() for line in ax.lines)
    for k in (0, 10, 25):
        q1, q12 = q[k, 0], q[k].sum()
        assert path[k] == pytest.approx(
            [math.cos(q1) + 0.8 * math.cos(q12), math.sin(q1) + 0.8 * math.sin(q12)]
        )
    assert start[0] == pytest.approx(path[0])
    assert end[0] == pytest.approx(path[-1])
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("x (m)", "y (m)")
    painted(fig)


@pytest.mark.parametrize(
    ("lc", "I", "end"), [(0.5, 1 / 3, 1.0), (0.5, 0.25, 0.5), (0.2, 0.07, 0.5)]
)
def test_a_pendulum_is_as_long_as_the_rod_with_its_inertia(lc, I, end):
    # 1 kg: a rod of 1 m held at its end, a point mass, a rod of 0.6 m held 0.1 m below its upper end.
    tip = plotting.tip(Pendulum(m=1.0, lc=lc, I=I), np.array([[0.0], [math.pi / 2]]))
    assert tip == pytest.approx(np.array([[0, -end], [end, 0]]))


@settings(max_examples=20)  # each example draws a figure
@given(angles, between(0.1, 50))
def test_the_ellipse_holds_the_velocities_of_one_energy(q2, energy):
    _, ax = plotting.figure()
    q = np.array([0.3, q2])
    curve = plotting.draw_inertia_ellipse(ax, ARM.M(q), energy)
    assert ARM.kinetic_energy(q, curve) == pytest.approx(energy)
    drawn, *half_axes = (line.get_xydata() for line in ax.lines)
    np.testing.assert_array_equal(drawn, curve)
    assert np.ptp(np.arctan2(*curve.T)) > 6
    # The axes are the longest and the shortest radius, at a right angle.
    radii = np.linalg.norm(curve, axis=1)
    ends = [line[1] for line in half_axes]
    assert max(map(np.linalg.norm, ends)) == pytest.approx(radii.max(), rel=1e-3)
    assert min(map(np.linalg.norm, ends)) == pytest.approx(radii.min(), rel=1e-3)
    assert ends[0] @ ends[1] == pytest.approx(0, abs=1e-9 * radii.max() ** 2)
    assert "rad/s" in ax.get_xlabel()
    assert "rad/s" in ax.get_ylabel()


def test_ellipses_of_several_postures_are_told_apart_without_colour():
    fig = painted(plotting.inertia_ellipses(ARM, [[0.5, 0], [0.5, np.pi / 2], [0.5, np.pi]], 2.0))
    legend = fig.axes[1].get_legend()
    assert [text.get_text() for text in legend.get_texts()] == [
        "$q_2$ = 0°",
        "$q_2$ = 90°",
        "$q_2$ = 180°",
    ]
    assert len({line.get_linestyle() for line in legend.get_lines()}) == 3
    for k in range(3):
        ellipse = fig.axes[1].lines[3 * k].get_xydata()
        assert ARM.kinetic_energy([0.5, k * np.pi / 2], ellipse) == pytest.approx(2.0)


def test_the_landscape_is_the_potential_energy_with_its_equilibria():
    fig = painted(plotting.energy_landscape(ARM))
    ax, bar = fig.axes
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("$q_1$ (rad)", "$q_2$ (rad)")
    assert bar.get_ylabel() == "P (J)"
    top = ARM.potential_energy([np.pi / 2, 0])
    levels = ax.collections[0].levels
    assert levels[0] <= -top < levels[1]
    assert levels[-2] < top <= levels[-1]
    marks = {line.get_label(): (line.get_marker(), line.get_xydata()) for line in ax.lines}
    assert len({marker for marker, _ in marks.values()}) == 3
    half = np.pi / 2
    assert marks["equilibrium: minimum"][1] == pytest.approx(np.array([[-half, 0]]), abs=1e-6)
    assert marks["equilibrium: maximum"][1] == pytest.approx(np.array([[half, 0]]), abs=1e-6)
    saddles = sorted(map(tuple, marks["equilibrium: saddle"][1].round(6)))
    edges = [(-half, -np.pi), (-half, np.pi), (half, -np.pi), (half, np.pi)]
    assert np.array(saddles) == pytest.approx(np.array(edges), abs=1e-5)


def test_level_lines_of_the_landscape_are_levels():
    fig = plotting.energy_landscape(ARM, limits=(-1.0, 0.5))
    lines = fig.axes[0].collections[1]
    seen = 0
    for level, path in zip(lines.levels, lines.get_paths(), strict=True):
        for point in path.vertices:
            assert ARM.potential_energy(point) == pytest.approx(level, abs=0.02)
            seen += 1
    assert seen > 100
    assert fig.axes[0].get_xlim() == (-1.0, 0.5)
    assert not fig.axes[0].lines  # no equilibrium lies within


def test_ticks_of_angles_read_as_fractions_of_pi():
    fig = painted(plotting.energy_landscape(ARM, limits=(-2 * np.pi, np.pi)))
    axis = fig.axes[0].xaxis
    texts = axis.get_major_formatter().format_ticks(np.arange(-4, 4) * np.pi / 2)
    assert texts == ["−2π", "−3π/2", "−π", "−π/2", "0", "π/2", "π", "3π/2"]
    assert np.diff(axis.get_majorticklocs()) == pytest.approx(np.pi / 2)


def test_a_phase_portrait_flows_as_the_state_does():
    t = np.linspace(0, 3, 151)
    runs = [simulate(PENDULUM.state_derivative, x0, [0.0], t) for x0 in ([-2.9, 0.5], [-1.0, -6.0])]
    fig = painted(plotting.phase_portrait(PENDULUM, runs))
    ax = fig.axes[0]
    for segment in ax.collections[0].get_segments()[::25]:
        along = segment[-1] - segment[0]
        flow = PENDULUM.state_derivative(segment.mean(axis=0), [0.0])
        # A segment's direction is the flow's, in units of the axes.
        size = np.array([np.ptp(ax.get_xlim()), np.ptp(ax.get_ylim())])
        along, flow = along / size, flow / size
        if np.linalg.norm(along) > 1e-4:
            assert along @ flow > 0.98 * np.linalg.norm(along) * np.linalg.norm(flow)
    np.testing.assert_array_equal(ax.lines[0].get_xydata(), runs[0])
    np.testing.assert_array_equal(ax.lines[3].get_xydata(), runs[1])
    marks = {line.get_label(): line.get_xydata() for line in ax.lines if "equ" in line.get_label()}
    assert marks["equilibrium: minimum of P"] == pytest.approx(np.zeros((1, 2)), abs=1e-9)
    assert marks["equilibrium: maximum of P"] == pytest.approx(
        np.array([[-np.pi, 0], [np.pi, 0]]), abs=1e-6
    )
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("$q$ (rad)", r"$\dot q$ (rad/s)")


def test_the_default_range_of_velocities_holds_a_fall_from_the_top():
    free = Pendulum(m=1.0, lc=0.5, I=0.3)
    low, high = plotting.phase_portrait(free).axes[0].get_ylim()
    fastest = 3 / 4 * high
    assert free.energy([0.0], [fastest]) == pytest.approx(free.energy([np.pi], [0.0]), rel=1e-6)
    assert low == -high
    assert plotting.phase_portrait(free, qd_limit=2.5).axes[0].get_ylim() == (-2.5, 2.5)


def test_one_joint_of_many_in_the_phase_plane():
    x = np.arange(12.0).reshape(3, 4)
    fig, ax = plotting.figure()
    plotting.draw_phase(ax, ARM, x, joint=1, color="black")
    assert ax.lines[0].get_xydata() == pytest.approx(x[:, [1, 3]])
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("$q_2$ (rad)", r"$\dot q_2$ (rad/s)")
    painted(fig)


AX = plotting.figure()[1]
BAD = {
    "landscape joints": (lambda: plotting.energy_landscape(PENDULUM), "^model: needs two joints"),
    "landscape limits": (lambda: plotting.energy_landscape(ARM, (1, 0)), r"^limits = \(1, 0\)"),
    "portrait joints": (lambda: plotting.phase_portrait(ARM), "^model: needs one joint, has 2"),
    "portrait limits": (
        lambda: plotting.phase_portrait(PENDULUM, q_limits=(1, 1)),
        r"^q_limits = \(1, 1\)",
    ),
    "portrait top": (lambda: plotting.phase_portrait(PENDULUM, qd_limit=-1), "^qd_limit = -1"),
    "phase shape": (lambda: plotting.draw_phase(AX, ARM, np.zeros(4)), r"^x: got shape \(4,\)"),
    "phase joint": (lambda: plotting.draw_phase(AX, ARM, np.zeros((2, 4)), 2), "^joint = 2: needs"),
    "trace shape": (lambda: plotting.draw_trace(AX, ARM, [0, 0]), r"^q: got shape \(2,\)"),
    "ellipse shape": (lambda: plotting.draw_inertia_ellipse(AX, np.eye(3)), r"^M: got shape"),
    "ellipse skew": (lambda: plotting.draw_inertia_ellipse(AX, [[1, 1], [0, 1]]), "symmetric"),
    "ellipse flat": (lambda: plotting.draw_inertia_ellipse(AX, [[1, 1], [1, 1]]), "positive eig"),
    "ellipse energy": (lambda: plotting.draw_inertia_ellipse(AX, np.eye(2), 0), "^energy = 0"),
    "ellipses joints": (lambda: plotting.inertia_ellipses(CHAIN, [[0, 0]]), "^model: needs two"),
    "ellipses many": (lambda: plotting.inertia_ellipses(ARM, np.zeros((6, 2))), r"^qs: .*1 to 5"),
}


@pytest.mark.parametrize(("draw", "says"), BAD.values(), ids=BAD)
def test_bad_input_is_named(draw, says):
    with pytest.raises(ValueError, match=says):
        draw()
