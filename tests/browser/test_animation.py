"""An animation in a browser: it plays, its slider moves it, and without scripts its figure stays."""

import nbformat
import numpy as np
import pytest
from playwright.sync_api import expect

from tests.browser.conftest import PATIENCE

CODE = """\
import numpy as np
from armdyn import Planar2R
from armdyn.plotting import Animation
from armdyn.simulate import simulate

arm = Planar2R(1.0, 0.8, 0.5, 0.4, 2.0, 1.5, 0.2, 0.1)
t = np.linspace(0, 3, 151)
q = simulate(arm.state_derivative, [0.4, -0.7, 0.5, 1.0], [0, 0], t)[:, :2]
"""
NAME = "A free arm falls and swings."
SHOW = f'Animation(arm, t, q, alt="{NAME}")'


@pytest.fixture(scope="module")
def made():
    """The animation that CODE and SHOW make."""
    names = {}
    exec(CODE, names)
    return eval(SHOW, names)


@pytest.fixture(scope="module")
def file(made, tmp_path_factory):
    """Its output twice in one page, as nbconvert would write it."""
    page = made._repr_mimebundle_()[0]["text/html"]
    path = tmp_path_factory.mktemp("animation") / "page.html"
    path.write_text(f"<!doctype html><meta charset='utf-8'>{page}<hr>{page}", encoding="utf-8")
    return path.as_uri()


class Player:
    """One player on a page."""

    def __init__(self, root):
        self.root = root
        self.picture = root.get_by_role("img", name=NAME).and_(root.locator("svg"))
        self.button = root.get_by_role("button")
        self.slider = root.get_by_role("slider")

    @property
    def time(self) -> float:
        return float(self.root.get_attribute("data-time"))

    @property
    def links(self) -> np.ndarray:
        """The joints and the tip, (3, 2), as shares of the picture, y up."""
        points = self.picture.locator("[data-links]").get_attribute("points").split()
        pixels = np.array([[float(number) for number in point.split(",")] for point in points])
        return pixels / 340 * [1, -1] + [0, 1]

    def move_to(self, time: float) -> None:
        self.slider.fill(str(time))


def test_it_plays_pauses_and_ends(tab, clock, file):
    tab.goto(file)
    expect(tab.locator("[data-links]")).to_have_count(2)  # the same output twice: two players
    first, second = (Player(root) for root in tab.locator("[data-armdyn-animation]").all())
    expect(first.button).to_have_text("Play")
    still = first.links
    first.button.click()
    expect(first.button).to_have_text("Pause")
    clock.run_for(700)
    first.button.click()
    stopped = first.time
    assert stopped == pytest.approx(0.7, abs=0.1)
    assert not np.array_equal(first.links, still)
    clock.run_for(200)
    assert first.time == stopped
    assert second.time == 0
    first.move_to(2.9)
    first.button.click()
    clock.run_for(200)
    expect(first.button).to_have_text("Play")
    assert first.time == 3
    first.button.click()
    assert first.time == 0
    clock.run_for(200)
    assert 0 < first.time <= 0.2
    assert tab.trouble == []


def test_the_arm_stands_where_the_motion_says(tab, file, made):
    tab.goto(file)
    player = Player(tab.locator("[data-armdyn-animation]").first)
    arm = made.model
    edge = 1.15 * (arm.l1 + arm.l2)
    for time in (0.0, 0.73, 2.0, 3.0):
        player.move_to(time)
        expect(player.root.get_by_role("status")).to_have_text(f"{time:.2f} s")
        q1, q2 = (np.interp(time, made.t, column) for column in made.q[0].T)
        elbow = arm.l1 * np.array([np.cos(q1), np.sin(q1)])
        tip = elbow + arm.l2 * np.array([np.cos(q1 + q2), np.sin(q1 + q2)])
        # From metres to the picture: 44 of its 340 units are left of x = −edge and below y.
        for point, drawn in zip((np.zeros(2), elbow, tip), player.links, strict=True):
            share = (44 + (point + edge) / (2 * edge) * 288) / 340
            assert drawn == pytest.approx(share, abs=0.005)


def test_it_is_described_and_works_from_the_keyboard(tab, file):
    tab.goto(file)
    player = Player(tab.locator("[data-armdyn-animation]").first)
    expect(player.picture).to_have_count(1)
    expect(player.slider).to_have_accessible_name("time")
    expect(player.root.locator("[data-still-only]")).to_have_count(0)
    figure, moving = player.root.locator("img").bounding_box(), player.picture.bounding_box()
    assert moving["x"] + moving["width"] <= figure["x"]  # the figure stays, beside it
    player.slider.focus()
    tab.keyboard.press("End")
    assert player.time == pytest.approx(3, abs=0.05)
    expect(player.slider).to_have_attribute("aria-valuetext", "3.00 s")
    tab.keyboard.press("Home")
    assert player.time == 0
    player.button.focus()
    tab.keyboard.press("Enter")
    expect(player.button).to_have_text("Pause")


@pytest.mark.parametrize("tab", [False], indirect=True)
def test_without_scripts_the_figure_and_its_text_are_what_one_sees(tab, file):
    tab.goto(file)
    expect(tab.locator("svg, button, input")).to_have_count(0)
    for figure in tab.get_by_role("img", name=NAME).all():
        assert figure.bounding_box()["width"] > 300
    expect(tab.locator("[data-still-only]").first).to_contain_text("A still figure: run the cell")


@pytest.fixture(scope="module")
def stored(course, made):
    """A notebook that holds the output and was never run here: JupyterLab does not trust it."""
    data, metadata = made._repr_mimebundle_()
    cells = [nbformat.v4.new_code_cell(CODE), nbformat.v4.new_code_cell(SHOW, execution_count=2)]
    cells[1].outputs = [
        nbformat.v4.new_output("execute_result", data=data, metadata=metadata, execution_count=2)
    ]
    kernel = {"name": "python3", "display_name": "Python 3 (ipykernel)", "language": "python"}
    notebook = nbformat.v4.new_notebook(cells=cells, metadata={"kernelspec": kernel})
    path = course / "motion.ipynb"
    nbformat.write(notebook, path)
    return path


def test_in_jupyterlab_untrusted_then_run_then_as_stored_output(page, opened, stored, tmp_path):
    opened(stored.name)
    panel = page.locator(".jp-NotebookPanel", has_text="Animation(arm, t, q")
    output = panel.locator(".jp-OutputArea-output")
    figure = output.get_by_role("img", name=NAME).last
    expect(figure).to_be_visible()
    expect(output.locator("svg, button, input")).to_have_count(0)
    expect(output).to_contain_text("A still figure: run the cell")
    page.screenshot(path=tmp_path / "untrusted.png")

    # Asked before the kernel is there, JupyterLab drops the outputs and runs nothing.
    expect(page.locator("#jp-main-statusbar")).to_contain_text("| Idle")
    page.get_by_role("menuitem", name="Run", exact=True).click()
    page.get_by_text("Run All Cells", exact=True).click()
    expect(output.locator("[data-links]")).to_be_visible()
    expect(output.get_by_text("A still figure: run the cell")).to_have_count(0)
    player = Player(output.locator("[data-armdyn-animation]"))
    before = player.links
    player.button.click()
    expect(player.root).not_to_have_attribute("data-time", "0.000")
    player.button.click()
    player.move_to(2.0)
    assert not np.array_equal(player.links, before)
    page.screenshot(path=tmp_path / "run.png")

    # The slider's arrow keys are its own: JupyterLab does not go to another cell.
    page.keyboard.press("ArrowUp")
    assert 2.0 < player.time < 2.5
    expect(player.slider).to_be_focused()

    panel.locator(".jp-InputArea-prompt").first.click()
    page.keyboard.press("Control+S")
    for _ in range(PATIENCE // 100):
        if nbformat.read(stored, nbformat.NO_CONVERT).cells[0].execution_count:
            break
        page.wait_for_timeout(100)
    saved = nbformat.read(stored, nbformat.NO_CONVERT)
    assert saved.cells[0].execution_count == 1
    assert len(stored.read_bytes()) < 50_000
    opened(stored.name)
    expect(output.locator("[data-links]")).to_be_visible()
    player.move_to(1.0)
    assert player.time == 1.0
    page.screenshot(path=tmp_path / "stored.png")
