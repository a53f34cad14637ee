"""A wrong answer at work, in a browser: it plays, it can be scrubbed, and without scripts it stands."""

import re

import nbformat
import numpy as np
import pytest
from playwright.sync_api import expect

from autograder.pictures.page import SLOWER
from autograder.problems import known_check
from autograder.student.watch import shown
from tests.autograder.pictures.wrong import CART, UPWARD, function
from tests.browser.test_student import Problem

DARK = """:root { --jp-ui-font-color1: #eee; --jp-layout-color0: #111 }
body { background: #111; color: #eee }"""
# Where each moving part of a panel is, in its picture's own units.
PARTS = """panel => [...panel.querySelectorAll("[data-moves]")].map(
  part => { const { e, f } = part.transform.baseVal.consolidate().matrix; return [e, f]; })"""


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    """The cart and pole with a wrong M, and the arm with a wrong g_vec, twice, in one page."""
    cart = shown(known_check("cart-pole-M"), {"M": function("cart-pole-M", CART)})["text/html"]
    arm = shown(known_check("p4-g_vec"), {"g_vec": function("p4-g_vec", UPWARD)})["text/html"]
    path = tmp_path_factory.mktemp("watch") / "page.html"
    page = f"<!doctype html><meta charset='utf-8'>{cart}<hr>{arm}<hr>{arm}"
    path.write_text(page, encoding="utf-8")
    return path.as_uri()


class Player:
    """One player on a page."""

    def __init__(self, root):
        self.root = root
        self.button = root.get_by_role("button")
        self.slider = root.get_by_role("slider")

    @property
    def time(self) -> float:
        return float(self.root.get_attribute("data-time"))

    def parts(self, panel: int) -> np.ndarray:
        """x and y of the moving parts, right (0) or theirs (1)."""
        return np.array(self.root.locator("[data-panel]").nth(panel).evaluate(PARTS))


def players(tab) -> list[Player]:
    return [Player(root) for root in tab.locator("[data-armdyn-picture]:has(button)").all()]


def test_both_play_pause_and_end(tab, clock, file, tmp_path):
    tab.goto(file)
    assert len(players(tab)) == 3
    expect(tab.locator("[data-armdyn-picture]")).to_have_count(5)  # two curves stand still
    expect(tab.locator("[data-armdyn-picture] img")).to_have_count(0)
    cart, arm, again = players(tab)
    tab.screenshot(path=tmp_path / "end.png", full_page=True)
    assert cart.time == 0.5  # as the still picture stands
    ends = cart.parts(0), cart.parts(1)
    cart.button.click()
    expect(cart.button).to_have_text("Pause")
    clock.run_for(800)
    cart.button.click()
    stopped = cart.time
    assert stopped == pytest.approx(0.8 / SLOWER, abs=0.02)
    for k in (0, 1):
        assert np.max(np.abs(cart.parts(k) - ends[k])) > 3
    clock.run_for(400)
    assert cart.time == stopped
    assert arm.time == again.time == 0.5
    cart.button.click()
    clock.run_for(2000)
    expect(cart.button).to_have_text("Play")
    for k in (0, 1):
        np.testing.assert_allclose(cart.parts(k), ends[k])
    assert tab.trouble == []


def test_both_start_from_one_state_and_scrubbing_moves_them_apart(tab, file):
    tab.goto(file)
    arm = players(tab)[1]
    arm.slider.fill("0")
    np.testing.assert_allclose(arm.parts(0), arm.parts(1), atol=0.11)
    arm.slider.fill("0.3")
    expect(arm.root.get_by_role("status")).to_have_text("0.30 s")
    assert np.max(np.abs(arm.parts(0) - arm.parts(1))) > 10
    cursor = arm.root.locator("[data-cursor]").first
    assert re.fullmatch(r"translate\(\d+(\.\d+)? 0\)", cursor.get_attribute("transform"))


def test_it_is_described_and_works_from_the_keyboard(tab, file):
    tab.goto(file)
    cart = players(tab)[0]
    picture = cart.root.get_by_role("img")
    expect(picture).to_have_accessible_name(re.compile(r"^0\.5 s, from rest at x = .*tip is"))
    expect(cart.slider).to_have_accessible_name("time")
    cart.slider.focus()
    tab.keyboard.press("Home")
    assert cart.time == 0
    expect(cart.slider).to_have_attribute("aria-valuetext", "0.00 s")
    tab.keyboard.press("ArrowRight")
    assert 0 < cart.time < 0.1
    cart.button.focus()
    tab.keyboard.press("Enter")
    expect(cart.button).to_have_text("Pause")


def test_who_asked_for_less_motion_sees_a_few_positions(tab, clock, file):
    tab.emulate_media(reduced_motion="reduce")
    tab.goto(file)
    tab.evaluate("""() => {
      const root = document.querySelector("[data-live]"), seen = (window.seen = new Set());
      new MutationObserver(() => seen.add(root.dataset.time)).observe(root, { attributes: true });
    }""")
    cart = players(tab)[0]
    cart.button.click()
    clock.run_for(5000)
    assert tab.evaluate("[...window.seen]") == [
        "0.000",
        "0.100",
        "0.200",
        "0.300",
        "0.400",
        "0.500",
    ]


def test_it_takes_the_colours_of_a_dark_theme(tab, file, tmp_path):
    tab.goto(file)
    tab.add_style_tag(content=DARK)
    tab.screenshot(path=tmp_path / "dark.png", full_page=True)
    picture = tab.locator("[data-armdyn-picture] > svg").first
    back = picture.locator("> rect").evaluate("e => getComputedStyle(e).fill")
    text = picture.locator("text").first.evaluate("e => getComputedStyle(e).fill")
    assert (back, text) == ("rgb(17, 17, 17)", "rgb(238, 238, 238)")


@pytest.mark.parametrize("tab", [False], indirect=True)
def test_without_scripts_the_picture_and_its_text_are_what_one_sees(tab, file, tmp_path):
    tab.goto(file)
    tab.screenshot(path=tmp_path / "still.png", full_page=True)
    expect(tab.locator("button, input, [data-armdyn-picture] > svg")).to_have_count(0)
    for image in tab.locator("[data-armdyn-picture] img").all():
        assert image.evaluate("image => image.naturalWidth") == 560
    expect(tab.locator("[data-still-only]").first).to_contain_text("A still picture: run the cell")
    expect(tab.get_by_text("The right motion keeps its energy").first).to_be_visible()


def test_a_notebook_that_is_not_trusted_shows_the_still_picture(page, opened, course, tmp_path):
    bundle = shown(known_check("cart-pole-M"), {"M": function("cart-pole-M", CART)})
    cell = nbformat.v4.new_code_cell('watch("cart-pole-M")', execution_count=1)
    cell.outputs = [nbformat.v4.new_output("display_data", data=bundle)]
    kernel = {"name": "python3", "display_name": "Python 3 (ipykernel)", "language": "python"}
    notebook = nbformat.v4.new_notebook(cells=[cell], metadata={"kernelspec": kernel})
    nbformat.write(notebook, course / "watched.ipynb")
    opened("watched.ipynb")
    output = page.locator(".jp-OutputArea-output", has_text="from rest at x =")
    picture = output.get_by_role("img", name=re.compile("from rest at x ="))
    expect(picture).to_be_visible()
    assert picture.evaluate("e => [e.tagName, e.naturalWidth]") == ["IMG", 560]
    expect(output.locator("button, input, svg")).to_have_count(0)
    expect(output).to_contain_text("A still picture: run the cell, or trust the notebook")
    page.screenshot(path=tmp_path / "untrusted.png")


def test_in_jupyterlab_a_student_is_offered_it_and_plays_it(page, opened, tmp_path):
    opened("problems/p3-pendulum/p3-pendulum.ipynb")
    problem = Problem(page, tmp_path)
    expect(page.locator("#jp-main-statusbar")).to_contain_text("| Idle")
    problem.run("from autograder import check")
    problem.write("g_vec", "def g_vec(q, pend):\n    return -pend.m * pend.g * pend.lc * np.sin(q)")
    card = problem.run('check("p3-g_vec")')
    expect(card).to_contain_text('from autograder import watch; watch("p3-g_vec")')
    call = 'from autograder import watch; watch("p3-g_vec")'
    problem.insert_below('check("p3-g_vec")', call)
    problem.run(call)
    watched = problem.panel.locator(".armdyn-watch")
    expect(watched).to_contain_text("Your curve is the right one turned upside down.")
    player = Player(watched.locator("[data-armdyn-picture]:has(button)"))
    player.slider.focus()
    page.keyboard.press("Home")
    page.keyboard.press("ArrowRight")  # its own key: JupyterLab does not go to another cell
    expect(player.slider).to_be_focused()
    assert 0 < player.time < 0.1
    start = player.parts(1)
    player.button.click()
    expect(player.button).to_have_text("Play")  # until its end
    assert player.time == 0.5
    assert np.max(np.abs(player.parts(1) - start)) > 10
    watched.scroll_into_view_if_needed()
    problem.picture("watched")
