"""The figures: what is drawn is where the kinematics says; a picture carries its description."""

import base64
import html
import io
import math
import subprocess
import sys

import matplotlib
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.figure import Figure
from PIL import Image

from armdyn import Manipulator, Pendulum, Planar2R, plotting

ARM = Planar2R(
    1.0, 0.8, 0.5, 0.3, 3.0, 2.0, 0.25, 0.11, viscous=(0.4, 0.2), coulomb=(0.3, 0.1)
)  # fmt: skip
PENDULUM = Pendulum(m=1.0, lc=0.5, I=0.3, viscous=0.1)

angles = st.floats(-2 * math.pi, 2 * math.pi)
rates = st.floats(-10, 10)


def drawn(model, q):
    """The axes after draw_arm, and its lines' points."""
    _, ax = plotting.figure()
    plotting.draw_arm(ax, model, q)
    return ax, [line.get_xydata() for line in ax.lines]


@settings(max_examples=20)  # each example draws a figure
@given(angles, angles)
def test_2r_links_have_their_lengths_and_angles(q1, q2):
    _, (links, *_) = drawn(ARM, [q1, q2])
    along = np.diff(links, axis=0)
    assert links[0] == pytest.approx([0, 0])
    assert along[0] == pytest.approx([ARM.l1 * math.cos(q1), ARM.l1 * math.sin(q1)], abs=1e-12)
    turned = [ARM.l2 * math.cos(q1 + q2), ARM.l2 * math.sin(q1 + q2)]
    assert along[1] == pytest.approx(turned, abs=1e-12)


@settings(max_examples=20)  # each example draws a figure
@given(angles, angles)
def test_drawn_centres_of_mass_have_the_models_potential_energy(q1, q2):
    """The picture and P must speak of the same heights, whichever way the angles are counted."""
    _, lines = drawn(ARM, [q1, q2])
    heights = lines[-2][:, 1]
    P = ARM.g * (ARM.m1 * heights[0] + ARM.m2 * heights[1])
    assert pytest.approx(ARM.potential_energy([q1, q2]), abs=1e-9) == P
    _, lines = drawn(PENDULUM, [q1])
    P = PENDULUM.m * PENDULUM.g * (lines[-2][0, 1] + PENDULUM.lc)
    assert pytest.approx(PENDULUM.potential_energy([q1]), abs=1e-9) == P


def test_angles_are_drawn_from_their_own_zero():
    """Dotted lines: down for the pendulum, along x for q1, along link 1 for q2."""
    _, lines = drawn(PENDULUM, [0.7])
    down = np.diff(lines[1], axis=0)[0]
    assert np.arctan2(*down[::-1]) == pytest.approx(-math.pi / 2)
    _, lines = drawn(ARM, [0.7, 0.4])
    first, second = (np.diff(line, axis=0)[0] for line in lines[1:3])
    assert np.arctan2(*first[::-1]) == pytest.approx(0)
    assert np.arctan2(*second[::-1]) == pytest.approx(0.7)


@settings(max_examples=20)  # each example draws a figure
@given(angles, angles)
def test_axes_do_not_move_with_the_arm(q1, q2):
    moved, _ = drawn(ARM, [q1, q2])
    still, _ = drawn(ARM, [0, 0])
    assert moved.get_xlim() == still.get_xlim()
    assert moved.get_ylim() == still.get_ylim()


@given(st.tuples(angles, angles), st.tuples(rates, rates), st.tuples(rates, rates))
def test_terms_add_up_to_the_input(q, qd, qdd):
    rows = plotting.terms(ARM, q, qd, qdd)
    assert rows.shape == (5, 2)
    assert rows[:4].sum(axis=0) == pytest.approx(rows[4])
    assert rows[4] == pytest.approx(ARM.inverse_dynamics(q, qd, qdd), abs=1e-9)
    assert rows[2] == pytest.approx(ARM.g_vec(q))


@pytest.mark.parametrize(
    ("model", "state"), [(ARM, ([0.5, 0.9], [2, -3], [4, 2])), (PENDULUM, ([0.9], [2], [4]))]
)
def test_each_joint_has_one_labelled_bar_per_term(model, state):
    fig = plotting.torque_terms(model, *state)
    values = plotting.terms(model, *state)
    bar_axes = [ax for sub in fig.subfigs[1:] for ax in sub.axes]
    assert len(bar_axes) == model.n
    for joint, ax in enumerate(bar_axes):
        heights = [bar.get_height() for bar in ax.patches]
        assert heights == pytest.approx(values[:, joint])
        assert [float(text.get_text()) for text in ax.texts] == pytest.approx(
            values[:, joint], abs=0.051
        )
        assert "N·m" in ax.get_ylabel()
        assert len({bar.get_hatch() for bar in ax.patches}) == 5
    names = [label.get_text() for label in bar_axes[-1].get_xticklabels()]
    assert names == [r"$M\ddot q$", r"$C\dot q$", "$g$", "$f$", "$u$"]


def test_a_limit_holds_the_bars_axes_still():
    fig = plotting.torque_terms(ARM, [0, 0], [50, 50], [0, 0], limit=7)
    for ax in fig.subfigs[1].axes:
        assert ax.get_ylim() == (-7, 7)
        assert all(abs(text.get_position()[1]) < 7 for text in ax.texts)


def test_no_label_reads_minus_zero():
    fig = plotting.torque_terms(PENDULUM, [-1e-9], [0], [0])
    assert {text.get_text() for text in fig.subfigs[1].axes[0].texts} == {"0.0"}


def test_only_known_models_and_single_states_are_drawn():
    class Cart(Manipulator):
        n = 1
        M = C = g_vec = potential_energy = None

    with pytest.raises(TypeError, match="draws a Pendulum, a Planar2R or a PlanarChain, got Cart"):
        drawn(Cart(), [0.0])
    with pytest.raises(ValueError, match=r"q: got shape \(3, 2\); one arm at a time"):
        drawn(ARM, np.zeros((3, 2)))
    with pytest.raises(ValueError, match=r"q: got shape \(3,\), needs"):
        drawn(ARM, np.zeros(3))


def test_a_picture_says_what_it_shows():
    fig, _ = plotting.figure(4, 2)
    alt = 'A "quoted" line with a < b & c'
    data, metadata = plotting.Picture(fig, alt)._repr_mimebundle_()
    assert f'alt="{html.escape(alt)}"' in data["text/html"]
    assert data["image/png"] in data["text/html"]
    assert data["text/plain"] == metadata["image/png"]["alt"] == alt
    with Image.open(io.BytesIO(base64.b64decode(data["image/png"]))) as image:
        assert image.width / image.height == pytest.approx(2)
        assert image.width == metadata["image/png"]["width"] * plotting.OVERSAMPLING
    with pytest.raises(ValueError, match="alt: needs a sentence"):
        plotting.Picture(fig, " ")


def test_pictures_are_deterministic():
    bundles = [
        plotting.Picture(
            plotting.torque_terms(ARM, [0.5, 0.9], [2, -3], [4, 2]), "x"
        )._repr_mimebundle_()
        for _ in range(2)
    ]
    assert bundles[0] == bundles[1]


def test_pictures_leave_nothing_open():
    """Figures are made without pyplot, which would keep each one until it is closed."""
    import matplotlib.pyplot as plt

    fig, ax = plotting.figure()
    assert isinstance(fig, Figure)
    ax.plot([0, 1])
    plotting.Picture(fig, "x")._repr_mimebundle_()
    assert plt.get_fignums() == []


def test_an_import_leaves_matplotlib_as_it_was():
    """In a new process: here somebody may have imported it before."""
    code = (
        "import matplotlib\n"
        "before = dict(matplotlib.rcParams)\n"
        "import armdyn.plotting, autograder, autograder.judging.check\n"
        "figure, axes = armdyn.plotting.figure()\n"
        "axes.plot([0, 1])\n"
        "armdyn.plotting.Picture(figure, 'a line')._repr_mimebundle_()\n"
        "after = dict(matplotlib.rcParams)\n"
        "assert [key for key in after if after[key] != before[key]] == []\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def pixels(figure: Figure) -> bytes:
    file = io.BytesIO()
    figure.savefig(file, format="png", dpi=60)
    with Image.open(file) as image:
        return image.tobytes()


def draw_on(ax) -> None:
    ax.plot([0, 1, 2], label="a")
    ax.semilogy([1, 2, 1], label="b")
    ax.axhline(1, color="black")
    ax.axvline(1)
    ax.bar([0, 1], [0.5, 0.5], hatch="//", edgecolor="black")
    ax.contour([[1, 2], [2, 4]])
    ax.set(xlabel="x", ylabel="y", title="a title")
    ax.text(1, 1, "text")
    ax.annotate("note", (1, 1), (2, 2), arrowprops={"arrowstyle": "->"})
    ax.legend()


def test_a_figure_has_the_style_whatever_matplotlib_is_set_to():
    with matplotlib.rc_context(plotting.STYLE):
        expected = Figure(figsize=(5, 3))
        draw_on(expected.subplots())
        wanted = pixels(expected)
    plain = Figure(figsize=(5, 3))
    draw_on(plain.subplots())
    assert pixels(plain) != wanted
    figure, ax = plotting.figure(5, 3)
    draw_on(ax)
    assert pixels(figure) == wanted
    for style in (
        {"font.size": 17, "lines.linewidth": 9, "axes.grid": False},
        *("ggplot", "dark_background", "bmh", "fivethirtyeight", "seaborn-v0_8-poster"),
    ):
        with matplotlib.style.context(style):
            figure, ax = plotting.figure(5, 3)
            draw_on(ax)
            assert pixels(figure) == wanted, style


@pytest.mark.parametrize(
    "make",
    [
        lambda: plotting.torque_terms(ARM, [0.3, 0.4], [1, 2], [3, 4]),
        lambda: plotting.inertia_ellipses(ARM, [[0.1, 0.2], [0.3, 0.9]]),
        lambda: plotting.energy_landscape(ARM),
        lambda: plotting.phase_portrait(PENDULUM),
    ],
)
def test_figures_of_models_have_the_style(make):
    with matplotlib.rc_context(plotting.STYLE):
        wanted = pixels(make())
    assert pixels(make()) == wanted
