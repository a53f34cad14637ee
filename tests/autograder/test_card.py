"""The card: every verdict readable without its colour, and nothing of a student's runs as HTML."""

import re
from html.parser import HTMLParser

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.card import LOOKS, html_card, mimebundle
from autograder.verdict import Row, State, Verdict, Witness

TEXT = st.text(max_size=120) | st.sampled_from(
    ["<script>alert(1)</script>", "\"' onload='x", "</p></div>", "&lt;", "<img src=x onerror=x>"]
)
VERDICTS = st.builds(
    Verdict,
    check=TEXT,
    state=st.sampled_from(State),
    credit=st.floats(0, 1),
    rows=st.lists(st.builds(Row, TEXT, st.floats(0, 1), st.booleans()), max_size=3).map(tuple),
    witness=st.none() | st.builds(Witness, TEXT, TEXT, TEXT),
    problem=TEXT,
    diagnosis=st.lists(TEXT, max_size=2).map(tuple),
    next_step=TEXT,
)
MARK = '<b>"it\'s"&</b>'


class Card(HTMLParser):
    """The tags, the attributes and the words of a card."""

    def __init__(self, html: str):
        super().__init__()
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
        Witness("g_vec([0.3], m=1)", "2.1 N·m", "0.3 N·m (14% of the right value)"),
        "It raised ValueError.",
        ("The sign is wrong.", "And the unit."),
        "Change your function.",
    )


@given(VERDICTS)
def test_the_card_has_only_its_own_tags(verdict):
    card = Card(html_card(verdict))
    assert set(card.tags) <= {"div", "p", "strong", "span", "ul", "li"}
    names = {name for attributes in card.attributes for name in attributes}
    assert names <= {"class", "data-state", "role", "aria-label", "style", "aria-hidden"}


@pytest.mark.parametrize(
    "verdict",
    [
        Verdict(MARK, State.ERROR),
        Verdict("a", State.ERROR, problem=MARK),
        Verdict("a", State.INCORRECT, diagnosis=(MARK,)),
        Verdict("a", State.INCORRECT, next_step=MARK),
        Verdict("a", State.INCORRECT, rows=(Row(MARK, 1.0, False),)),
        Verdict("a", State.INCORRECT, witness=Witness(MARK, "1", "2")),
        Verdict("a", State.INCORRECT, witness=Witness("f", MARK, "2")),
        Verdict("a", State.INCORRECT, witness=Witness("f", "1", MARK)),
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
    assert full(State.PARTLY_CORRECT).headline == "p3-g_vec: partly correct (50%)"
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
        "The sign is wrong.",
        "And the unit.",
        "Worst case: g_vec([0.3], m=1) gave 2.1 N·m, off by 0.3 N·m (14% of the right value).",
        "Change your function.",
    ]
    for text in (str(verdict), " ".join(Card(html_card(verdict)).words)):
        places = [squeezed(text).index(squeezed(line)) for line in verdict.lines()]
        assert places == sorted(places)


def test_rows_are_marked_in_words_and_in_plain_text():
    words = Card(html_card(full(State.PARTLY_CORRECT))).words
    assert "met: kinetic part (50%)" in words
    assert "not met: potential part (50%)" in words
    plain = str(full(State.PARTLY_CORRECT))
    assert "  [x] kinetic part\n  [ ] potential part\n" in plain


def test_without_inputs_only_the_size_of_the_error_is_told():
    verdict = full(State.INCORRECT).without_inputs()
    for text in (str(verdict), html_card(verdict)):
        assert "Worst case: off by 0.3 N·m" in text
        assert "m=1" not in text
        assert "2.1" not in text
    assert Verdict("a", State.CORRECT).without_inputs() == Verdict("a", State.CORRECT)


@given(VERDICTS)
def test_plain_text_is_narrow(verdict):
    for line in str(verdict).splitlines():
        if line.startswith("  ") and "[" not in line:
            assert len(line) <= 78
