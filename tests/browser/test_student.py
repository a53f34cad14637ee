"""A student's first problem, in JupyterLab in a browser: blank, mistaken, right, validated."""

import re

import pytest
from playwright.sync_api import expect

from tests.submissions.p3_pendulum import RIGHT

COSINE = """
def g_vec(q, pend):
    return pend.m * pend.g * pend.lc * np.cos(q)
"""


class Problem:
    """The notebook of p3-pendulum as it stands on the screen."""

    def __init__(self, page, pictures):
        self.page = page
        self.pictures = pictures
        self.panel = page.locator(".jp-NotebookPanel").filter(has_text="Problem 3: the pendulum")

    def cell(self, text: str):
        """The one code cell whose source holds the text."""
        source = self.page.locator(".jp-InputArea-editor", has_text=text)
        return self.panel.locator(".jp-CodeCell").filter(has=source)

    def run(self, text: str):
        """Run the cell, wait until it is done, and give its verdict card."""
        cell = self.cell(text)
        prompt = cell.locator(".jp-InputArea-prompt")
        before = prompt.text_content()
        prompt.click()
        self.page.keyboard.press("Control+Enter")
        expect(prompt).not_to_have_text(before)
        expect(prompt).to_have_text(re.compile(r"\[\d+\]:"))
        card = cell.locator(".armdyn-verdict")
        if card.count():
            card.scroll_into_view_if_needed()
        return card

    def write(self, function: str, answer: str) -> None:
        """Replace the source of the cell that defines the function, and run it."""
        start = f"def {function}("
        self.cell(start).locator(".cm-content").click()
        self.page.keyboard.press("Control+A")
        self.page.keyboard.insert_text(answer.strip())
        self.run(start)

    def derive(self, text: str) -> None:
        """Put the text into the derivation, the markdown cell that waits for an answer."""
        cell = self.panel.locator(".jp-MarkdownCell", has_text="(your answer goes here)")
        cell.dblclick()
        cell.locator(".cm-content").click()
        self.page.keyboard.press("Control+A")
        self.page.keyboard.insert_text(text)
        self.page.keyboard.press("Control+Enter")
        expect(self.panel.locator(".jp-RenderedMarkdown", has_text=text)).to_be_visible()

    def validate(self):
        """Press Validate, and give the dialog that answers; the notebook is run for it."""
        self.panel.get_by_role("button", name="Validate").click()
        dialog = self.page.locator(".jp-Dialog")
        dialog.wait_for()
        return dialog

    def picture(self, name: str) -> None:
        self.page.screenshot(path=self.pictures / f"{name}.png")


@pytest.fixture
def problem(page, tmp_path):
    return Problem(page, tmp_path)


def test_lesson_and_problem_stand_side_by_side(page, problem):
    panels = page.locator(".jp-NotebookPanel:visible")
    expect(panels).to_have_count(2)
    expect(problem.panel).to_be_visible()
    lesson, other = panels.nth(0).bounding_box(), panels.nth(1).bounding_box()
    assert lesson["x"] + lesson["width"] <= other["x"]
    for folder in ("lessons", "problems"):
        expect(page.locator(".jp-DirListing-itemName", has_text=folder)).to_be_visible()
    problem.picture("first view")


def test_problem_from_blank_to_validated(page, problem):
    problem.run("from autograder import check")

    problem.run("def M(")
    blank = problem.run('check("p3-M")')
    expect(blank).to_have_attribute("data-state", "not-attempted")
    expect(blank).to_contain_text("not attempted", ignore_case=True)
    problem.picture("blank")

    problem.write("g_vec", COSINE)
    mistaken = problem.run('check("p3-g_vec")')
    expect(mistaken).to_have_attribute("data-state", "incorrect")
    expect(mistaken).to_contain_text("You have the cosine of q where the sine belongs")
    problem.picture("mistaken")

    for function, answer in RIGHT.items():
        problem.write(function, answer)
        card = problem.run(f'check("p3-{function}")')
        expect(card).to_have_attribute("data-state", "correct")
        expect(card).to_contain_text("correct", ignore_case=True)
        problem.picture(f"right {function}")

    problem.derive("The kinetic energy of the body that turns about its pivot is")
    dialog = problem.validate()
    problem.picture("validated")
    expect(dialog).to_contain_text("Success")
    dialog.get_by_role("button", name="Ok").click()

    problem.write("g_vec", COSINE)
    dialog = problem.validate()
    problem.picture("not validated")
    expect(dialog).to_contain_text("cosine of q where the sine belongs")
    expect(dialog).not_to_contain_text("Success")
    dialog.get_by_role("button", name="Ok").click()

    # Nothing has come in between: no offer of news, no other notice. One would still be there.
    assert page.locator(".Toastify__toast").count() == 0
