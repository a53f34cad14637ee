"""No script of a student's runs in the browser of whoever reads the feedback page."""

import re
from html.parser import HTMLParser

import pytest
from nbconvert.exporters import HTMLExporter

from autograder import card
from autograder.grade import grade
from autograder.nbgrader_glue import with_verdicts
from autograder.verdict import State, Verdict
from tests.autograder.test_hostile import SOURCE, release  # noqa: F401  a fixture
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
        for name, value in attributes:
            runs = name.startswith("on") or name in ("href", "src", "srcdoc", "action", "data")
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


@pytest.fixture(scope="module")
def exporter():
    return HTMLExporter(template_name="classic")


@pytest.mark.filterwarnings(
    "ignore:Your element with mimetype"
)  # nothing is left of an HTML output
@pytest.mark.parametrize("name", SHOWING)
def test_no_script_of_a_student_is_on_the_page(name, release, exporter, needs):  # noqa: F811
    needs("bubblewrap")
    graded = grade(ATTACKS[name].edit(release), SOURCE, "seed")
    page, _ = exporter.from_notebook_node(with_verdicts(graded))
    assert live(page) == []


def test_such_a_script_would_be_found():
    assert len(live(f"<p>{LIVE}</p><script>forged()</script>")) == 4
    assert live(f"<pre>{LIVE.replace('<', '&lt;')}</pre>") == []


def test_a_students_words_are_no_formula_in_the_card():
    words = f"M(q) raised ValueError: {LINK}."
    html = card.html_card(Verdict("p3-M", State.ERROR, problem=words))
    (paragraph,) = re.findall(r"<p [^>]*>[^<]*\\href", html)
    # MathJax 2 (nbconvert's pages) and 3 (JupyterLab) leave these classes alone.
    assert 'class="armdyn-problem tex2jax_ignore mathjax_ignore"' in paragraph
