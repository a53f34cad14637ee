"""The link at the end of a card, clicked in JupyterLab: the section of the lesson is what one sees."""

from playwright.sync_api import expect

from tests.browser.test_student import Problem

WRONG = "def is_spd(A):\n    return bool(np.all(A > 0))"


def test_a_click_opens_the_lesson_at_its_section(page, opened, tmp_path):
    opened("problems/p1-inertia/p1-inertia.ipynb")
    problem = Problem(page, tmp_path, "Problem 1")
    expect(page.locator("#jp-main-statusbar")).to_contain_text("| Idle")
    problem.run("from autograder import check")
    problem.write("is_spd", WRONG)
    link = problem.run('check("p1-is_spd")').get_by_role("link")
    heading = link.text_content()
    link.click()
    lesson = page.locator(".jp-NotebookPanel", has_text="03 · The inertia matrix")
    expect(lesson.get_by_role("heading", name=heading)).to_be_in_viewport()
    tabs = page.locator(".lm-DockPanel-tabBar .lm-TabBar-tab")
    expect(tabs).to_have_text(["p1-inertia.ipynb", "03-inertia-matrix.ipynb"])
