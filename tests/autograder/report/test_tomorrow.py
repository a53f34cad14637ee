"""What a lecturer would change tomorrow: mistakes with an example, shared ones, hints and criteria."""

import json
from datetime import datetime

import pytest

from autograder import report
from autograder.cli import main
from autograder.judging.verdict import State
from autograder.report import Class, Student, figures, mistakes
from autograder.report.answers import MOST_COLUMNS, MOST_LINES, anonymous
from tests.autograder import courses
from tests.autograder.courses import P3
from tests.autograder.report.test_report import Text
from tests.submissions import p3_pendulum
from tests.submissions.answers import cell_of

ROWS = [{"text": "kinetic part", "met": True}, {"text": "potential <i>part", "met": False}]
CODE = '''
def lagrangian(q, qd, m, lc, I, g):
    """By Ada Lovelace."""
    # ada, with help from bob
    Ada = 0.5  # a half
    text = "# not a comment"
    return Ada * I * qd**2 < 3
'''


def verdict(check: str, *sentences: str, rows=ROWS) -> dict:
    return {"check": check, "state": State.INCORRECT.value, "credit": 0.0,
            "diagnosis": [*sentences], "rows": rows}  # fmt: skip


def student(name: str, said: dict[str, str], **more) -> Student:
    """Who was told one sentence in each of these checks."""
    return Student(name, 1.0, 0, {id: verdict(id, one) for id, one in said.items()}, **more)


def test_an_example_names_nobody_and_keeps_its_code():
    shown = anonymous(CODE, ["ada", "bob", "q"])
    assert shown.splitlines() == [
        "def lagrangian(q, qd, m, lc, I, g):",
        "    … = 0.5",
        '    text = "# not a comment"',
        "    return … * I * qd**2 < 3",
    ]


@pytest.mark.parametrize("source", ["x = (1 # ada\n", "'''never closed # ada\n", "return ] # ada"])
def test_code_that_does_not_parse_loses_its_comments_too(source):
    assert "ada" not in anonymous(source, [])


def test_an_example_is_bounded():
    shown = anonymous("\n".join(f"x = {'9' * 500}" for _ in range(500)), [])
    assert len(shown.splitlines()) == MOST_LINES + 1
    assert max(map(len, shown.splitlines())) <= MOST_COLUMNS + 2


def test_three_mistakes_are_shown_with_the_shortest_answer_as_text():
    made = {"ada": "<script>alert(1)</script>", "bob": CODE, "cem": ""}
    told = [
        student(name, {"p3-lagrangian": "The half.", "p3-M": "One.", "p3-C": "Two.", "p3-g_vec": "x."},
                answers={"p3-lagrangian": code})
        for name, code in made.items()
    ]  # fmt: skip
    told.append(student("dee", {"p3-lagrangian": "The half."}))
    page = report.page(Class(P3, 15.0, told))
    text = str(Text(page))
    assert "4 of 4 students, p3-lagrangian. The half." in text
    assert "<script>alert(1)</script>" in text
    assert "script" not in Text(page).tags
    assert Text(page).tags.count("figure") == 1
    first, *_ = mistakes.mistakes_made(told)
    assert mistakes.example_of(first, told) == mistakes.Example("<script>alert(1)</script>", "")


def test_criteria_that_nobody_met():
    met = [{"text": "kinetic part", "met": False}, {"text": "potential <i>part", "met": False}]
    told = [
        Student("ada", 1.0, 0, {"p3-lagrangian": verdict("p3-lagrangian")}),
        Student("bob", 1.0, 0, {"p3-lagrangian": verdict("p3-lagrangian", rows=met)}),
    ]
    never = figures.never_met(told)
    assert never == [figures.NeverMet("p3-lagrangian", "potential <i>part", 2)]
    page = report.page(Class(P3, 15.0, told))
    assert "p3-lagrangian: potential <i>part (2 answers tried)" in str(Text(page))
    assert "i" not in Text(page).tags
    assert "nobody met: p3-lagrangian: potential <i>part" in report.summary(Class("", 15.0, told))


def test_of_a_check_that_stopped_every_answer_nobody_met_a_criterion():
    stopped = {"state": State.ERROR.value, "credit": 0.0, "diagnosis": [], "rows": []}
    told = [
        Student(name, 1.0, 0, {id: {"check": id} | stopped for id in ("p3-M", "p3-lagrangian")})
        for name in ("ada", "bob")
    ]
    told.append(Student("cem", 1.0, 0, {"p3-lagrangian": verdict("p3-lagrangian")}))
    assert figures.never_met(told) == [
        figures.NeverMet("p3-M", "inertia about the pivot", 2),
        figures.NeverMet("p3-lagrangian", "potential <i>part", 1),
    ]
    old = {key: value for key, value in verdict("p3-M").items() if key != "rows"}
    told.append(Student("dee", 1.0, 0, {"p3-M": old}))
    assert [one.check for one in figures.never_met(told)] == ["p3-lagrangian"]


def test_verdicts_of_an_earlier_version_have_no_criteria_and_are_read():
    old = {key: value for key, value in verdict("p3-M", "One.").items() if key != "rows"}
    told = [Student("ada", 1.0, 0, {"p3-M": old})]
    assert figures.never_met(told) == []
    assert "One." in report.page(Class(P3, 15.0, told))


def class_of(size: int, pairs: int, first: int, second: int) -> list[Student]:
    """`pairs` students made both mistakes; `first` and `second` students made one of them at all."""
    said = [{"p3-M": "One.", "p3-C": "Two."}] * pairs
    said += [{"p3-M": "One."}] * (first - pairs) + [{"p3-C": "Two."}] * (second - pairs)
    said += [{}] * (size - len(said))
    return [student(f"s{k}", one) for k, one in enumerate(said)]


@pytest.mark.parametrize(
    ("size", "pairs", "first", "second", "shown"),
    [
        (30, 2, 2, 2, True),  # 1 of 435
        (30, 3, 3, 3, True),
        (30, 2, 6, 3, False),  # 9 %
        (30, 8, 16, 15, False),  # as chance has it
        (30, 14, 15, 15, True),
        (30, 1, 1, 1, False),  # one student is no pair
        (2, 2, 2, 2, False),  # everybody made everything
    ],
)
def test_wrong_answers_are_shown_together_where_chance_does_not_explain_it(
    size, pairs, first, second, shown
):
    told = class_of(size, pairs, first, second)
    found = mistakes.made_together(mistakes.mistakes_made(told), size)
    assert bool(found) == shown
    if shown:
        (one,) = found
        assert len(one.students) == pairs
        assert one.expected == pytest.approx(first * second / size)


def test_students_who_share_more_than_two_stand_in_one_line():
    many = {"p3-M": "One.", "p3-C": "Two.", "p3-g_vec": "Three.", "p1-M": "Four."}
    told = [student(name, many) for name in ("dee", "eva", "finn")]
    told += [student(f"s{k}", {"p3-M": "One."} if k < 2 else {}) for k in range(27)]
    (one,) = mistakes.made_together(mistakes.mistakes_made(told), 30)
    assert one.students == ("dee", "eva", "finn")
    assert {made.check for made in one.wrong} == many.keys()
    assert one.expected == pytest.approx(30 * 5 / 30 * (3 / 30) ** 3)
    text = str(Text(report.page(Class(P3, 15.0, told))))
    assert "p3-M (5 students): One." in text
    assert "who dee, eva, finn" in text


def test_two_sentences_of_one_answer_are_no_two_wrong_answers():
    both = {"p3-M": verdict("p3-M", "One.", "Two.")}
    told = [Student("ada", 1, 0, both), Student("bob", 1, 0, both)]
    told += [student(f"s{k}", {}) for k in range(28)]
    assert mistakes.made_together(mistakes.mistakes_made(told), 30) == []


def test_hints_and_times():
    def at(day, hour):
        return datetime(2026, 11, day, hour)

    told = [
        student("ada", {"p3-M": "One."}, hints={"p3-M": 3}, handed_in=at(20, 8)),
        student("bob", {"p3-M": "One."}, hints={"p3-M": 1}, handed_in=at(27, 23)),
        student("cem", {"p3-M": "One."}, hints={}, handed_in=at(28, 8)),
        student("dee", {"p3-M": "One."}),
    ]
    assert figures.hints_seen(Class(P3, 15, told)) == [figures.HintsSeen("p3-M", 2, 3, 4)]
    times = figures.handed_in(told)
    assert (times.first, times.middle, times.last) == (at(20, 8), at(27, 23), at(28, 8))
    assert (times.in_last_day, times.known) == (2, 3)
    text = str(Text(report.page(Class(P3, 15.0, told))))
    assert "p3-M: 2 of 3 students saw a hint, 2 each" in text
    assert "to 2026-11-28 08:00 UTC, half of them by 2026-11-27 23:00; 2 of 3 in the last" in text
    assert figures.handed_in([]) is None


def test_how_far_derivations_came():
    def marks(done, lines, first_wrong=""):
        one = {"derivation": "p3-L", "done": done, "lines": lines, "first_wrong": first_wrong}
        return {"derivations": {"p3-L": one}}

    told = [
        student("ada", {"p3-M": "One."}, **marks(True, 7)),
        student("bob", {"p3-M": "One."}, **marks(False, 7, "The <i>sign.")),
        student("cem", {"p3-M": "One."}, **marks(False, 4, "The <i>sign."), hints={"p3-L": 2}),
        student("dee", {"p3-M": "One."}, **marks(False, 3)),
        student("eva", {"p3-M": "One."}, **marks(False, 0)),
    ]
    of = Class(P3, 15, told)
    assert figures.derived(of) == [figures.Derived("p3-L", 1, 3, 1, "The <i>sign.", 2)]
    said = (
        "p3-L: 1 complete, 3 begun, 1 not attempted. 2 students read of the first line that does not "
        "hold: The <i>sign."
    )
    for page in (report.page(Class(P3, 15.0, told)), report.term_page([of])):
        assert said in str(Text(page))
        assert "p3-L: 1 of 1 students saw a hint, 2 each" in str(Text(page))
        assert "i" not in Text(page).tags
    assert "Derivations" not in report.page(Class(P3, 15.0, [student("ada", {"p3-M": "One."})]))


def test_the_term_adds_up_assignments_and_names_each_student_once():
    first = Class(
        "p1-inertia", 15, [student("ada", {"p1-M": "A."}), student("bob", {"p1-M": "A."})]
    )
    second = Class(P3, 10, [student("ada", {"p3-M": "B."}), student("cem", {"p3-M": "B."})])
    text = str(Text(report.term_page([first, second])))
    assert text.count("ada ") == 1
    assert "2 of 3 students, p1-M" in text
    assert "2 of 2 students, p3-M" in text
    assert "ada 1 1 2 8 %" in text
    assert "bob 1 1 7 %" in text
    assert "cem: nothing for p1-inertia" in text
    assert report.term_summary([first, second]).splitlines() == [
        "p1-inertia: 2 of 2 graded, mean 1, median 1 of 15 points",
        f"{P3}: 2 of 2 graded, mean 1, median 1 of 10 points",
        "fallen behind: 2 of 3 students",
    ]


def test_the_commands_read_hints_times_and_answers_from_what_was_handed_in(
    tmp_path, monkeypatch, capsys
):
    root = courses.new_course(tmp_path / "course")
    monkeypatch.chdir(root)
    assert main(["report"]) == 2
    assert "nobody has handed in anything" in capsys.readouterr().err
    wrong = p3_pendulum.wrong(courses.release(root))
    lines = "def pendulum_lines():\n    return [('u = K', 'algebra')]"
    cell_of(wrong, "answer-p3-L").source = lines
    path = courses.submit(root, "ada", wrong, "2026-11-20 10:00:00 UTC")
    seen = {"p3-M": 2, "p3-L": 3, "p9-M": 3, "p3-C": "many"}
    path.with_name(".hints-seen.json").write_text(json.dumps(seen))
    courses.submit(root, "bob", wrong)
    assert main(["grade", P3, "--jobs", "1"]) == 0
    assert main(["report", P3]) == 0
    text = str(Text((root / "course" / "report" / f"{P3}.html").read_text(encoding="utf-8")))
    assert "p3-M: 1 of 1 students saw a hint, 2 each" in text
    assert "p3-L: 1 of 1 students saw a hint, 3 each" in text
    assert "p3-L: 0 complete, 2 begun, 0 not attempted" in text
    assert "2026-11-20 10:00 UTC" in text
    assert "2 of 2 students" in text
    assert "def M(q, pend):" in text or "def lagrangian(q, qd, m, lc, I, g):" in text
    assert "nobody met: p3-M: inertia about the pivot" in capsys.readouterr().out
    assert main(["report"]) == 0
    assert f"{P3}: 2 of 2 graded" in capsys.readouterr().out
    assert "def " in (root / "course" / "report" / "term.html").read_text(encoding="utf-8")
