"""The formgrader's pages and the feedback pages hold all that they show, and ask no other host."""

import io
import json
import os
import re
import shutil
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell
from nbgrader.api import Gradebook
from nbgrader.converters import GenerateFeedback
from nbgrader.coursedir import CourseDirectory
from PIL import Image
from playwright.sync_api import expect

from armdyn.ports.toolchain import processes
from autograder.nbgrader_glue.feedback import FeedbackExporter
from autograder.nbgrader_glue.release import configuration
from tests.autograder import courses
from tests.autograder.course_problems import NAMES, ROOT, problem, without_plots
from tests.browser.conftest import PATIENCE

P3 = "p3-pendulum"
AUTOGRADER = Path(sys.executable).with_name("autograder")
MINE = "# Mine\n\n![page one](My page (1).jpg)\n\n![lost](lost.png) $E=\\tfrac12 m\\dot q^2$"
PLOT = "import matplotlib.pyplot as plt\nplt.plot([1, 2, 1])\nplt.show()"
# Of what is drawn: pictures that failed, and formulas that were laid out to nothing.
LOST = """() => [...document.images].filter(e => !e.complete || !e.naturalWidth).length
  + [...document.querySelectorAll("math")].filter(e => e.checkVisibility()
      && !e.getBoundingClientRect().width).length"""
UNFOLD = "() => document.querySelectorAll('details').forEach(e => e.open = true)"
# What lies beyond the right edge of the page.
BEYOND = """() => [...document.querySelectorAll("body *")].filter(e => !e.closest("math, svg")
  && !e.parentElement.closest(".formula, .output_subarea, .rendered_html, table, pre")
  && e.getBoundingClientRect().right > document.documentElement.clientWidth + 1)
  .map(e => e.outerHTML.slice(0, 120))"""
LEVELS = """() => [...document.querySelectorAll("h1,h2,h3,h4,h5,h6")].map(e => +e.tagName[1])"""
RAW = re.compile(r"\$[^$]*[\\_^][^$]*\$|\\(?:frac|tfrac|dot|begin|mathsf)\b")


def photo(colour: str) -> bytes:
    file = io.BytesIO()
    Image.new("RGB", (60, 40), colour).save(file, "JPEG")
    return file.getvalue()


@pytest.fixture(scope="module")
def taught(tmp_path_factory):
    """A course with a wrong p3 that was graded: its proof is a photo, and it draws a figure."""
    root = tmp_path_factory.mktemp("taught")
    shutil.copy(ROOT / "nbgrader_config.py", root)
    (root / "lessons").mkdir()
    shutil.copytree(ROOT / "solutions" / P3, root / "solutions" / P3)
    nbformat.write(without_plots(problem(P3).source), root / "solutions" / P3 / f"{P3}.ipynb")
    courses.run(root, "nbgrader", "generate_assignment", P3)
    folder = root / "course" / "submitted" / "ada" / P3
    shutil.copytree(root / "course" / "release" / P3, folder)
    mine = problem(P3).submissions.wrong(nbformat.read(folder / f"{P3}.ipynb", as_version=4))
    mine.cells += [new_markdown_cell(MINE), new_code_cell(PLOT)]
    (folder / f"{P3}.ipynb").write_text(json.dumps(mine))
    (folder / "My page (1).jpg").write_bytes(photo("red"))
    (folder / "never mentioned.jpg").write_bytes(photo("blue"))
    courses.run(root, "autograder", "grade", P3)
    courses.run(root, "nbgrader", "generate_feedback", P3)
    return root


@pytest.fixture(scope="module")
def server(taught):
    """The address of the instructor's JupyterLab, and the token that opens it."""
    with processes.start(
        [AUTOGRADER, "lab", "--instructor", "--no-browser", "--port=0"],
        cwd=taught,
        env=os.environ | {"JUPYTER_DATA_DIR": str(taught / "data")},
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    ) as lab:
        try:
            found = next(filter(None, (re.search(r"Open (\S+)/lab\S*?(token=\w+)", line)
                                       for line in lab.stdout)), None)  # fmt: skip
            assert found
            yield found.groups()
        finally:
            lab.terminate()
            processes.end(lab, 30)


@pytest.fixture
def formgrader(browser, server):
    """A page on which only the server answers; `asked` has what was asked of others, or failed."""
    address, token = server
    context = browser.new_context(viewport={"width": 1280, "height": 900})
    page = context.new_page()
    page.set_default_timeout(PATIENCE)
    page.asked = []

    def answer(route):
        if route.request.url.startswith((address, "data:")):
            return route.continue_()
        page.asked.append(route.request.url)
        return route.abort()

    context.route("**/*", answer)
    page.on("pageerror", lambda error: page.asked.append(str(error)))
    page.goto(f"{address}/formgrader/manage_assignments?{token}")
    yield page
    context.close()


def test_nothing_in_the_formgrader_asks_another_host(formgrader, server):
    address, _ = server
    expect(formgrader.get_by_role("link", name=P3)).to_be_visible()
    for path, there in (
        (f"manage_submissions/{P3}", "needs manual grading"),
        ("gradebook", P3),
        (f"gradebook/{P3}", P3),
        ("manage_students", "ada"),
        ("manage_students/ada", P3),
    ):
        formgrader.goto(f"{address}/formgrader/{path}")
        expect(formgrader.locator("#main-table").get_by_text(there).first).to_be_visible()
    assert formgrader.asked == []


def test_who_was_only_collected_stands_by_the_class_lists_name_or_by_the_id(
    formgrader, server, taught, tmp_path
):
    address, _ = server
    listed = taught / "course" / "class.csv"
    listed.write_text("id,last_name,first_name,email\nbob,Doe,Bob,bob@example.org\n")
    folders = [courses.submit(taught, student, "{}").parents[1] for student in ("bob", "cem")]
    try:
        for path in ("manage_students", f"manage_submissions/{P3}"):
            formgrader.goto(f"{address}/formgrader/{path}")
            table = formgrader.locator("#main-table")
            for student, name in (("ada", "ada"), ("bob", "Doe, Bob"), ("cem", "cem")):
                row = table.locator(f'tr:has(td:text-is("{student}"))')
                expect(row.locator("td").first).to_have_text(name)
            assert "None, None" not in table.inner_text()
            formgrader.screenshot(path=tmp_path / "names.png")
        assert formgrader.asked == []
    finally:
        listed.unlink()
        for folder in folders:
            shutil.rmtree(folder)


def test_a_proof_is_read_and_marked_in_the_formgrader(formgrader, server, taught, tmp_path):
    address, _ = server
    formgrader.goto(f"{address}/formgrader/gradebook/{P3}/{P3}")
    score = formgrader.locator("#p3-derivation")
    was_open = []

    def look(route):
        was_open.append(score.is_editable())
        route.fallback()

    formgrader.route("**/formgrader/api/grades?*", look)
    formgrader.get_by_role("link", name="Submission #1").click()
    # What is typed before the points have come, nbgrader would write over.
    expect(score).to_be_editable()
    assert was_open == [False]
    assert formgrader.locator("math").count() > 20
    assert formgrader.get_by_alt_text("page one").evaluate("e => e.naturalWidth") == 60
    assert formgrader.get_by_alt_text("never mentioned.jpg").evaluate("e => e.naturalWidth") == 60
    expect(formgrader.get_by_text("lost.png was not handed in")).to_be_visible()
    formgrader.screenshot(path=tmp_path / "marking.png", full_page=True)
    assert formgrader.evaluate(LOST) == 0
    assert RAW.findall(formgrader.get_by_role("main").inner_text()) == []
    with formgrader.expect_response("**/formgrader/api/grade/*") as answer:
        score.fill("4")
        score.press("Tab")
    assert answer.value.ok
    formgrader.reload()
    expect(score).to_have_value("4")
    assert formgrader.asked == []

    with Gradebook(f"sqlite:///{taught / 'course' / 'gradebook.db'}") as gradebook:
        grade = gradebook.find_grade("p3-derivation", P3, P3, "ada")
        assert grade.manual_score == 4
    # The changed mark alone makes the page anew.
    before = returned(taught).read_text()
    courses.run(taught, "nbgrader", "generate_feedback", P3)
    assert "0 of 15 points" in before
    assert "4 of 15 points" in returned(taught).read_text()
    made = returned(taught).stat().st_mtime_ns
    courses.run(taught, "nbgrader", "generate_feedback", P3)
    assert returned(taught).stat().st_mtime_ns == made


def test_a_button_that_fails_says_why_in_a_sentence(formgrader, server, taught, tmp_path):
    address, _ = server
    damaged = courses.submit(taught, "eve", "{")
    formgrader.goto(f"{address}/formgrader/manage_submissions/{P3}")
    formgrader.locator("#main-table tr", has_text="eve").locator(".autograde a").click()
    dialog = formgrader.get_by_role("dialog")
    expect(dialog).to_contain_text(f"{P3}.ipynb is not valid JSON: ask the student for it again")
    formgrader.screenshot(path=tmp_path / "refused.png")
    assert not re.search(r"Traceback|\[DEBUG\]", dialog.inner_text())
    shutil.rmtree(damaged.parents[1])


def returned(root: Path) -> Path:
    return root / "course" / "feedback" / "ada" / P3 / f"{P3}.html"


def test_the_returned_page_travels_alone(tab, taught, tmp_path):
    alone = tmp_path / "alone" / "page.html"
    alone.parent.mkdir()
    shutil.copy(returned(taught), alone)
    tab.goto(alone.as_uri())
    assert tab.get_by_alt_text("page one").evaluate("e => e.naturalWidth") == 60
    assert tab.get_by_alt_text("never mentioned.jpg").evaluate("e => e.naturalWidth") == 60
    assert tab.locator(".output_png img").evaluate("e => e.naturalWidth") > 300
    expect(tab.get_by_text("lost.png was not handed in")).to_be_visible()
    links = tab.locator("nav a").all_inner_texts()
    assert links[1] == "M: inertia about the pivot"
    assert links[3] == "g_vec: gravity torque"
    assert "Test cell" not in tab.content()
    titles = tab.locator("h2").all_inner_texts()
    assert titles == [
        "From the grader, about this notebook",
        "What to look at",
        "The text of the problem, and cells that show nothing",
        "Handed in beside the notebook",
    ]
    folded = tab.locator("details.section")
    expect(folded.get_by_text("The forearm of")).not_to_be_visible()
    folded.locator("summary").first.click()
    expect(folded.get_by_text("The forearm of").first).to_be_visible()
    assert tab.evaluate(LOST) == 0
    assert tab.trouble == []


@pytest.fixture(params=NAMES)
def full_page(request, tmp_path) -> str:
    """The address of a feedback page with all of a problem's own formulas and pictures, and answers."""
    notebook = problem(request.param).source
    path = tmp_path / f"{request.param}.html"
    config = configuration(ROOT)
    nbgrader = GenerateFeedback(coursedir=CourseDirectory(config=config), config=config)
    exporter = FeedbackExporter(parent=nbgrader, config=nbgrader.config)
    names = {"assignment": request.param, "notebook": request.param}
    names |= {"score": 1, "max_score": 2, "late_penalty": 0.5}
    resources = {"nbgrader": names, "metadata": {"path": str(problem(request.param).folder)}}
    path.write_text(exporter.from_notebook_node(notebook, resources)[0], encoding="utf-8")
    return path.as_uri()


@pytest.mark.parametrize("tab", [False], indirect=True, ids=["no scripts"])
def test_each_problems_page_is_whole_by_day_by_night_and_on_a_phone(tab, full_page, tmp_path):
    tab.set_viewport_size({"width": 390, "height": 844})
    tab.goto(full_page)
    tab.evaluate(UNFOLD)
    for scheme in ("light", "dark"):
        tab.emulate_media(color_scheme=scheme)
        tab.screenshot(path=tmp_path / f"{scheme}.png", full_page=True)
    assert tab.evaluate(BEYOND) == []
    assert tab.evaluate(LOST) == 0
    assert tab.locator("math").count() > 20
    assert RAW.findall(tab.locator("main").inner_text()) == []
    levels = tab.evaluate(LEVELS)
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(after - before <= 1 for before, after in pairwise(levels))
    assert tab.trouble == []
