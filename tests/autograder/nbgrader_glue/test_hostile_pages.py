"""No script of a student's runs in the browser of whoever reads the feedback page."""

import html
import os
import re
from html.parser import HTMLParser
from pathlib import Path
from types import SimpleNamespace

import pytest
from nbformat.v4 import new_markdown_cell, new_notebook
from nbgrader.server_extensions.formgrader.formgrader import FormgradeExtension

from autograder.judging import card
from autograder.judging.verdict import State, Verdict
from autograder.nbgrader_glue.feedback import FeedbackExporter
from autograder.nbgrader_glue.release import configuration
from autograder.notebook.grade import grade
from autograder.notebook.repair import NEW_CELL, repair
from autograder.notebook.scores import with_verdicts
from tests.autograder.nbgrader_glue.test_feedback import PIXEL
from tests.autograder.notebook.test_hostile import SOURCE, release  # noqa: F401  a fixture
from tests.submissions.attack import ROOT
from tests.submissions.hostile import ATTACKS
from tests.submissions.hostile_pages import LINK, LIVE

SHOWING = [name for name, attack in ATTACKS.items() if attack.edit.__module__.endswith("_pages")]
SHOWING += ["forged_card", "forged_outputs", "shifty_float"]


class Live(HTMLParser):
    """What of a page would run: the scripts, handlers and addresses that hold `forged`."""

    def __init__(self):
        super().__init__()
        self.found, self._script = [], False

    def handle_starttag(self, tag, attributes):
        self._script = tag == "script"
        if tag in ("base", "meta"):
            self.found += [(tag, value) for _, value in attributes if "forged" in (value or "")]
        for name, value in attributes:
            runs = name.startswith("on") or name in (
                "href",
                "src",
                "srcdoc",
                "action",
                "data",
                "data-link",
            )
            if runs and "forged" in (value or ""):
                self.found.append((tag, name, value))

    def handle_endtag(self, tag):
        self._script = False

    def handle_data(self, data):
        if self._script and "forged" in data:
            self.found.append(("script", data))


def live(page: str) -> list:
    reader = Live()
    reader.feed(page)
    return reader.found


def formgrader(folder):
    """The exporter of the formgrader's pages, as JupyterLab started in `folder` makes it."""
    before = Path.cwd()
    os.chdir(folder)
    try:
        extension = FormgradeExtension()
        extension.root_dir = str(folder)
        extension.initialize([])
        webapp = SimpleNamespace(settings={})
        extension.init_tornado_settings(webapp)
    finally:
        os.chdir(before)
    assert extension.config.HTMLExporter.template_name == "formgrade"
    return webapp.settings["nbgrader_exporter"]


@pytest.fixture(scope="module", params=["feedback", "formgrader"])
def exporter(request):
    if request.param == "formgrader":
        return formgrader(ROOT)
    return FeedbackExporter(config=configuration(ROOT), template_name="feedback")


def page_of(exporter, notebook) -> str:
    return exporter.from_notebook_node(notebook, {"index": 0, "total": 1})[0]


@pytest.mark.filterwarnings(
    "ignore:Your element with mimetype"
)  # nothing is left of an HTML output
@pytest.mark.parametrize("name", SHOWING)
def test_no_script_of_a_student_is_on_the_page(name, release, exporter, needs):  # noqa: F811
    needs("bubblewrap")
    graded = grade(ATTACKS[name].edit(release), SOURCE, "seed")
    page = page_of(exporter, with_verdicts(graded))
    assert live(page) == []
    assert "data-state=" in page  # the cards stay


@pytest.mark.parametrize("source", [LIVE, f"# {LIVE}", f"> - {LIVE}", f"| a |\n|---|\n| {LIVE} |",
    "<script>forged()</script>", "<SCRIPT\n>forged()</SCRIPT >", "</div></div><script>forged()",
    "<!-- --!><script>forged()</script> -->", "<style><img src=x onerror=forged()></style>",
    "[x](javascript:forged())", "[x](JaVaScRiPt:forged())", "[x](&#106;avascript:forged())",
    "[x](data:text/html,<script>forged()</script>)", "![x](javascript:forged())",
    "<a href='java\tscript:forged()'>x</a>", "<iframe srcdoc='<script>forged()</script>'></iframe>",
    "<iframe src=/forged></iframe>", "<form action=/forged><button>x</button></form>",
    "<object data=/forged>", "<meta http-equiv=refresh content='0;url=/forged'>",
    "<base href=//forged>", "<math><mtext><table><mglyph><style><img src=x onerror=forged()>",
    "<svg><p><style><img id='</style><img src=x onerror=forged()>'>", "<img src=/hub/logout?forged>",
    "![x](../../forged)", "![x](%2e%2e/forged)", "![x](a/../../../forged)", "<b data-link=/forged>x</b>",
    "$x$<img src=x onerror=forged()>$y$", "$<img src=x onerror=forged()>$", "![x](attachment:forged)",
    "```forged\n<script>forged()</script>\n```", "```mermaid\n<script>forged()</script>\n```",
    ">" * 9999 + LIVE])  # fmt: skip
@pytest.mark.parametrize("kind", ["markdown", "raw"])
def test_no_text_of_a_student_runs(source, kind, exporter):
    notebook = new_notebook(cells=[NEW_CELL[kind]("")])
    notebook.cells[0].source = source
    assert live(page_of(exporter, repair(notebook, new_notebook())[0])) == []


@pytest.mark.filterwarnings("ignore:No lexer found")
def test_no_setting_of_a_student_runs(exporter):
    forged = "x\"'><script>forged()</script>"
    notebook = new_notebook(nbformat_minor=4)
    for make in NEW_CELL.values():
        cell = make("![x](attachment:x)")
        cell.id = forged
        cell.metadata = {
            "tags": [forged],
            "raw_mimetype": "text/html",
            "name": forged,
            forged: forged,
        }
        if cell.cell_type == "code":
            cell.metadata["magics_language"] = forged
        else:
            cell.attachments = {"x": {forged: forged}}
        notebook.cells.append(cell)
    notebook.metadata = {"title": forged, "language_info": {"name": forged}}
    assert live(page_of(exporter, repair(notebook, new_notebook())[0])) == []


def test_a_students_text_cannot_pass_for_a_part_of_the_page(exporter):
    cell = new_markdown_cell(
        "<input class='score' id='p3-M'><div class='panel btn-success'>x</div>"
    )
    page = page_of(exporter, new_notebook(cells=[cell]))
    shown = page[page.rindex("text_cell") :]
    assert "<div>x</div>" in shown
    assert 'id="p3-M"' not in shown
    assert "btn-success" not in shown


@pytest.mark.parametrize("formula", ["$a<b$", "$a & b$", "$$\nx\n<y>z\n$$", r"$\text{<b>}$",
    "$x_a*b*c_d$", "\\begin{align}\na &< b \\\\\nc &\\ge d\n\\end{align}"])  # fmt: skip
def test_formulas_reach_the_page_as_written(formula, exporter):
    page = page_of(exporter, new_notebook(cells=[new_markdown_cell(f"so {formula} holds")]))
    (written,) = re.findall(
        r"<annotation encoding=.application/x-tex.>(.*?)</annotation>", page, re.S
    )
    assert html.unescape(written) == formula.strip("$\n")
    assert formula.strip("$") not in html.unescape(
        re.sub("(?s)<annotation.*?</annotation>", "", page)
    )


@pytest.mark.parametrize("formula", ["$_a_*b*$", r"$\foo<b>$", "$$\\frac{$$"])
def test_a_formula_that_is_none_stays_as_written(formula, exporter):
    page = page_of(exporter, new_notebook(cells=[new_markdown_cell(f"so {formula} holds")]))
    assert f"so {html.escape(formula)} holds" in page


def test_honest_text_is_shown_as_it_was_meant(exporter):
    text = "# H\n\n*a* **b** `c<d` [e](https://f.org) ![g](h%20i.png)\n\n- [x] j\n\n"
    text += "|k|l|\n|-|-|\n|m|n|\n\n<details><summary>o</summary>p<sub>1</sub></details>\n\n"
    text += "```python\nq = 1\n```\n\n![r](attachment:s.png)"
    cell = new_markdown_cell(text, attachments={"s.png": {"image/png": PIXEL}})
    page = page_of(exporter, new_notebook(cells=[cell]))
    for part in (">H</h", "<em>a</em>", "<strong>b</strong>", "<code>c&lt;d</code>",
                 '<a href="https://f.org">e</a>', "h i.png was not handed in", 'type="checkbox"',
                 "<td>m</td>", "<summary>o</summary>", "<sub>1</sub>", '<span class="mi">1</span>',
                 f'src="data:image/png;base64,{PIXEL}"', 'alt="r"'):  # fmt: skip
        assert part in page


def test_such_a_script_would_be_found():
    assert len(live(f"<p>{LIVE}</p><script>forged()</script>")) == 4
    assert live(f"<pre>{LIVE.replace('<', '&lt;')}</pre>") == []


def test_a_students_words_are_no_formula_in_the_card():
    words = f"M(q) raised ValueError: {LINK}."
    page = card.html_card(Verdict("p3-M", State.ERROR, problem=words))
    (paragraph,) = re.findall(r"<p [^>]*>[^<]*\\href", page)
    # MathJax 2 (nbconvert's own pages) and 3 (JupyterLab) leave these classes alone.
    assert 'class="armdyn-problem tex2jax_ignore mathjax_ignore"' in paragraph
