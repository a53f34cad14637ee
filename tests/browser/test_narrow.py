"""On a phone nothing of ours scrolls sideways; and what a screen reader finds on a card."""

import numpy as np
import pytest
from nbgrader.converters import GenerateFeedback
from nbgrader.coursedir import CourseDirectory
from playwright.sync_api import expect

from autograder import worked_answers
from autograder.judging.card import mimebundle
from autograder.nbgrader_glue import feedback
from autograder.nbgrader_glue.release import configuration
from autograder.notebook.outputs import display
from autograder.notebook.scores import with_verdicts
from autograder.pictures.offers import offer
from autograder.problems import CHECKS, known_check
from autograder.proofs import DERIVATIONS, mark
from autograder.proofs import card as proof_card
from autograder.protocol import handed_in
from autograder.student import below, watch
from autograder.student.cell import verdict_on
from tests.autograder.course_problems import ROOT, problem
from tests.autograder.pictures.wrong import CART, function
from tests.autograder.student.test_worst_case import WRITTEN, namespace_of

PHONE = {"width": 390, "height": 844}
# What lies beyond the right edge of the page, of what we make.
BEYOND = """() => {
  const wide = e => e.getBoundingClientRect().right > document.documentElement.clientWidth + 1
    || (e.matches("[class^=armdyn]") && e.scrollWidth > e.clientWidth);
  const ours = document.querySelectorAll("[class^=armdyn], [class^=armdyn] *, img, svg");
  return [...ours].filter(wide).map(e => e.outerHTML.slice(0, 120));
}"""
FAILING = "def M(q, arm):\n    return np.ones(3) / (q[0] > 0)"


def html_of(check_id: str, source: str = "") -> str:
    check = known_check(check_id)
    namespace = namespace_of(check, source or WRITTEN.get(check_id, ""))
    verdict = verdict_on(check_id, namespace)
    lines = below.lines(verdict, offer(verdict, check, namespace))
    return mimebundle(verdict, lines, below.points(verdict))["text/html"]


def proofs() -> list[str]:
    """The cards of a derivation that is not begun, and of one with long lines that do not hold."""
    line = (" + ".join(20 * ["qd'M qdd"]), "product rule")
    states = np.random.default_rng(0)
    marked = [mark(DERIVATIONS["p2-E"], handed_in(lines), states) for lines in ([], [line, line])]
    return [proof_card.mimebundle(one)["text/html"] for one in marked]


@pytest.fixture(scope="module")
def cards(tmp_path_factory) -> str:
    """The address of a page with the cards, all unfolded; of each check that of a wrong answer."""
    shown = [html_of(check_id) for check_id in CHECKS]
    shown.append(html_of("p1-M", FAILING))
    cart = watch.shown(known_check("cart-pole-M"), {"M": function("cart-pole-M", CART)})
    shown += proofs()
    answer = f"def M(q, arm):\n    return {' + '.join(30 * ['arm.m2'])}"
    shown.append(worked_answers.mimebundle("p1-M", answer, False)["text/html"])
    body = "".join(shown).replace("<details", "<details open") + cart["text/html"]
    file = tmp_path_factory.mktemp("cards") / "cards.html"
    # As in a phone's notebook; the dark theme changes only colours, which the page has from JupyterLab.
    file.write_text(
        '<!DOCTYPE html><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
        f'<body style="font: 14px sans-serif">{body}',
        encoding="utf-8",
    )
    return file.as_uri()


@pytest.mark.parametrize("tab", [True, False], indirect=True, ids=["scripts", "no scripts"])
def test_no_card_scrolls_sideways_on_a_phone(tab, cards, tmp_path):
    tab.set_viewport_size(PHONE)
    tab.goto(cards)
    expect(tab.locator(".armdyn-verdict")).to_have_count(len(CHECKS) + 1)
    tab.screenshot(path=tmp_path / "cards.png", full_page=True)
    assert tab.evaluate(BEYOND) == []
    assert tab.evaluate("document.documentElement.scrollWidth") == PHONE["width"]


def test_a_screen_reader_tells_met_from_unmet_and_finds_what_is_folded(tab, cards):
    tab.goto(cards)
    card = tab.locator(".armdyn-verdict", has_text="p1-is_spd: partly correct")
    expect(card).to_match_aria_snapshot("""
      - 'group "p1-is_spd: partly correct (80 %)"':
        - list:
          - listitem: "met: positive definite told from indefinite (30 %)"
          - listitem: "met: semidefinite refused (20 %)"
          - listitem: "met: non-symmetric refused (30 %)"
          - listitem:
            - text: "not met: symmetric up to rounding accepted (20 %)"
            - paragraph: /You refuse matrices that differ/
        - paragraph:
          - text: "Worst case:"
          - code: is_spd(A)
        - group:
          - text: "This call in numbers:"
          - code: /is_spd\\(np\\.array/
        - paragraph: "To work with the worst case, run this in a cell of your own:"
        - code: /worst_case\\("p1-is_spd"\\) is_spd\\(A\\)/
        - paragraph:
          - code: hint("p1-is_spd")
        - paragraph: /Change your function/
    """)
    marks = card.locator("li > span[aria-hidden=true]").all_inner_texts()
    assert [mark.strip() for mark in marks] == ["✓", "✓", "✓", "✗"]
    bars = card.locator("li").evaluate_all(
        "all => all.map(e => getComputedStyle(e).borderLeftColor)"
    )
    assert len(set(bars)) == 2
    assert bars[0] == bars[1] == bars[2] == "rgba(0, 0, 0, 0)"


@pytest.fixture
def feedback_page(monkeypatch, tmp_path) -> str:
    """The address of the feedback page of a wrong p1, as `nbgrader generate_feedback` makes it."""
    for name in ("leave_out_unfit", "can_start"):  # they look for students, and here is none
        monkeypatch.setattr(feedback, name, lambda converter: None)
    graded = with_verdicts(problem("p1-inertia").graded("wrong"))
    nbgrader = GenerateFeedback(coursedir=CourseDirectory(), config=configuration(ROOT))
    # The grader's card has neither an arm nor a call: one that has is as wide as a card can be.
    drawn = next(cell for cell in graded.cells if cell.cell_type == "code")
    drawn.outputs = [*drawn.outputs, display({"text/html": html_of("p1-M")})]
    said = {"notebook": "p1-inertia", "score": 3, "max_score": 15, "late_penalty": 0}
    for cell in graded.cells:
        if "nbgrader" in cell.metadata:
            cell.metadata.nbgrader |= {"score": 1.0, "points": 2.0}
    page, _ = feedback.FeedbackExporter(config=nbgrader.config).from_notebook_node(
        graded, {"nbgrader": said}
    )
    file = tmp_path / "p1-inertia.html"
    file.write_text(page, encoding="utf-8")
    return file.as_uri()


def test_a_feedback_page_fits_a_phone_and_has_no_markers(tab, feedback_page, tmp_path):
    tab.set_viewport_size(PHONE)
    tab.goto(feedback_page)
    cards = tab.locator(".armdyn-verdict")
    assert cards.count() > 4
    tab.screenshot(path=tmp_path / "phone.png", full_page=True)
    assert tab.evaluate(BEYOND) == []
    assert tab.evaluate("document.documentElement.scrollWidth") == PHONE["width"]
    assert cards.first.bounding_box()["width"] > 280
    long = tab.locator("article > h3", has_text="inertia_from_links: From the links to the matrix")
    assert long.evaluate("e => e.scrollHeight <= e.clientHeight")
    words = tab.locator("body").text_content()
    assert 'check("p1-M", fresh=True)' in words
    assert "HIDDEN TESTS" not in words
    assert "###" not in words
