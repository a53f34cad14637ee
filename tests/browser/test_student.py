"""A student's problems, in JupyterLab in a browser: blank, mistaken, named, drawn, right, validated."""

import re
from contextlib import suppress

import pytest
from playwright.sync_api import expect

from tests.submissions.p1_inertia import RIGHT as RIGHT_INERTIA
from tests.submissions.p3_pendulum import RIGHT

COSINE = """
def g_vec(q, pend):
    return pend.m * pend.g * pend.lc * np.cos(q)
"""
WITHOUT_I2 = RIGHT_INERTIA["M"].replace("M12 = M22 +", "M12 = M22 - arm.I2 +")


class Problem:
    """A problem's notebook as it stands on the screen; title: words of its heading."""

    def __init__(self, page, pictures, title="Problem 3: the pendulum"):
        self.page = page
        self.pictures = pictures
        self.panel = page.locator(".jp-NotebookPanel").filter(has_text=title)

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

    def insert_below(self, text: str, source: str) -> None:
        """A new cell with this source, below the one whose source holds the text."""
        self.cell(text).locator(".jp-InputArea-prompt").click()
        self.page.keyboard.press("b")
        self.page.keyboard.press("Enter")
        self.page.keyboard.insert_text(source)
        expect(self.cell(source)).to_have_count(1)

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


def test_first_lesson_is_open_alone_and_the_problem_is_its_second_tab(page, address, problem):
    page.goto(address)
    tabs = page.locator(".lm-DockPanel-tabBar .lm-TabBar-tab")
    expect(tabs).to_have_text(["00-start-here.ipynb", "p3-pendulum.ipynb"])
    lesson = page.locator(".jp-NotebookPanel:visible")
    expect(lesson).to_have_count(1)
    expect(lesson).to_contain_text("Start here")
    table, room = (
        lesson.locator(where).first.evaluate("e => [e.scrollWidth, e.parentElement.clientWidth]")
        for where in (".jp-RenderedMarkdown table", ".jp-WindowedPanel-outer")
    )
    assert table[0] <= table[1]
    assert room[1] > 900
    for name in ("lessons", "problems"):
        expect(page.locator(".jp-DirListing-itemName", has_text=name)).to_be_visible()
    for name in ("solutions", "course", "nbgrader_config.py"):
        expect(page.locator(".jp-DirListing-itemName", has_text=name)).to_have_count(0)
    problem.picture("first view")


def test_notebooks_that_are_only_opened_stay_unchanged(page, problem, terminal):
    tabs = page.locator(".lm-DockPanel-tabBar .lm-TabBar-tab")
    for name in ("00-start-here", "p3-pendulum"):
        tabs.filter(has_text=name).click()
        expect(tabs.filter(has_text=name)).to_have_class(re.compile("lm-mod-current"))
        expect(page.locator("#jp-main-statusbar")).to_contain_text("| Idle")
    expect(problem.panel).to_be_visible()
    page.wait_for_timeout(1000)  # the kernels have said which language they speak
    assert page.locator(".jp-mod-dirty").count() == 0
    assert terminal() == ""


def test_problem_from_blank_to_validated(page, opened, problem, terminal):
    opened("problems/p3-pendulum/p3-pendulum.ipynb")
    expect(page.locator("#jp-main-statusbar")).to_contain_text("| Idle")
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
    assert terminal() == ""


@pytest.fixture
def inertia(page, opened, tmp_path):
    """p1-inertia, opened."""
    opened("problems/p1-inertia/p1-inertia.ipynb")
    inertia = Problem(page, tmp_path, "Problem 1: the inertia matrix")
    expect(page.locator("#jp-main-statusbar")).to_contain_text("| Idle")
    return inertia


def test_a_mistake_is_named_drawn_and_mended(inertia):
    # The figure of the problem is there, and its formulas are typeset.
    figure = inertia.panel.get_by_role("img", name=re.compile("A planar arm with two links"))
    assert figure.evaluate("image => image.decode().then(() => image.naturalWidth)") > 200
    expect(inertia.panel.locator("mjx-container").first).to_be_visible()

    inertia.run("from autograder import check")
    inertia.write("M", WITHOUT_I2)
    card = inertia.run('check("p1-M")')
    expect(card).to_have_attribute("data-state", "partly-correct")
    expect(card).to_match_aria_snapshot("""
      - 'group "p1-M: partly correct (75 %)"':
        - paragraph:
          - strong: "p1-M: partly correct (75 %)"
        - list:
          - listitem: "met: M11 (50 %)"
          - listitem:
            - text: "not met: M12 and M21 (25 %)"
            - paragraph: /Your M12 is right except that I2 is missing/
          - listitem: "met: M22 (25 %)"
        - paragraph:
          - text: "Worst case:"
          - code: M(q, arm)
          - text: /gave .* kg·m².*, off by .* kg·m²/
        - group: "This call in numbers:"
        - paragraph: "To work with the worst case, run this in a cell of your own:"
        - code: from autograder import worst_case q, arm = worst_case("p1-M") M(q, arm)
        - paragraph:
          - text: Stuck? Run
          - code: hint("p1-M")
          - text: for a hint. Hints cost no points.
        - paragraph:
          - text: "See what your M does to the motion:"
          - code: from autograder import watch; watch("p1-M")
        - paragraph:
          - text: "Lesson 03 prepares this:"
          - 'link "By hand: the 2R arm"'
          - text: .
        - paragraph: /Change your function/
        - group: "3 of 15 points checked; a person gives 4 more."
        - img /The arm in the worst case. link 1 at .*° from the x axis/
    """)
    arm, words = card.get_by_role("img").bounding_box(), card.locator("p").first.bounding_box()
    assert arm["width"] > 40
    assert arm["height"] > 20
    assert words["x"] + words["width"] <= arm["x"]  # beside the text, not between its lines
    card.get_by_text("This call in numbers").click()
    expect(card.locator("details", has_text="l1=").locator("code")).to_be_visible()
    card.get_by_text("3 of 15 points").click()
    expect(card.get_by_text("left to check: p1-inertia_from_links (2)")).to_be_visible()
    inertia.picture("mistaken")

    inertia.insert_below('check("p1-M")', 'hint("p1-M")')
    for count in (1, 2):
        inertia.run('hint("p1-M")')
        hints = inertia.panel.get_by_role("group", name="Hints for p1-M")
        expect(hints.get_by_role("listitem")).to_have_count(count)
    inertia.picture("hints")

    inertia.write("M", RIGHT_INERTIA["M"])
    card = inertia.run('check("p1-M")')
    expect(card).to_have_attribute("data-state", "correct")
    expect(card.get_by_role("img")).to_have_count(0)
    expect(inertia.panel.get_by_text("I2 is missing")).to_have_count(0)
    inertia.picture("mended")


def shows(link, heading, back) -> bool:
    """Whether the link brings the heading into view, at the latest when it is clicked once more: on a
    busy machine JupyterLab has not yet made the section when it goes there, or still lays out the
    lesson, and the section moves away.
    """
    for _ in range(3):
        link.click()
        with suppress(AssertionError):
            expect(heading).to_be_in_viewport(timeout=30_000)
            return True
        with suppress(AssertionError):
            expect(heading).to_be_attached(timeout=60_000)
        back.click()
    return False


def test_a_card_leads_to_the_section_of_the_lesson(inertia, page):
    inertia.run("from autograder import check")
    card = inertia.run('check("p1-is_spd")')
    inertia.picture("before the link")
    section = "4 · Testing it on a computer"
    lesson = page.locator(".jp-NotebookPanel:visible").filter(has_text="The inertia matrix")
    tabs = page.locator(".lm-DockPanel-tabBar .lm-TabBar-tab")
    link, heading = (one.get_by_role(role, name=section)
                     for one, role in ((card, "link"), (lesson, "heading")))  # fmt: skip
    assert shows(link, heading, tabs.filter(has_text="p1-inertia"))
    lessons_tab = tabs.filter(has_text="03-inertia-matrix.ipynb")
    expect(lessons_tab).to_have_class(re.compile("lm-mod-current"))
    inertia.picture("the section")


def test_a_typed_name_draws_an_arm_of_ones_own(inertia):
    inertia.run("from autograder import check")
    expect(inertia.panel.get_by_text("No name is known here.")).to_be_visible()
    expect(inertia.panel.get_by_role("group", name="This is the arm of the book")).to_have_count(1)

    typed = 'own_arm("p1", "s1234")'
    inertia.insert_below("from autograder import check", typed)
    inertia.run(typed)
    inertia.run("from autograder import check")
    own = inertia.panel.get_by_role("group", name="This is the arm of s1234.")
    picture = own.get_by_role("img")
    expect(picture).to_be_visible()
    picture.scroll_into_view_if_needed()
    inertia.picture("own arm")
    assert picture.bounding_box()["width"] > 200
    assert own.evaluate("card => card.scrollWidth <= card.clientWidth")
    expect(own.get_by_role("table")).to_contain_text("q1 = 0")
    expect(inertia.panel.get_by_text("No name is known here.")).to_have_count(0)
