"""The course as static pages: whole, without answers, alive without a network."""

import html
import json
import re
import subprocess
import sys
from pathlib import Path
from urllib.parse import unquote

import pytest
from playwright.sync_api import expect

from docs import reading_order
from tests.notebooks.answer_lines import answer_lines, flat

ROOT = Path(__file__).parents[2]
PHONE, DESK = {"width": 390, "height": 844}, {"width": 1366, "height": 900}
PAPER = {"width": 717, "height": 1046}  # A4 within a browser's margins
ABROAD = re.compile(r"[a-z]+:")
TEXT = {".html", ".ipynb", ".js", ".json", ".md", ".py", ".svg", ".toml", ".txt"}

TYPESET = "() => window.MathJax?.startup?.promise.then(() => true) ?? true"
FORMULAS = """() => {
  const raw = [...document.querySelectorAll(".math")].filter(e => !e.querySelector("mjx-container"));
  const wrong = [...document.querySelectorAll("mjx-merror, [data-mjx-error]")];
  const texts = document.createTreeWalker(document.querySelector("article"), NodeFilter.SHOW_TEXT);
  const dollars = [];
  while (texts.nextNode()) {
    const { parentElement: at, data } = texts.currentNode;
    if (/\\$[^$]+\\$/.test(data) && !at.closest("pre, code, script, mjx-container")) dollars.push(at);
  }
  return [...raw, ...wrong, ...dollars].map(e => e.outerHTML.slice(0, 120));
}"""
# How bright an element's text, or an SVG shape's filling, and what lies behind it are, from 0 to 1.
BRIGHTNESS = """(e, [property]) => {
  const pen = Object.assign(document.createElement("canvas"), { width: 1, height: 1 }).getContext("2d");
  pen.fillStyle = getComputedStyle(e)[property];
  pen.fillRect(0, 0, 1, 1);
  const [r, g, b] = pen.getImageData(0, 0, 1, 1).data;
  return (0.2126 * r + 0.7152 * g + 0.0722 * b) / 255;
}"""


@pytest.fixture(scope="module")
def site(tmp_path_factory) -> Path:
    """The folder with all pages."""
    why = "needs myst_nb: pip install -c constraints.txt -e .[site]"
    pytest.importorskip("myst_nb", reason=why)
    folder = tmp_path_factory.mktemp("site") / "pages"
    few = ["--pictures", "60"]  # of a control: they take most of the time
    made = subprocess.run(
        [sys.executable, "-m", "docs.site", folder, *few], cwd=ROOT, capture_output=True, text=True
    )
    assert (made.returncode, made.stderr) == (0, ""), made.stdout
    return folder


@pytest.fixture(scope="module")
def pages(site) -> dict[Path, str]:
    found = (path for path in site.rglob("*.html") if "_static" not in path.parts)
    return {path: path.read_text(encoding="utf-8") for path in found}


def words(page: str) -> str:
    """What a page says, without its tags."""
    return flat(html.unescape(re.sub(r"<[^>]+>", "", page)))


def said(path: Path) -> str:
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".ipynb":
        text = "\n".join("".join(cell["source"]) for cell in json.loads(text)["cells"])
    return words(text) if path.suffix == ".html" else flat(text)


def test_the_lessons_are_listed_as_they_are_read(site, pages):
    listed = re.findall(
        r'class="reference internal" href="lessons/([^"#]+)\.html"', pages[site / "index.html"]
    )
    read = [path.stem for path in reading_order.lessons(ROOT / "lessons")]
    assert list(dict.fromkeys(listed)) == read != sorted(read)


def test_there_is_a_page_for_all_of_the_course(site, pages):
    names = {path.relative_to(site).with_suffix("").as_posix() for path in pages}
    lessons = {f"lessons/{path.stem}" for path in ROOT.glob("lessons/*.ipynb")}
    problems = {
        f"problems/{path.parent.name}/{path.stem}" for path in ROOT.glob("solutions/*/*.ipynb")
    }
    guides = {f"docs/{path.stem}" for path in ROOT.glob("docs/*.md")}
    modules = {
        f"api/armdyn.{path.stem}"
        for path in (ROOT / "lib" / "armdyn").iterdir()
        if path.is_dir() or path.suffix == ".py"
    } - {"api/armdyn.__init__", "api/armdyn.__pycache__"}
    assert lessons | problems | guides | modules | {"index", "api/armdyn"} <= names
    assert len(modules) > 10
    assert "Ṁ − 2C" in words(pages[site / "api" / "armdyn.properties.html"])


def test_every_link_leads_somewhere(pages):
    marks = {
        path: set(re.findall(r'\b(?:id|name)="([^"]+)"', text)) for path, text in pages.items()
    }
    lost = []
    for path, text in pages.items():
        for link in map(html.unescape, re.findall(r'\b(?:href|src)="([^"]*)"', text)):
            if ABROAD.match(link):
                continue
            place, _, mark = link.partition("#")
            target = (path.parent / unquote(place.partition("?")[0])).resolve() if place else path
            if not target.is_file() or (mark and mark not in marks.get(target, {mark})):
                lost.append((path.name, link))
    assert lost == []


def test_a_problem_leads_to_the_cell_that_prepares_it(site, pages):
    text = pages[site / "problems" / "p1-inertia" / "p1-inertia.html"]
    assert 'href="../../lessons/03-inertia-matrix.html#arm"' in text


def test_no_page_and_no_file_has_an_answer(site):
    secret = answer_lines()
    assert len(secret) > 100
    served = [
        path for path in site.rglob("*") if path.suffix in TEXT and "_static" not in path.parts
    ]
    shown = {path: said(path) for path in served}
    given_away = [
        (path.name, line) for path, text in shown.items() for line in secret if line in text
    ]
    assert given_away == []
    assert len(shown) > 100


def test_a_problem_is_told_and_its_notebook_can_be_fetched(site, pages):
    story = pages[site / "problems" / "p1-inertia" / "p1-inertia.html"]
    assert "In a greenhouse a robot arm" in story
    assert "NotImplementedError" not in story
    fetched = site / "_sources" / "problems" / "p1-inertia" / "p1-inertia.ipynb"
    assert "NotImplementedError" in fetched.read_text(encoding="utf-8")


def test_each_page_fits_a_phone_and_asks_no_other_host(tab, pages):
    tab.set_viewport_size(PHONE)
    wrong = {}
    for path, text in pages.items():
        tab.goto(path.as_uri())
        assert tab.evaluate(TYPESET)
        width = tab.evaluate("document.documentElement.scrollWidth")
        formulas = tab.evaluate(FORMULAS) if 'class="math' in text else []
        if width != PHONE["width"] or formulas or tab.trouble:
            wrong[path.name] = (width, formulas, [*tab.trouble])
            tab.trouble.clear()
    assert wrong == {}


def test_an_animation_plays(tab, site):
    lesson = next(
        path
        for path in sorted(site.glob("lessons/*.html"))
        if "data-armdyn-animation" in path.read_text(encoding="utf-8")
    )
    tab.goto(lesson.as_uri())
    player = tab.locator(".armdyn-player").first
    clock = player.locator("output")
    before = clock.inner_text()
    player.get_by_role("button").click()
    expect(clock).not_to_have_text(before)
    assert tab.trouble == []


class Control:
    """A lesson's control on its page."""

    def __init__(self, tab, site, lesson):
        tab.goto((site / "lessons" / f"{lesson}.html").as_uri())
        self.root = tab.locator("[data-control]")
        expect(self.root).to_have_attribute("data-live", "")
        self.picture = self.root.locator("> svg")
        self.sliders = self.root.get_by_role("slider")

    @property
    def drawn(self) -> str:
        return self.picture.locator("> g").inner_html()


def test_each_control_is_alive(tab, site):
    lessons = [
        path.stem
        for path in sorted(ROOT.glob("lessons/*.ipynb"))
        if "ipywidgets.interact(" in path.read_text(encoding="utf-8")
    ]
    assert len(lessons) == 7
    for lesson in lessons:
        control = Control(tab, site, lesson)
        for slider in control.sliders.all():
            before, text = control.drawn, control.picture.get_attribute("aria-label")
            slider.focus()
            at_end = slider.input_value() == slider.get_attribute("max")
            tab.keyboard.press("Home" if at_end else "End")
            expect(control.picture).not_to_have_attribute("aria-label", text)
            assert control.drawn != before, (lesson, text)
            assert slider.get_attribute("aria-valuetext")
        expect(control.picture).to_have_attribute("role", "img")
        assert control.root.locator("> img").is_hidden()
    assert tab.trouble == []


def test_a_control_says_what_it_shows_and_leads_back(tab, site):
    control = Control(tab, site, "01-canonical-form")
    first, *_, last = control.sliders.all()
    start = control.drawn
    expect(control.picture).to_have_accessible_name(re.compile(r"q = \(0\.5, 1\.0\) rad"))
    first.press("ArrowRight")
    moved = control.drawn
    expect(first).not_to_have_attribute("aria-valuetext", "0.5")
    last.press("ArrowRight")  # of these six sliders only one at a time may be away from its start
    expect(first).to_have_attribute("aria-valuetext", "0.5")
    assert control.drawn not in (start, moved)
    control.root.get_by_role("button", name="Back to the start").click()
    assert control.drawn == start
    expect(control.root).to_contain_text("One slider at a time can be away from the start")


def test_a_control_of_boxes(tab, site):
    control = Control(tab, site, "10-state-space-and-simulation")
    box = control.root.get_by_role("checkbox", name="euler", exact=True)
    expect(control.picture).to_have_accessible_name(re.compile(r"^Step 0\.01 s: euler"))
    box.uncheck()
    expect(control.picture).to_have_accessible_name(re.compile(r"^Step 0\.01 s: semi_implicit"))


def test_on_paper_a_control_is_its_first_picture(tab, site):
    tab.emulate_media(media="print")
    control = Control(tab, site, "05-gravity")
    assert control.root.locator("> img").is_visible()
    assert control.picture.is_hidden()
    assert control.sliders.first.is_hidden()


@pytest.mark.parametrize("tab", [False], indirect=True)
def test_without_scripts_a_control_is_its_first_picture(tab, site):
    tab.goto((site / "lessons" / "05-gravity.html").as_uri())
    still = tab.locator("[data-control] > img")
    expect(still).to_have_accessible_name(re.compile(r"^The arm at q = \(20, 60\) degrees"))
    assert still.bounding_box()["width"] > 300
    assert tab.locator("[data-control] input").count() == 0


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_page_reads_well_in_the_light_and_in_the_dark(tab, site, scheme):
    tab.set_viewport_size(DESK)
    tab.emulate_media(color_scheme=scheme)
    tab.goto((site / "lessons" / "00-start-here.html").as_uri())
    diagram = tab.locator(".diagram svg", has_text="From motion to control")
    paper = tab.locator("body").evaluate(BRIGHTNESS, ["backgroundColor"])
    text = tab.locator("article p").first.evaluate(BRIGHTNESS, ["color"])
    box = diagram.locator(".node rect").first.evaluate(BRIGHTNESS, ["fill"])
    label = diagram.locator(".node text").first.evaluate(BRIGHTNESS, ["fill"])
    line = diagram.locator(".flowchart-link").first.evaluate(BRIGHTNESS, ["stroke"])
    assert (paper > 0.9) if scheme == "light" else (paper < 0.1)
    for ink, behind in ((text, paper), (label, box), (line, paper)):
        assert abs(ink - behind) > 0.3


def test_printed_a_lesson_stands_alone(tab, site):
    tab.set_viewport_size(DESK)
    tab.emulate_media(media="print")
    tab.goto((site / "lessons" / "05-gravity.html").as_uri())
    for beside in (".bd-sidebar-primary", ".bd-sidebar-secondary", ".bd-header-article"):
        assert tab.locator(beside).first.is_hidden(), beside
    assert tab.get_by_role("heading", name="05 · Gravity").first.is_visible()


def test_a_dark_page_is_printed_in_dark_letters(tab, site):
    tab.emulate_media(color_scheme="dark")
    tab.goto((site / "lessons" / "13-before-the-exam.html").as_uri())
    inks = ("#sheet td p", "#sheet mjx-container", ".highlight pre", ".diagram .node text")
    expect(tab.locator(", ".join(inks)).first).to_be_attached()

    def brightness():
        fill = ["fill" if "text" in ink else "color" for ink in inks]
        return [
            tab.locator(i).first.evaluate(BRIGHTNESS, [f]) for i, f in zip(inks, fill, strict=True)
        ]

    on_screen = brightness()
    assert min(on_screen) > 0.6
    # What the printer sees: the listener comes after the page's own.
    tab.evaluate(f"""inks => addEventListener("beforeprint", () => {{
      window.printed = inks.map(i => ({BRIGHTNESS})(
        document.querySelector(i), [i.includes("text") ? "fill" : "color"]));
    }})""", inks)  # fmt: skip
    tab.pdf()
    assert max(tab.evaluate("window.printed")) < 0.3
    assert brightness() == on_screen


def test_printed_the_formula_sheet_is_one_page(tab, site):
    tab.set_viewport_size(PAPER)
    tab.emulate_media(media="print")
    tab.goto((site / "lessons" / "13-before-the-exam.html").as_uri())
    tab.wait_for_function(TYPESET)
    sheet = tab.locator("#sheet")
    assert sheet.locator("tbody tr").count() > 20
    assert sheet.bounding_box()["height"] < PAPER["height"]
    assert sheet.locator("table").bounding_box()["width"] <= PAPER["width"]
    assert sheet.evaluate(
        "e => [getComputedStyle(e).breakBefore, getComputedStyle(e).breakAfter]"
    ) == [
        "page",
        "page",
    ]
