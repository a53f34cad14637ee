"""A control's pictures: the same as a whole new figure, and nothing of one call is in the next."""

import base64
import inspect
import io
import re

import matplotlib
import numpy as np
import pytest
from PIL import Image

from armdyn import Planar2R, plotting

ARM = Planar2R(1.0, 0.8, 0.5, 0.3, 3.0, 2.0, 0.25, 0.11)
STATES = ([0.5, 1.0], [1.0, 2.0], [3.0, -1.0]), ([-1.0, 0.3], [0.0, 4.0], [-6.0, 2.0])


@pytest.fixture
def torques():
    @plotting.live(plotting.torque_axes(joints=2, limit=80))
    def torques(fig, q, qd, qdd):
        plotting.draw_torque_terms(fig, ARM, q, qd, qdd)
        return f"The arm at {q}."

    return torques


def line_between(low, high):
    fig, ax = plotting.figure()
    ax.set(xlim=(0, 1), ylim=(low, high), xlabel="x", ylabel="y")

    @plotting.live(fig)
    def line(fig, height, title="", fail=False):
        fig.axes[0].plot([0, 1], [0, height])
        if fail:
            raise RuntimeError("half drawn")
        if title:
            fig.axes[0].set_title(title)
        return f"A line to {height}."

    return line


@pytest.fixture
def line():
    return line_between(-2, 2)


def pixels(png: str) -> np.ndarray:
    with Image.open(io.BytesIO(base64.b64decode(png))) as image:
        return np.asarray(image.convert("RGB")).astype(int)


def test_a_picture_is_what_a_whole_new_figure_shows(torques):
    torques(*STATES[1])
    for state in STATES:
        fast = pixels(torques(*state).png)
        whole = plotting.Picture(plotting.torque_terms(ARM, *state, limit=80), alt="x")
        slow = pixels(whole._repr_mimebundle_()[0]["image/png"])
        assert fast.shape == slow.shape
        # 64 colours are chosen for each; what differs more would be another drawing.
        assert np.mean(np.abs(fast - slow).max(axis=-1) > 60) < 0.002
    first, second = (pixels(torques(*state).png) for state in STATES)
    assert np.mean(np.abs(first - second).max(axis=-1) > 60) > 0.01


def test_nothing_of_one_call_is_in_the_next(line):
    first = line(1.0).png
    assert line(-1.5, title="down").png != first
    assert line(1.0).png == first
    with pytest.raises(RuntimeError, match="half drawn"):
        line(0.3, fail=True)
    assert line(1.0).png == first
    assert line.figure.axes[0].lines[:] == []


def test_new_limits_are_drawn(line):
    before = line(1.0).png
    line.figure.axes[0].set_ylim(-20, 20)
    assert line(1.0).png == line_between(-20, 20)(1.0).png
    assert line.background_changed
    line.figure.axes[0].set_ylim(-2, 2)
    assert line(1.0).png == before


def test_it_shows_itself_as_a_picture_does_and_holds_its_place(line):
    data, metadata = line(0.5)._repr_mimebundle_()
    assert data["text/plain"] == "A line to 0.5."
    size = metadata["image/png"]
    assert size["alt"] == "A line to 0.5."
    # With the height known, the page below does not jump while the image is decoded.
    assert f'width="{size["width"]}" height="{size["height"]}"' in data["text/html"]
    assert 'alt="A line to 0.5."' in data["text/html"]


def test_it_is_called_as_the_function_is_but_for_the_figure(line):
    assert list(inspect.signature(line).parameters) == ["height", "title", "fail"]
    assert line.__name__ == "line"
    assert line(height=1.0).alt == "A line to 1.0."


@pytest.mark.parametrize(("answer", "error"), [(None, TypeError), ("  ", ValueError)])
def test_without_a_text_there_is_no_picture(answer, error):
    fig, _ = plotting.figure()
    with pytest.raises(error):
        plotting.live(fig)(lambda fig: answer)()


def test_matplotlibs_own_settings_stay(line):
    with matplotlib.rc_context({"lines.linewidth": 7, "axes.grid": False}):
        before = dict(matplotlib.rcParams)
        line(1.0)
        assert dict(matplotlib.rcParams) == before


def coordinates(element: str) -> np.ndarray:
    """The points of an element whose path has lines only, in pixels, y down."""
    data = re.search(r' d="([^"]+)"', element)[1]
    steps = [tuple(map(int, pair)) for pair in re.findall(r"[ml](-?\d+) (-?\d+)", data)]
    return np.cumsum(steps, axis=0) / 10


def test_strokes_are_where_the_picture_has_them(line):
    line(1.0)
    (stroke, _), alt = line.strokes(1.0)
    assert alt == "A line to 1.0."
    shot = pixels(line(1.0).png)  # (rows, columns, 3)
    shown = line.figure.axes[0].transData.transform([(0, 0), (1, 1)])
    share = shown / [shot.shape[1], shot.shape[0]]
    expected = np.array([share[:, 0], 1 - share[:, 1]]).T * line(1.0).size
    assert coordinates(stroke) == pytest.approx(expected, abs=0.06)
    assert 'stroke="#0072b2"' in stroke


def test_strokes_have_text_fillings_and_hatches_and_are_cut_at_the_axes(torques):
    drawn, _ = torques.strokes([0.5, 1.0], [0.0, 30.0], [3.0, -1.0])
    bars = [part for part in drawn if "<pattern" in part]
    assert len(bars) == 8  # of ten, the two for u have no hatch
    assert all(part.startswith("<pattern") and 'fill="url(#hatch-' in part for part in bars)
    assert any('fill="#f0e442"' in part for part in drawn)
    assert all("<text" not in part for part in drawn)
    for part in bars:
        assert re.search(r'<svg x="\d+" y="\d+" width="\d+" height="\d+" viewBox', part)
    again, _ = torques.strokes([0.5, 1.0], [0.0, 30.0], [3.0, -1.0])
    assert again == drawn
