"""An animation with torques in a browser: arcs, numbers and bars of one time, by mouse and keyboard."""

import numpy as np
import pytest
from playwright.sync_api import expect

from armdyn import Planar2R
from armdyn.plotting import Animation, terms
from armdyn.simulate import simulate
from tests.browser.test_animation import Player

ARM = Planar2R(1.0, 0.8, 0.5, 0.4, 3.0, 2.0, 0.25, 0.11, viscous=(0.5, 0.3))
T = np.linspace(0, 3, 301)
U = np.array([20.0, 5.0])
START = np.array([-0.35, 1.2, 0.0, 0.0])
NAMES = ("M q̈", "C q̇", "g", "f", "u")
PHONE = {"width": 390, "height": 844}
# The corner of an arc's head that points on, in units of the picture from the joint.
HEADS = """groups => groups.map(group => [...group.children].slice(1).map(part => {
  const head = part.lastChild, hidden = getComputedStyle(head).visibility == "hidden";
  return hidden ? null : head.getAttribute("d").match(/^M(\\S+) ([^LM]+)/).slice(1).map(Number);
}))"""


@pytest.fixture(scope="module")
def motion():
    return simulate(ARM.state_derivative, START, U, T)


@pytest.fixture(scope="module")
def file(motion, tmp_path_factory):
    path = tmp_path_factory.mktemp("torques") / "page.html"
    shown = Animation(ARM, T, motion[:, :2], "An arm is lifted.", qd=motion[:, 2:], u=U)
    path.write_text(page_of(shown), encoding="utf-8")
    return path.as_uri()


def page_of(animation):
    head = (
        "<!doctype html><meta charset='utf-8'><meta name='viewport' content='width=device-width'>"
    )
    return head + animation._repr_mimebundle_()[0]["text/html"]


def opened(tab, file):
    tab.goto(file)
    player = Player(tab.locator("[data-armdyn-animation]"))
    player.picture = player.root.locator("svg[role=img]")
    return player


def numbers(text):
    return float(text.replace("−", "-"))


def table(player):
    """The numbers beside the picture, (2, 5), N·m."""
    rows = player.root.locator("tbody tr", has_text="joint").all()
    return np.array(
        [[numbers(text) for text in row.locator("td").all_inner_texts()] for row in rows]
    )


def energies(player):
    rows = player.root.locator("tr", has=player.root.page.locator(".armdyn-bar")).all()
    return {
        row.locator("th").inner_text(): numbers(row.locator("td").last.inner_text()) for row in rows
    }


def arcs(player):
    """Where the arcs end, (2, 5) complex from the joint, y up; NaN where none is."""
    heads = player.root.locator("[data-arcs]").evaluate_all(HEADS)
    return np.array([[complex(h[0], -h[1]) if h else np.nan for h in joint] for joint in heads])


def at(time, motion):
    q, qd = (
        np.array([np.interp(time, T, x) for x in part.T]) for part in np.split(motion, 2, axis=1)
    )
    return q, qd, ARM.dynamics(q, qd, U)


def test_the_numbers_and_arcs_are_those_of_the_time(tab, file, motion):
    player = opened(tab, file)
    quarter = numbers(player.picture.get_by_text("this arc:").text_content().split()[2])
    for time in (0.0, 0.83, 2.9):
        player.move_to(time)
        expected = terms(ARM, *at(time, motion)).T
        assert table(player) == pytest.approx(expected, abs=0.15)
        for heads, torques in zip(arcs(player), expected, strict=True):
            for head, torque in zip(heads, torques, strict=True):
                if abs(torque) < 0.05 * quarter:
                    continue
                turn = torque / quarter * np.pi / 2  # counter-clockwise from upwards
                assert np.isclose(head / abs(head), 1j * np.exp(1j * turn), atol=0.05)
    radii = np.abs(arcs(player))[0]
    assert np.all(np.diff(radii) > 2)  # a ring for each term, the inner ones first
    assert tab.trouble == []


def test_the_bars_are_the_energies(tab, file, motion):
    player = opened(tab, file)
    player.move_to(2.0)
    q, qd, _ = at(2.0, motion)
    shown = energies(player)
    assert list(shown) == [
        *("kinetic K", "potential P", "total E = K + P"),
        *("taken by friction", "given by motors"),
    ]
    kinetic, potential, total, taken, given = shown.values()
    assert kinetic == pytest.approx(ARM.kinetic_energy(q, qd), abs=0.15)
    assert potential == pytest.approx(ARM.potential_energy(q), abs=0.15)
    start = ARM.energy(START[:2], START[2:])
    assert total == pytest.approx(start + given - taken, abs=0.3)
    widths = [
        float(bar.get_attribute("width")) for bar in player.root.locator(".armdyn-bar rect").all()
    ]
    sizes = np.abs(list(shown.values()))
    assert np.array(widths) / widths[4] == pytest.approx(sizes / sizes[4], abs=0.02)


def test_a_term_is_switched_off_and_on_from_the_keyboard(tab, file):
    player = opened(tab, file)
    player.move_to(0.83)
    before = arcs(player)
    assert not np.any(np.isnan(before[0]))
    for k, name in enumerate(NAMES):
        entry = player.root.get_by_role("checkbox", name=name, exact=True)
        expect(entry).to_be_checked()
        entry.focus()
        tab.keyboard.press("Space")
        now = arcs(player)
        assert np.all(np.isnan(now[:, k]))
        others = np.arange(5) != k
        assert np.array_equal(now[:, others], before[:, others], equal_nan=True)
        tab.keyboard.press("Space")
        assert np.array_equal(arcs(player), before, equal_nan=True)


def test_the_slider_by_keyboard_tells_the_numbers(tab, clock, file):
    player = opened(tab, file)
    told = player.root.locator("[aria-live=polite]")
    player.slider.focus()
    tab.keyboard.press("End")
    expect(told).to_contain_text("At 3.00 s: joint 1: M q̈ ")
    second = player.root.locator("tbody tr", has_text="joint 2").locator("td").all_inner_texts()
    pairs = zip(NAMES, second, strict=True)
    expect(told).to_contain_text("; joint 2: " + ", ".join(f"{n} {v}" for n, v in pairs) + " N·m;")
    assert second[4] == "5.0"
    tab.keyboard.press("ArrowLeft")
    assert 2.5 < player.time < 3
    expect(told).to_contain_text(f"At {player.time:.2f} s")
    player.root.get_by_role("button", name="Play").click()
    clock.run_for(1000)
    expect(told).to_contain_text("At 3.00 s")


def test_who_asked_for_less_motion_sees_a_few_stands(tab, clock, file):
    tab.emulate_media(reduced_motion="reduce")
    player = opened(tab, file)
    player.root.get_by_role("button", name="Play").click()
    clock.run_for(1000)
    assert player.time == pytest.approx(0.6)


def test_it_fits_a_phone_in_the_light_and_in_the_dark(tab, file):
    tab.set_viewport_size(PHONE)
    player = opened(tab, file)
    assert tab.evaluate("document.documentElement.scrollWidth") == PHONE["width"]
    assert player.picture.bounding_box()["width"] > 330
    box = player.root.locator(".armdyn-player")
    assert box.evaluate("e => getComputedStyle(e).backgroundColor") == "rgb(255, 255, 255)"
    tab.add_style_tag(content=":root { --jp-layout-color0: #111; --jp-ui-font-color1: #eee; }")
    assert box.evaluate("e => getComputedStyle(e).backgroundColor") == "rgb(17, 17, 17)"
    label = player.picture.get_by_text("x (m)")
    assert label.evaluate("e => getComputedStyle(e).fill") == "rgb(238, 238, 238)"


def test_on_paper_there_are_the_figure_and_the_numbers_without_controls(tab, file):
    player = opened(tab, file)
    figure = player.root.locator("img")
    expect(figure).to_be_hidden()  # on a screen the moving picture tells more
    player.move_to(1.0)
    tab.emulate_media(media="print")
    expect(figure).to_be_visible()
    expect(player.root.get_by_role("rowheader", name="kinetic K")).to_be_visible()
    assert not any(part.is_visible() for part in player.root.locator("button, input").all())


@pytest.mark.parametrize("tab", [False], indirect=True)
def test_without_scripts_there_is_the_figure(tab, file):
    tab.goto(file)
    expect(tab.get_by_role("img", name="An arm is lifted.")).to_be_visible()
    expect(tab.locator("svg, table")).to_have_count(0)


def test_of_two_motions_one_is_chosen(tab, tmp_path):
    starts = np.array([[1.2, 0.3, 0, 0], [0.2, 0.3, 0, 0]])
    x = simulate(ARM.state_derivative, starts, [0, 0], T[:51])
    names = ("high", "low")
    both = Animation(ARM, T[:51], x[..., :2], "Two fall.", names=names, qd=x[..., 2:])
    path = tmp_path / "two.html"
    path.write_text(page_of(both), encoding="utf-8")
    player = opened(tab, path.as_uri())
    choice = player.root.get_by_role("combobox", name="torques and energy of")
    for name, start in zip(names, starts, strict=True):
        choice.select_option(name)
        assert table(player)[:, 2] == pytest.approx(ARM.g_vec(start[:2]), abs=0.1)
        expect(player.root.locator("[aria-live=polite]")).to_contain_text(f"At 0.00 s, {name}:")
    assert tab.trouble == []
