"""Formulas become MathML: all of the course's, and nothing of a page's that is none."""

import re
import time
from html.parser import HTMLParser

import nbformat
import pytest

from autograder.nbgrader_glue.formulas import FORMULA, MOST_CHARACTERS, mathml, with_formulas
from autograder.nbgrader_glue.markdown import markdown2html
from tests.autograder.course_problems import ROOT

NOTEBOOKS = sorted([*ROOT.glob("lessons/*.ipynb"), *ROOT.glob("solutions/*/*.ipynb")])
NOT_FORMULAS = re.compile(r"(?s)<annotation.*?</annotation>|<code>.*?</code>|<pre.*?</pre>")


def shown(source: str) -> str:
    return markdown2html({"cell": {}, "resources": {}}, source)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_each_formula_of_the_course_is_mathml(path):
    texts = [cell.source for cell in nbformat.read(path, 4).cells if cell.cell_type == "markdown"]
    pages = "\n".join(map(shown, texts))
    assert pages.count("<math") > 10
    left = NOT_FORMULAS.sub("", pages)
    assert re.findall(r".{0,30}[$\\].{0,30}", left) == []


class Parts(HTMLParser):
    """The elements of a page, and what their attributes are."""

    def __init__(self, page: str):
        super().__init__()
        self.tags, self.attributes = [], set()
        self.feed(page)

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.attributes |= {(name, value) for name, value in attributes}


@pytest.mark.parametrize("latex", [r"\text{<img src=x onerror=forged()>}",
    r"\href{javascript:forged()}{x}", r"\style{background:url(//forged)}{x}", r"\class{btn-success}{x}",
    r"\text{</math><script>forged()</script>}",
    r"\mathbackground{x}", r"\colorbox{white}{\color{white}x}", "<script>forged()</script>",
    r"\text{&lt;script&gt;}", r"\hspace{99999em}x", r"\rule{9999em}{9999em}", r"\unicode{x3cscript}",
    r"\operatorname{<b onclick=forged()>}", r"\mathrm{<b>}",
    r"\begin{array}{<b>}x\end{array}"])  # fmt: skip
@pytest.mark.parametrize("way", ["inline", "block", "in HTML", "an output"])
def test_a_formula_brings_nothing_but_a_formula(latex, way):
    page = {
        "inline": lambda: shown(f"so ${latex}$"),
        "block": lambda: shown(f"$$\n{latex}\n$$"),
        "in HTML": lambda: shown(f"<div>${latex}$</div>"),
        "an output": lambda: with_formulas(f"$${latex}$$"),
    }[way]()
    parts = Parts(page)
    own = {"b"} if way == "in HTML" else set()  # there it is HTML
    assert not ({"img", "script", "a", "b"} - own) & set(parts.tags)
    names = {name for name, _ in parts.attributes}
    assert not {name for name in names if name.startswith("on")} | names & {"href", "style", "src"}
    assert {value for name, value in parts.attributes if name == "class"} <= {"formula"}
    assert not [value for _, value in parts.attributes if "9999" in value]


@pytest.mark.parametrize("latex", ["{" * 3000, r"\frac" * 800, r"\sqrt{" * 600 + "x" + "}" * 600,
    r"\begin{matrix}" * 250, "x_{" * 300 + "}" * 300, r"\left(" * 600, "a" * (MOST_CHARACTERS + 1),
    "a" * MOST_CHARACTERS, "^" * 3000, "&" * 3000, r"\\" * 2000, r"\foo", "", "x_a_b"])  # fmt: skip
def test_what_no_formula_can_be_stays_as_text_and_takes_no_time(latex):
    began = time.process_time()
    page = mathml(latex, False, f"${latex}$")
    assert time.process_time() - began < 2
    if not page.startswith("<math"):
        assert "<" not in page
        assert page.startswith("$")


def test_formulas_are_found_as_a_reader_finds_them():
    text = r"costs \$5, $a<b$ and $$c$$, \(d\), \[e\], \begin{align}f&=g\end{align} and 5$ more"
    found = [match[0] for match in FORMULA.finditer(text)]
    assert found == ["$a<b$", "$$c$$", r"\(d\)", r"\[e\]", r"\begin{align}f&=g\end{align}"]
    page = with_formulas(text)
    assert page.count("<math") == 5
    assert page.count('display="block"') == 3


def test_formulas_in_html_in_code_and_in_attributes():
    page = shown('<details><summary>see $x$</summary><b title="$y$">$$z$$</b></details>\n\n`$c$`')
    assert page.count("<math") == 2
    assert 'title="$y$"' in page
    assert "<code>$c$</code>" in page
    assert shown("<pre>$x$</pre>").count("<math") == 0


def test_a_letter_that_stands_upright_does_so():
    assert "<mtext>d</mtext>" in mathml(r"\mathrm{d}t", False, "")
    assert 'class="sans-serif"' in mathml(r"q^{\mathsf T}", False, "")
    assert 'accent="true"' in mathml(r"\dot q", False, "")
    assert "(1)" not in mathml(r"\begin{align}a&=b\\c&=d\end{align}", True, "")
