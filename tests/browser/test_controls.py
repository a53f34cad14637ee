"""A lesson's sliders: in JupyterLab they redraw the picture, on the site too, without a network."""

import re

import nbformat
import pytest
from playwright.sync_api import expect

from tests.browser.conftest import ROOT

LESSON = ROOT / "lessons" / "01-canonical-form.ipynb"
# Each picture that the control showed from now on, and whether it was whole, at its place.
WATCH = """output => {
  window.seen = [];
  const look = () => {
    const images = [...output.querySelectorAll("img")];
    window.seen.push(images.map(i => [i.alt, i.getBoundingClientRect().height]));
    requestAnimationFrame(look);
  };
  look();
}"""


@pytest.fixture
def control(course, opened, page):
    """The lesson up to its control, run in JupyterLab: the control's cell."""
    lesson = nbformat.read(LESSON, as_version=4)
    last = next(k for k, cell in enumerate(lesson.cells) if cell.id == "01-control")
    lesson.cells = [c for c in lesson.cells[: last + 1] if c.cell_type == "code"]
    for cell in lesson.cells:
        cell.outputs, cell.execution_count = [], None
    nbformat.write(lesson, course / "control.ipynb")
    opened("control.ipynb")
    panel = page.locator(".jp-NotebookPanel", has_text="def torques(")
    cell = panel.locator(".jp-CodeCell", has_text="def torques(")
    expect(page.locator("#jp-main-statusbar")).to_contain_text("| Idle")
    page.get_by_role("menuitem", name="Run", exact=True).click()
    page.get_by_text("Run All Cells", exact=True).click()
    expect(cell.locator(".widget-output img")).to_be_visible()
    # Until the last cell has run, JupyterLab still lays out the notebook.
    expect(page.locator("#jp-main-statusbar")).to_contain_text("| Idle")
    return cell


def test_in_jupyterlab_a_slider_moves_the_picture_and_its_text(control, page, tmp_path):
    picture = control.locator(".widget-output img")
    expect(picture).to_have_attribute("alt", re.compile(r"q = \(0\.5, 1\.0\) rad; u = "))
    before, box = picture.get_attribute("src"), picture.bounding_box()
    assert box["width"] > 500
    control.locator(".widget-output").evaluate(WATCH)
    handle = control.get_by_role("slider").first
    handle.focus()
    for _ in range(15):  # faster than the pictures: what counts is where it ends
        page.keyboard.press("ArrowRight")
    expect(picture).to_have_attribute("alt", re.compile(r"q = \(2\.0, 1\.0\) rad"))
    assert picture.get_attribute("src") != before
    assert picture.bounding_box() == pytest.approx(box)
    page.screenshot(path=tmp_path / "control.png")
    seen = page.evaluate("window.seen")
    # There was one picture at every moment, as large as ever: the page below did not move.
    assert {len(images) for images in seen} == {1}
    assert {height for ((_, height),) in seen} == {box["height"]}
