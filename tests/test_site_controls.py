"""Which settings of a control a page holds, and what it holds of each."""

import base64
import itertools
import json
import re
import zlib
from pathlib import Path

import pytest

from armdyn import plotting
from docs.site.controls import Control, Input, control_of, has_control
from docs.site.frames import element, fitting
from docs.site.grid import choose, settings

ROOT = Path(__file__).parents[1]


def slider(low, high, step, start):
    count = round((high - low) / step) + 1
    values = tuple(round(low + k * step, 10) for k in range(count))
    return Input("x", values, tuple(map(str, values)), values.index(start))


# The sliders of lessons 01, 04, 05.
SIX = (
    *(slider(-3.1, 3.1, 0.1, 0.5), slider(-3.1, 3.1, 0.1, 1.0)),
    *(slider(-4, 4, 0.1, 0.0), slider(-4, 4, 0.1, 0.0)),
    *(slider(-6, 6, 0.1, 0.0), slider(-6, 6, 0.1, 0.0)),
)
THREE = (slider(-1, 1, 0.1, 1.0), slider(0, 180, 5, 30), slider(0, 180, 5, 120))
TWO = (slider(-180, 180, 5, 20), slider(-180, 180, 5, 60))


def all_settings(inputs, most):
    kept, together = choose(inputs, most)
    starts = [values.index(part.start) for values, part in zip(kept, inputs, strict=True)]
    return kept, together, starts, list(settings(kept, starts, together))


@pytest.mark.parametrize("inputs", [SIX, THREE, TWO])
@pytest.mark.parametrize("most", [150, 600, 1400])
def test_settings_are_as_many_as_fit_and_as_the_sliders_allow(inputs, most):
    kept, together, starts, found = all_settings(inputs, most)
    assert len(found) == len(set(found)) <= most
    for part, values in zip(inputs, kept, strict=True):
        assert part.start in values
        assert part.values.index(0) in values
        assert len({b - a for a, b in itertools.pairwise(values)}) == 1
    away = [sum(a != b for a, b in zip(setting, starts, strict=True)) for setting in found]
    assert max(away) == together
    # Every setting that may be reached is there: the script looks it up without asking.
    every = itertools.product(*(range(len(values)) for values in kept)) if len(inputs) < 4 else []
    reachable = [
        s for s in every if sum(a != b for a, b in zip(s, starts, strict=True)) <= together
    ]
    assert not reachable or set(reachable) == set(found)


def test_more_pictures_let_more_sliders_move_together():
    assert [choose(SIX, most)[1] for most in (300, 1400)] == [1, 2]
    assert [choose(THREE, most)[1] for most in (100, 1400)] == [1, 3]
    assert choose(TWO, 1400)[1] == 2


def test_the_places_that_a_lesson_speaks_of_are_there():
    kept, together = choose(TWO, 1400)
    assert together == 2
    for part, values in zip(TWO, kept, strict=True):
        assert {-180, -90, 0, 90, 180} <= {part.values[k] for k in values}


def test_a_slider_that_ends_on_its_last_value_and_one_that_may_not_move():
    assert choose((slider(0, 0, 1, 0),), 10) == ([[0]], 1)
    assert choose((slider(0, 3, 1, 3),), 10) == ([[0, 1, 2, 3]], 1)


def unpacked(text):
    packed = re.search(r'<script type="text/plain">([^<]+)</script>', text)[1]
    return json.loads(zlib.decompress(base64.b64decode(packed)))


@pytest.fixture
def control():
    fig, ax = plotting.figure()
    ax.set(xlim=(0, 1), ylim=(-5, 5))

    @plotting.live(fig)
    def line(fig, height, parts):
        for part in parts:
            fig.axes[0].plot([0, 1], [0, height if part == "up" else -height])
        return f"Lines to {height}: {', '.join(parts)} <&>."

    inputs = (
        slider(-2, 2, 1, 1),
        Input("up", (False, True), ("off", "on"), 1, is_box=True),
        Input("down", (False, True), ("off", "on"), 0, is_box=True),
    )

    def arguments(values):
        height, *ticked = values
        names = ("up", "down")
        return {"height": height, "parts": [n for n, t in zip(names, ticked, strict=True) if t]}

    return Control("99-control", inputs, line, arguments)


def test_the_page_holds_each_setting_as_the_function_draws_it(control):
    text = element(control, 100)
    data = unpacked(text)
    assert len(data["frames"]) == 5 * 2 * 2
    assert 'alt="Lines to 1: up &lt;&amp;&gt;."' in text
    for places, (alt, *numbers) in data["frames"].items():
        height, up, down = map(int, places.split(","))
        parts = ["up"] * up + ["down"] * down
        expected, said = control.live.strokes(height - 2, parts)
        assert [data["parts"][k] for k in numbers] == expected
        assert alt == said
    assert not data["coarser"]
    assert data["together"] == 3


def test_a_control_that_is_too_long_for_a_page_has_fewer_pictures(control):
    whole = element(control, 100)
    assert fitting(control, 100, len(whole)) == whole
    shorter = fitting(control, 100, len(whole) - 1)
    assert len(shorter) < len(whole)
    assert unpacked(shorter)["coarser"] or unpacked(shorter)["together"] < 3


def test_axes_that_change_are_refused(control):
    def moves(fig, height):
        fig.axes[0].set_ylim(-height, height)
        return "Axes."

    changing = Control("99", (slider(1, 3, 1, 1),), plotting.live(control.live.figure)(moves),
                       lambda values: {"height": values[0]})  # fmt: skip
    with pytest.raises(ValueError, match="99: its axes change with its inputs"):
        element(changing, 100)


def test_the_control_of_a_lesson_is_what_its_cell_says():
    control = control_of(ROOT / "lessons" / "06-linearity-in-parameters.ipynb")
    noise, samples = control.inputs
    assert (control.cell, noise.label, samples.label) == ("06-control", "noise, N·m", "samples")
    assert (noise.values[noise.start], samples.values[samples.start]) == (5, 80)
    assert (len(noise.values), samples.texts[-1]) == (31, "320")
    shot = control.live(**control.arguments((5, 80)))
    assert shot.alt.startswith("Noise 5 N·m, 80 samples: 2 standard errors [")


@pytest.mark.parametrize(
    ("lines", "error", "message"),
    [
        ("@ipywidgets.interact(a=(0, 3))\ndef f(a): ...", TypeError, "needs @plotting.live below"),
        (
            "from armdyn import plotting\nfig, ax = plotting.figure()\n"
            "@ipywidgets.interact(a='words')\n@plotting.live(fig)\ndef f(fig, a): return a",
            TypeError,
            "no way to show a Text",
        ),
        ("print('ipywidgets.interact(…)')", ValueError, "no cell made a control"),
    ],
)
def test_a_control_that_cannot_be_shown_is_refused(tmp_path, lines, error, message):
    source = "import ipywidgets\n" + lines
    cell = {"cell_type": "code", "id": "c", "metadata": {}, "outputs": [], "source": source}
    notebook = {"cells": [cell | {"execution_count": None}], "metadata": {}}
    path = tmp_path / "lesson.ipynb"
    path.write_text(json.dumps(notebook | {"nbformat": 4, "nbformat_minor": 5}), encoding="utf-8")
    assert has_control(path)
    with pytest.raises(error, match=message):
        control_of(path)
