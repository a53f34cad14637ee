"""Nbgrader → Assignment List, where every problem sends a student: fetch, validate, submit, feedback."""

import os
import shutil
import subprocess
import sys

import nbformat
import pytest
from playwright.sync_api import expect

from tests.submissions import p2_energy_skew

MINE = "p2-energy-skew"
LOST = "c6-regressor"
# nbgrader takes seconds to import: once, and a fork a command.
COMMANDS = """
import os, sys
from nbgrader.apps import NbGraderApp

for command in sys.argv[1:]:
    if not (child := os.fork()):
        NbGraderApp.launch_instance(command.split())
        os._exit(0)
    if os.waitpid(child, 0)[1]:
        sys.exit(f"nbgrader {command} failed")
"""


@pytest.fixture
def nbgrader(course):
    """Runs nbgrader's commands in the course's folder, one after the other."""

    def run(*commands: str) -> None:
        program = [sys.executable, "-c", COMMANDS, *commands]
        ran = subprocess.run(program, cwd=course, capture_output=True, text=True)
        assert ran.returncode == 0, ran.stderr

    return run


class AssignmentList:
    """The list on the screen; its parts: released, fetched and submitted."""

    def __init__(self, page):
        self.page = page
        page.locator(".lm-MenuBar-item", has_text="Nbgrader").click()
        page.locator(".lm-Menu-itemLabel", has_text="Assignment List").click()

    def row(self, part: str, assignment: str):
        """The assignment's row in that part of the list."""
        rows = self.page.locator(f"#{part}_assignments_list > .list_item")
        return rows.filter(has_text=assignment)

    def press(self, part: str, assignment: str, button: str) -> None:
        self.row(part, assignment).get_by_role("button", name=button, exact=True).click()


@pytest.fixture
def menu(page, opened):
    """JupyterLab with a launcher; the names in its menu Nbgrader."""
    opened()
    expect(page.locator(".jp-DirListing-itemName", has_text="problems")).to_be_visible()
    page.locator(".lm-MenuBar-item", has_text="Nbgrader").click()
    expect(page.locator(".lm-Menu-itemLabel")).not_to_have_count(0)
    names = page.locator(".lm-Menu-itemLabel").all_text_contents()
    page.keyboard.press("Escape")
    return [name for name in names if name]


@pytest.fixture
def listed(page, menu, course, nbgrader):
    """The list with two assignments released: one that the student works on, and one removed."""
    work = course / "problems" / MINE / f"{MINE}.ipynb"
    nbformat.write(p2_energy_skew.right(nbformat.read(work, as_version=4)), work)
    shutil.rmtree(course / "problems" / LOST)
    steps = ("generate_assignment", "release_assignment")
    nbgrader(*(f"{step} {assignment}" for assignment in (MINE, LOST) for step in steps))
    return AssignmentList(page)


def test_a_student_has_no_tools_of_an_instructor(menu):
    assert menu == ["Assignment List"]


@pytest.mark.skipif(os.name == "nt", reason="nbgrader has no exchange on Windows")
def test_fetch_validate_submit_feedback(page, course, nbgrader, listed, terminal, tmp_path):
    work = course / "problems" / MINE / f"{MINE}.ipynb"
    before = work.read_bytes()
    expect(listed.row("released", LOST)).to_have_count(1)
    expect(listed.row("released", MINE)).to_have_count(0)  # it is there: nothing to fetch
    page.screenshot(path=tmp_path / "released.png")
    listed.press("released", LOST, "Fetch")
    expect(listed.row("fetched", LOST)).to_have_count(1)
    fetched = course / "problems" / LOST
    assert {path.name for path in fetched.iterdir()} == {
        path.name for path in (course / "course" / "release" / LOST).iterdir()
    }
    assert not (course / "problems" / "problems").exists()

    listed.row("fetched", MINE).get_by_role("button", name=MINE).click()
    listed.press("fetched", MINE, "Validate")
    dialog = page.locator(".jp-Dialog")
    expect(dialog).to_contain_text("Success")
    page.screenshot(path=tmp_path / "validated.png")
    dialog.get_by_role("button", name="Ok").click()
    assert work.read_bytes() == before

    listed.press("fetched", MINE, "Submit")
    expect(listed.row("submitted", MINE)).to_have_count(1)
    nbgrader(
        *(f"{step} {MINE}" for step in ("collect", "autograde", "generate_feedback")),
        f"release_feedback {MINE}",
    )
    page.locator("#refresh_assignments_list").click()
    expect(listed.row("submitted", MINE)).to_contain_text("feedback available")
    listed.press("submitted", MINE, "Fetch Feedback")
    listed.row("submitted", MINE).get_by_text("view feedback").click()
    page.locator(".jp-DirListing-itemName", has_text=f"{MINE}.html").dblclick()
    feedback = page.frame_locator(".jp-HTMLViewer iframe")
    expect(feedback.get_by_text("p2-C: correct").first).to_be_visible()
    page.screenshot(path=tmp_path / "feedback.png")
    assert work.read_bytes() == before
    assert terminal() == ""
