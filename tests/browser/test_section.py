"""The links at the end of cards, clicked one after the other: the lesson that is open already moves."""

from playwright.sync_api import expect

from tests.browser.test_student import Problem, shows

LINKS = ('check("p1-M")', "By hand: the 2R arm"), ('check("p1-is_spd")', "4 · Testing it")


def test_each_link_leads_to_its_own_section_of_an_open_lesson(page, opened, tmp_path):
    opened("problems/p1-inertia/p1-inertia.ipynb")
    problem = Problem(page, tmp_path, "Problem 1")
    expect(page.locator("#jp-main-statusbar")).to_contain_text("| Idle")
    problem.run("from autograder import check")
    lesson = page.locator(".jp-NotebookPanel:visible", has_text="03 · The inertia matrix")
    tab = page.locator(".lm-DockPanel-tabBar .lm-TabBar-tab", has_text="p1-inertia")
    for check, section in LINKS:
        tab.click()
        link = problem.run(check).get_by_role("link", name=section)
        assert shows(link, lesson.get_by_role("heading", name=section), tab)
