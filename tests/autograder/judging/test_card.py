"""The card: every verdict readable without its colour, and nothing of a student's runs as HTML."""

import math
import re
from html.parser import HTMLParser
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.judging import verdict as verdicts
from autograder.judging.card import LOOKS, Line, drawing, html_card, mimebundle
from autograder.judging.passages import failing
from autograder.judging.verdict import AS_ABOVE, Failed, Row, State, Verdict, Witness
from autograder.problems.material.planar_2r import joints

TEXT = st.text(max_size=120) | st.sampled_from(
    ["<script>alert(1)</script>", "\"' onload='x", "</p></div>", "&lt;", "<img src=x onerror=x>"]
)
LENGTHS = st.floats(0.01, 10)
ANGLES = st.floats(-7, 7)


def pose_of(links) -> tuple[tuple[float, float], ...]:
    """The joints of a chain from the origin; links: (length, m, angle to the one before, rad)."""
    points, direction = [0j], 0.0
    for length, angle in links:
        direction += angle
        points.append(points[-1] + length * complex(math.cos(direction), math.sin(direction)))
    return tuple((point.real, point.imag) for point in points)


POSES = st.lists(st.tuples(LENGTHS, ANGLES), min_size=1, max_size=4).map(pose_of)
SAID = st.lists(TEXT, max_size=2).map(tuple)
VERDICTS = st.builds(
    Verdict,
    check=TEXT,
    state=st.sampled_from(State),
    credit=st.floats(0, 1),
    rows=st.lists(st.builds(Row, TEXT, st.floats(0, 1), st.booleans(), SAID), max_size=3).map(
        tuple
    ),
    witness=st.none()
    | st.builds(
        Witness, TEXT, TEXT, TEXT, st.just(()) | POSES, st.sampled_from(["", "M[0, 1]"]), TEXT
    ),
    problem=TEXT,
    diagnosis=st.lists(TEXT, max_size=2).map(tuple),
    remark=TEXT,
    further=TEXT,
    next_step=TEXT,
    failed=st.none() | st.builds(Failed, TEXT, st.just(1), st.integers(0, 9), TEXT, TEXT),
)
TAGS = ("div", "p", "strong", "span", "ul", "li", "code", "pre", "details", "summary")
MARK = '<b>"it\'s"&</b>'


class Card(HTMLParser):
    """The tags, the attributes and the words of a card."""

    def __init__(self, html: str):
        super().__init__()
        # A picture's own title is for who cannot see it, or points at it.
        html = re.sub("<title>.*?</title>", "", html)
        self.tags, self.attributes, self.words = [], [], []
        self.feed(html)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.attributes.append(dict(attributes))

    def handle_data(self, data):
        self.words.append(data)


def squeezed(text: str) -> str:
    """Without the blanks, which differ where lines are filled."""
    return re.sub(r"\s+", "", text)


def full(state: State) -> Verdict:
    return Verdict(
        "p3-g_vec",
        state,
        0.5,
        (Row("kinetic part", 0.5, True), Row("potential part", 0.5, False)),
        Witness("g_vec([0.3], m=1)", "2.1 N·m", "0.3 N·m (14 % of the right value)"),
        "It raised ValueError.",
        ("The sign is wrong.", "And the unit."),
        "It changes q.",
        next_step="Change your function.",
        failed=Failed(
            "g_vec([0.0], m=1)",
            2,
            6,
            "g_vec([0.3], m=1)",
            'q = worst_case("p3-g_vec")',
            by_name="g_vec(q)",
        ),
    )


@given(VERDICTS)
def test_the_card_has_only_its_own_tags(verdict):
    text, _, picture = html_card(verdict).partition("<svg ")
    card = Card(text)
    assert set(card.tags) <= set(TAGS)
    names = {name for attributes in card.attributes for name in attributes}
    assert names <= {"class", "data-state", "role", "aria-label", "style", "aria-hidden"}
    if picture:
        svg = ElementTree.fromstring(f"<svg {picture.removesuffix('</div></div>')}")
        assert {part.tag for part in svg} <= {"title", "line", "path", "circle"}


@pytest.mark.parametrize(
    "verdict",
    [
        Verdict(MARK, State.ERROR),
        Verdict("a", State.ERROR, problem=MARK),
        Verdict("a", State.INCORRECT, diagnosis=(MARK,)),
        Verdict("a", State.CORRECT, remark=MARK),
        Verdict("a", State.INCORRECT, next_step=MARK),
        Verdict("a", State.INCORRECT, rows=(Row(MARK, 1.0, False),)),
        Verdict("a", State.INCORRECT, witness=Witness(MARK, "1", "2")),
        Verdict("a", State.INCORRECT, witness=Witness("f", MARK, "2")),
        Verdict("a", State.INCORRECT, witness=Witness("f", "1", MARK)),
        Verdict("a", State.INCORRECT, witness=Witness("f", "1", "2", given_by=MARK)),
        Verdict("a", State.ERROR, failed=Failed(MARK)),
        Verdict("a", State.ERROR, failed=Failed("f", works=MARK)),
        Verdict("a", State.ERROR, failed=Failed("f", given_by=MARK)),
        Verdict("a", State.ERROR, failed=Failed("f", given_by="x", by_name=MARK)),
        Verdict("a", State.ERROR, failed=Failed(9 * MARK, by_name=MARK)),
        Verdict("a", State.INCORRECT, witness=Witness(9 * MARK, "1", "2", by_name=MARK)),
    ],
)
def test_what_comes_from_a_student_is_shown_as_it_is(verdict):
    html = html_card(verdict)
    assert "<b>" not in html
    assert MARK in "".join(Card(html).words)
    assert MARK in str(verdict)
    assert Card(html).attributes[0]["aria-label"] == verdict.headline


@pytest.mark.parametrize("state", State)
def test_every_state_has_a_mark_a_text_and_a_name(state):
    card = Card(html_card(full(state)))
    mark, _ = LOOKS[state]
    first, second, *_ = card.words
    assert (first, second) == (f"{mark} ", full(state).headline)
    assert str(state) in full(state).headline
    assert card.attributes[0]["data-state"] == state.name.lower().replace("_", "-")
    assert card.attributes[0]["role"] == "group"
    assert card.attributes[0]["aria-label"] == full(state).headline


def test_states_differ_in_mark_colour_and_name():
    assert LOOKS.keys() == set(State)
    marks, colours = zip(*LOOKS.values(), strict=True)
    assert len(set(marks)) == len(set(colours)) == len(State)


@pytest.mark.parametrize("state", State)
def test_the_mark_is_not_read_aloud(state):
    html = html_card(full(state))
    assert f'<span aria-hidden="true">{LOOKS[state][0]} </span>' in html


def test_partial_credit_is_in_the_headline():
    assert full(State.PARTLY_CORRECT).headline == "p3-g_vec: partly correct (50 %)"
    assert full(State.INCORRECT).headline == "p3-g_vec: incorrect"


@given(VERDICTS)
def test_plain_text_and_card_say_the_same_sentences(verdict):
    bundle = mimebundle(verdict)
    assert bundle.keys() == {"text/plain", "text/html"}
    card = squeezed("".join(Card(bundle["text/html"]).words))
    plain = squeezed(bundle["text/plain"])
    for sentence in [verdict.headline, *verdict.lines(), *(row.text for row in verdict.rows)]:
        assert squeezed(sentence) in card
        assert squeezed(sentence) in plain


@pytest.mark.parametrize("state", State)
def test_sentences_come_in_the_order_of_their_use(state):
    verdict = full(state)
    assert verdict.lines() == [
        "It raised ValueError.",
        "2 of 6 calls failed, the first of them: g_vec([0.0], m=1)",
        "This one works: g_vec([0.3], m=1)",
        "The sign is wrong.",
        "And the unit.",
        "It changes q.",
        "Worst case: g_vec([0.3], m=1) gave 2.1 N·m, off by 0.3 N·m (14 % of the right value).",
        "To work with the failed call, run this in a cell of your own:",
        'q = worst_case("p3-g_vec")\ng_vec(q)',
        "Change your function.",
    ]
    for text in (str(verdict), " ".join(Card(html_card(verdict)).words)):
        places = [squeezed(text).index(squeezed(line)) for line in verdict.lines()]
        assert places == sorted(places)


def test_rows_are_marked_in_words_and_in_plain_text():
    words = Card(html_card(full(State.PARTLY_CORRECT))).words
    assert "met: kinetic part (50 %)" in words
    assert "not met: potential part (50 %)" in words
    plain = str(full(State.PARTLY_CORRECT))
    assert "  [x] kinetic part (50 %)\n  [ ] potential part (50 %)\n" in plain
    alone = Verdict("a", State.CORRECT, 1.0, (Row("kinetic part", 1.0, True),))
    assert str(alone) == "a: correct\n  [x] kinetic part"
    assert "met: kinetic part" in Card(html_card(alone)).words


def test_without_inputs_only_the_size_of_the_error_is_told():
    verdict = full(State.INCORRECT).returned()
    for text in (str(verdict), html_card(verdict)):
        assert "Worst case: off by 0.3 N·m" in text
        assert "m=1" not in text
        assert "2.1" not in text
        assert "worst_case" not in text
        assert "[0.0]" not in text
    assert (verdict.worst, verdict.failed, verdict.again) == (None, None, "")
    assert Verdict("a", State.CORRECT).returned() == Verdict("a", State.CORRECT)


@given(VERDICTS)
def test_plain_text_is_narrow(verdict):
    for line in str(verdict).splitlines():
        if line.startswith("  ") and "[" not in line:
            assert len(line) <= 78


def svg_of(pose, **size):
    return ElementTree.fromstring(drawing(pose, **size))


def points_of(svg) -> np.ndarray:
    """Where joints and hand are drawn, y up, px."""
    return np.array([[float(c.get("cx")), -float(c.get("cy"))] for c in svg.iter("circle")])


@given(POSES)
def test_the_arm_is_drawn_to_scale_and_upright(pose):
    drawn, pose = points_of(svg_of(pose)), np.array(pose)
    drawn, pose = drawn - drawn[0], pose - pose[0]
    scale = np.linalg.norm(np.diff(drawn, axis=0)) / np.linalg.norm(np.diff(pose, axis=0))
    np.testing.assert_allclose(drawn, scale * pose, atol=0.3)  # px


@given(POSES, st.integers(60, 300))
def test_the_drawing_fits_its_frame_and_fills_it(pose, size):
    svg = svg_of(pose, size=size)
    width, height = float(svg.get("width")), float(svg.get("height"))
    assert max(width, height) == size + 20
    ends = [(float(line.get(f"x{k}")), float(line.get(f"y{k}")))
            for line in svg.iter("line") for k in (1, 2)]  # fmt: skip
    for x, y in ends:
        assert 9 < x < width - 9
        assert 9 < y < height - 9


@given(ANGLES, ANGLES)
def test_dashed_lines_show_from_where_the_angles_are_counted(q1, q2):
    svg = svg_of(pose_of([(1.0, q1), (0.8, q2)]))
    dashed = [line for line in svg.iter("line") if line.get("stroke-dasharray")]
    ways = [
        complex(
            float(line.get("x2")) - float(line.get("x1")),
            float(line.get("y1")) - float(line.get("y2")),
        )
        for line in dashed
    ]
    for way, angle in zip(ways, (0.0, q1), strict=True):
        assert abs(way / abs(way) - complex(math.cos(angle), math.sin(angle))) < 0.02


@given(ANGLES, ANGLES)
def test_the_drawing_is_said_in_words(q1, q2):
    arm = type("Arm", (), {"l1": 0.9, "l2": 0.7})
    svg = svg_of(joints(np.array([q1, q2]), arm))
    assert svg.get("role") == "img"
    said = svg.get("aria-label")
    assert said == svg.find("title").text
    found = re.fullmatch(
        r"The arm in the worst case: link 1 at (−?\d+)° from the x axis, "
        r"link 2 at (−?\d+)° from link 1\.",
        said,
    )
    for degrees, angle in zip(found.groups(), (q1, q2), strict=True):
        off = math.radians(float(degrees.replace("−", "-"))) - angle
        assert abs(math.remainder(off, math.tau)) <= math.radians(0.501)


def test_the_drawing_stands_after_the_text_and_not_without_a_pose():
    verdict = full(State.INCORRECT)
    assert "<svg" not in html_card(verdict)
    posed = Verdict("a", State.INCORRECT, witness=Witness("f", "1", "2", pose_of([(1, 0.3)])),
                    next_step="Go on.")  # fmt: skip
    html = html_card(posed)
    assert html.index("Go on.") < html.index("<svg")
    assert "<svg" not in html_card(posed.returned())


@given(TEXT.filter(bool))
def test_the_call_stands_as_code(call):
    card = html_card(Verdict("a", State.INCORRECT, witness=Witness(call, "1 N·m", "2 N·m")))
    words = Card(card).words
    assert "".join(words).endswith(f"Worst case: {call} gave 1 N·m, off by 2 N·m.")
    assert card.count("<code ") == card.count("</code>") == 1


class Items(HTMLParser):
    """The list items of a card, each with its words, and with their marks apart."""

    def __init__(self, html: str):
        super().__init__()
        self.items, self.marks, self._hidden = [], [], False
        self.feed(html)

    def handle_starttag(self, tag, attributes):
        self._hidden = dict(attributes).get("aria-hidden") == "true"
        if tag == "li":
            self.items.append([])

    def handle_data(self, data):
        if self._hidden and self.items:
            self.marks.append(data.strip())
        elif self.items:
            self.items[-1].append(data)


ENTRIES = Verdict(
    "p1-M",
    State.PARTLY_CORRECT,
    0.25,
    (
        Row("M11", 0.5, False, ("The sign.", "The half.")),
        Row("M22", 0.25, True),
        Row("M12", 0.25, False, ("The sign.", "The half.")),
    ),
    diagnosis=("The sign.", "The half.", "Of all."),
)


def test_each_sentence_stands_under_its_criterion():
    items = Items(html_card(ENTRIES)).items
    assert items[0] == ["not met: M11 (50 %)", "The sign.", "The half."]
    assert items[1] == ["met: M22 (25 %)"]
    assert items[2][:2] == ["not met: M12 (25 %)", AS_ABOVE]
    assert html_card(ENTRIES).index("Of all.") > html_card(ENTRIES).index(AS_ABOVE)
    assert str(ENTRIES).splitlines()[1:] == [
        "  [ ] M11 (50 %)",
        "      The sign.",
        "      The half.",
        "  [x] M22 (25 %)",
        "  [ ] M12 (25 %)",
        f"      {AS_ABOVE}",
        "  Of all.",
    ]


def test_met_and_unmet_rows_differ_by_word_mark_and_bar():
    html = html_card(ENTRIES)
    assert Items(html).marks == ["✗", "✓", "✗"]
    assert re.findall(r"border-left: 3px solid ([^;]+);", html) == [
        LOOKS[State.INCORRECT][1],
        "transparent",
        LOOKS[State.INCORRECT][1],
    ]
    assert '<ul role="list"' in html


@given(VERDICTS, TEXT)
def test_lines_of_the_notebook_come_last_and_as_text(verdict, said):
    lesson = Line("a lesson", '<a href="x">a lesson</a>')
    bundle = mimebundle(verdict, [lesson], [Line(said), Line("9 points")])
    card = Card(bundle["text/html"].partition("<svg")[0])
    assert card.tags.count("a") == 1
    for text in ("".join(card.words), bundle["text/plain"]):
        assert squeezed(text).endswith(squeezed(f"{said}9 points"))


@pytest.mark.parametrize("state", State)
def test_numbers_are_looked_at_before_they_are_changed_and_missing_ones_are_not(state):
    lines = [Line("a hint"), Line("a lesson")]
    bundle = mimebundle(full(state), lines, [Line("9 points")])
    order = ["a hint", "a lesson", "Change your function.", "9 points"]
    if state not in (State.INCORRECT, State.PARTLY_CORRECT):
        order = ["Change your function.", "a hint", "a lesson", "9 points"]
    for text in ("\n".join(Card(bundle["text/html"]).words), bundle["text/plain"]):
        places = [text.index(said) for said in order]
        assert places == sorted(places)


LONG = f"M(np.array([{', '.join(40 * ['0.5'])}]))"
NAMED = {"by_name": "M(q)", "given_by": 'q = worst_case("a")'}


@pytest.mark.parametrize(
    "verdict",
    [
        Verdict("a", State.INCORRECT, witness=Witness(LONG, "1 N·m", "2 N·m", **NAMED)),
        Verdict("a", State.ERROR, failed=Failed(LONG, **NAMED)),
        Verdict("a", State.ERROR, failed=Failed("M(0)", 1, 2, LONG, **NAMED)),
    ],
)
def test_a_long_call_is_folded_away(verdict):
    html = html_card(verdict)
    folds = re.findall(r"<details[^>]*><summary[^>]*>.*?</details>", html)
    assert len(folds) == 1
    assert LONG in folds[0]
    assert LONG not in html.replace(folds[0], "")
    shown = re.findall(r"<code[^>]*>([^<]*)</code>", html.replace(folds[0], ""))
    assert shown
    assert all(len(line) <= 90 for code in shown for line in code.splitlines())


def test_plain_text_shows_a_long_call_up_to_a_few_lines():
    short = Verdict("a", State.INCORRECT, witness=Witness(LONG, "1", "2", **NAMED))
    assert squeezed(LONG) in squeezed(str(short))
    longer = Witness(LONG.replace("0.5", "-0.123456"), "1", "2", **NAMED)
    text = str(Verdict("a", State.INCORRECT, witness=longer))
    assert "numbers" not in text
    assert 'q = worst_case("a")\n      M(q)' in text


def test_python_in_plain_text_is_broken_only_where_it_still_runs():
    call = f"from autograder import watch; watch({('p1-' + 20 * 'M')!r})"
    bundle = mimebundle(
        Verdict("a", State.INCORRECT), [Line.with_code("See what it does: {}", call)]
    )
    assert call in bundle["text/plain"]
    witness = Witness(LONG, "1", "2", by_name="M(q)", given_by=f"q = {LONG}")
    lines = str(Verdict("a", State.INCORRECT, witness=witness)).splitlines()
    start = next(k for k, line in enumerate(lines) if "q = M(" in line)
    names = {"np": np, "M": lambda q: q}
    exec("\n".join(line.strip() for line in lines[start:]), names)
    assert names["q"].shape == (40,)


@pytest.mark.parametrize(
    ("failed", "said"),
    [
        (Failed("f(1)"), "The check stopped at this call: f(1)"),
        (Failed("f(1)", 1, 1), "The one call failed: f(1)"),
        (Failed("f(1)", 6, 6), "All 6 calls failed, the first of them: f(1)"),
        (Failed("f(1)", 1, 6), "1 of 6 calls failed: f(1)"),
        (Failed("f(1)", 2, 6), "2 of 6 calls failed, the first of them: f(1)"),
    ],
)
def test_how_many_calls_failed(failed, said):
    assert [own.text for own in failing(failed)] == [said]
    card = html_card(Verdict("a", State.ERROR, failed=failed))
    assert "".join(Card(card).words).endswith(said)
    assert ">f(1)</code>" in card


@pytest.mark.parametrize(
    ("state", "step"),
    [
        (State.INCORRECT, verdicts.CHANGE_IT),
        (State.PARTLY_CORRECT, f"Mend M first, then this function{verdicts.RUN_AGAIN}"),
        (State.ERROR, verdicts.FIX_IT),
        (State.NOT_ATTEMPTED, "Write M(q), run its cell, then run this cell again."),
    ],
)  # fmt: skip
def test_a_page_that_comes_back_asks_for_nothing_to_be_run_on_it(state, step):
    shown = str(Verdict("p3-M", state, next_step=step).returned())
    assert "this cell" not in shown
    assert "run its cell" not in shown
    assert "own copy" in shown or "handed in" in shown
