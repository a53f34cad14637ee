"""`solution` in a student's kernel: the worked answer where it is open, and before it a sentence."""

from datetime import UTC, datetime, timedelta
from html.parser import HTMLParser

import pytest

from autograder import derivation, solution, worked_answers
from autograder.judging.verdict import State, Verdict
from autograder.problems import UnknownCheckError
from autograder.problems.material.conventions import BOOK, FAMILY
from autograder.student import below, own_arm, progress
from tests.autograder.proofs.models import models

ANSWER = "def M(q, arm):\n    return 1 < 2  # <b>"
NOW = datetime.now().astimezone()


@pytest.fixture(autouse=True)
def folder(monkeypatch, tmp_path):
    """A student's folder of p1, in a kernel that has just started."""
    monkeypatch.setattr(own_arm, "_drawn", {})
    monkeypatch.setattr(progress, "_graded", {})
    there = tmp_path / "problems" / "p1-inertia"
    there.mkdir(parents=True)
    monkeypatch.chdir(there)
    return there


def opens(folder, when: str) -> None:
    worked_answers.write(folder / worked_answers.OPENS, {worked_answers.WHEN: when})


def said(capsys, id="p1-M") -> str:
    solution(id)
    return capsys.readouterr().out


def in_one_line(said: str) -> str:
    return " ".join(said.split())


def test_an_open_answer_is_shown(folder, capsys):
    worked_answers.write(folder / worked_answers.OPEN, {"p1-M": ANSWER, "p1-proof": "$x$"})
    assert said(capsys) == f"A worked answer for p1-M\n{ANSWER}\n"
    assert said(capsys, "p1-proof") == "A worked answer for p1-proof\n$x$\n"
    assert "There is no worked answer for p1-is_spd yet." in said(capsys, "p1-is_spd")
    assert "There is no worked answer for p1-symmetry yet." in said(capsys, "p1-symmetry")


def test_the_worked_lines_of_a_derivation_are_shown_as_code(folder, capsys):
    """For every arm the same, as its lines hold of every arm."""
    own_arm._drawn["p1"] = FAMILY[5]
    worked_answers.write(folder / worked_answers.OPEN, {"p1-symmetry": ANSWER})
    assert said(capsys, "p1-symmetry") == f"A worked answer for p1-symmetry\n{ANSWER}\n"


def test_a_complete_derivation_names_the_worked_lines_where_they_are_open(folder, capsys):
    def derived(lines) -> str:
        derivation("p1-symmetry", lines)
        return capsys.readouterr().out

    right = models()["p1-symmetry"]
    assert "worked answer" not in derived(right)
    worked_answers.write(folder / worked_answers.OPEN, {"p1-symmetry": ANSWER})
    call = 'from autograder import solution; solution("p1-symmetry")'
    assert f"A worked answer is open: {call}." in derived(right)
    assert "worked answer" not in derived(right[:-1])
    exec(call, {})


def test_the_course_exchange_is_looked_into_too(tmp_path, capsys):
    outbound = tmp_path / "course" / "exchange" / "armdyn" / "outbound" / "p1-inertia"
    outbound.mkdir(parents=True)
    worked_answers.write(outbound / worked_answers.OPEN, {"p1-M": ANSWER})
    assert ANSWER in said(capsys)


@pytest.mark.parametrize(
    ("when", "expected"),
    [
        (None, "Your instructor opens it, and has named no date so far."),
        ("soon", "Your instructor opens it, and has named no date so far."),
        (worked_answers.FULL_MARKS, "Your feedback page shows it if you have full marks for p1-M."),
        ("2099-12-15T12:00:00+00:00", "It opens on 15 December 2099, 12:00 (UTC)."),
        (
            "2020-02-05T12:00:00+00:00",
            "It was to open on 5 February 2020, 12:00 (UTC). Run `nbgrader",
        ),
    ],
)
def test_before_it_is_open_a_sentence_says_when(when, expected, folder, capsys, monkeypatch):
    monkeypatch.setattr(worked_answers, "time_of", time_in_utc(worked_answers.time_of))
    if when:
        opens(folder, when)
    assert in_one_line(said(capsys)).startswith(
        f"There is no worked answer for p1-M yet. {expected}"
    )


def time_in_utc(time_of):
    """`time_of` as on a machine whose clock shows UTC."""
    return lambda text: (time := time_of(text)) and time.astimezone(UTC)


def test_a_text_is_not_promised_with_full_marks(folder, capsys):
    opens(folder, worked_answers.FULL_MARKS)
    assert "opened for code and derivations alone" in in_one_line(said(capsys, "p1-proof"))
    assert in_one_line(said(capsys, "p1-positive")).endswith(
        "Your feedback page shows it if your lines for p1-positive are complete."
    )


def test_a_time_without_a_zone_is_of_this_machine():
    later = (NOW + timedelta(hours=1)).replace(tzinfo=None).isoformat()
    assert worked_answers.time_of(later) > NOW
    with pytest.raises(ValueError, match="'in December' is no time; write it as 2026-12-15"):
        worked_answers.time_of("in December")


@pytest.mark.parametrize("text", ["", "[]", "null", "{", "[" * 50_000, '{"p1-M": 3}'])
def test_a_damaged_file_is_as_none(text, folder, capsys):
    (folder / worked_answers.OPEN).write_text(text)
    (folder / worked_answers.OPENS).write_text(text)
    assert "has named no date so far" in in_one_line(said(capsys))


@pytest.mark.parametrize("id", [None, "p1-Mm", 3])
def test_an_unknown_check_is_refused(id):
    with pytest.raises(UnknownCheckError):
        solution(id)


@pytest.mark.parametrize(
    ("id", "differs"), [("p1-M", True), ("p1-is_spd", False), ("p1-proof", True)]
)
@pytest.mark.parametrize("own", [None, BOOK, FAMILY[5]], ids=["none", "book", "own"])
def test_who_has_an_own_arm_reads_that_the_answer_is_for_the_book(id, differs, own, folder, capsys):
    worked_answers.write(folder / worked_answers.OPEN, {id: ANSWER})
    if own:
        own_arm._drawn["p1"] = own
    assert (worked_answers.OF_THE_BOOK in said(capsys, id)) == (differs and own is FAMILY[5])


class Words(HTMLParser):
    def __init__(self, html):
        super().__init__()
        self.words, self.tags = [], []
        self.feed(html)

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)

    def handle_data(self, data):
        self.words.append(data)


def test_code_is_shown_as_it_is_and_a_text_as_markdown():
    code = worked_answers.mimebundle("p1-M", ANSWER, is_text=False)
    assert ANSWER in Words(code["text/html"]).words
    assert "b" not in Words(code["text/html"]).tags
    text = worked_answers.mimebundle("p1-proof", "$x$", is_text=True, remark="Of the book.")
    assert text["text/markdown"] == "**A worked answer for p1-proof**\n\nOf the book.\n\n$x$"


def test_a_card_names_it_after_a_right_answer_alone(folder):
    worked_answers.write(folder / worked_answers.OPEN, {"p1-M": ANSWER})
    right, wrong = (
        [line.text for line in below.lines(Verdict("p1-M", state))]
        for state in (State.CORRECT, State.INCORRECT)
    )
    call = 'from autograder import solution; solution("p1-M")'
    assert right == [f"A worked answer is open: {call}."]
    exec(call, {})
    assert "solution" not in " ".join(wrong)
    assert below.lines(Verdict("p1-is_spd", State.CORRECT)) == []
