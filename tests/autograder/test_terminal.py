"""What is printed is text, on any terminal."""

import io

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder import terminal
from autograder.pipeline import run as pipeline
from autograder.pipeline.run import Line
from autograder.report import Class, Student, page, summary
from autograder.terminal import say, shown_points


def printed(text: str, encoding: str) -> bytes:
    raw = io.BytesIO()
    to = io.TextIOWrapper(raw, encoding, newline="\n")
    say(text, to)
    to.flush()
    return raw.getvalue()


@pytest.mark.parametrize(
    ("points", "shown"),
    [(8.966666666666667, "8.97"), (28.0, "28"), (8.5, "8.5"), (0.0, "0"), (-0.001, "0"),
     (100.0, "100"), (0.1 + 0.2, "0.3"), (1234.5678, "1234.57")],
)  # fmt: skip
def test_points_are_rounded_as_a_person_would(points, shown):
    assert shown_points(points) == shown
    assert f"ada      {shown} of 28" in pipeline.table([Line("ada", points, 28.0)])
    of = Class("p1", 28.0, [Student("ada", points)])
    assert f"mean {shown}, median {shown} of 28 points" in summary(of)
    assert f'<td class="number">{shown}</td>' in page(of)


def test_a_terminal_gets_nothing_to_obey():
    said = printed("ada\x1b]0;x\x07 \x9b1m\u202eb\udce9\n2 × José", "utf-8").decode()
    assert said == "ada\\x1b]0;x\\x07 \\x9b1m\\u202eb\\udce9\n2 × José\n"


def test_a_terminal_of_few_characters_gets_their_codes():
    assert printed("2 × José 机", "latin-1") == b"2 \xd7 Jos\xe9 \\u673a\n"
    assert printed("2 × José", "ascii") == b"2 \\xd7 Jos\\xe9\n"


@given(st.text())
def test_only_what_is_not_printable_is_changed(text):
    shown = terminal.plain(text)
    assert shown.replace("\n", "").isprintable()
    assert shown.count("\n") == text.count("\n")
    assert terminal.plain(shown) == shown
    if text.isprintable():
        assert shown == text


HOSTILE = st.text(max_size=30) | st.text("a \n\r\x1b[31m\u2028\udce9", max_size=9)


@given(HOSTILE, HOSTILE, HOSTILE)
def test_nothing_of_a_student_makes_a_line_of_the_table(student, states, note):
    lines = [Line(student, 1.0, 2.0, "1 correct", notes=(note, "last"))]
    shown = pipeline.table(lines).split("\n")
    assert len(shown) == 5
    assert "".join(shown).isprintable()
    verdict = {"check": "p3-M", "state": "incorrect", "credit": 0.0, "diagnosis": [states]}
    said = summary(Class("p3", 2.0, [Student(student, 1.0, 0, {"p3-M": verdict})]))
    assert len(said.split("\n")) == 2
    assert said.replace("\n", "").isprintable()
