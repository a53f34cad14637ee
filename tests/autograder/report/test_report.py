"""The page of a class: what it counts, and that it shows names and sentences as text only."""

from html.parser import HTMLParser

import pytest

from autograder import report
from autograder.cli import main
from autograder.judging.verdict import State
from autograder.notebook.grade import grade
from autograder.problems import CHECKS
from autograder.report import Class, Student
from tests.autograder import courses
from tests.autograder.courses import P3
from tests.submissions import p3_pendulum

CHECK = "p3-small_angle_frequency"
M = CHECKS[CHECK].mistakes
UNKNOWN = "The error is about 0.5 times <b>."


def verdict(state: State, *sentences: str) -> dict:
    return {CHECK: {"check": CHECK, "state": state.value, "credit": 0.0, "diagnosis": [*sentences]}}


CLASS = [
    Student("ada", 10.0, 1, verdict(State.CORRECT)),
    Student("bob", 4.0, 0, verdict(State.INCORRECT, M[0].sentence)),
    Student("cem", 1.0, 0, verdict(State.INCORRECT, M[1].sentence)),
    Student("dee", 1.0, 0, verdict(State.INCORRECT, M[1].sentence, UNKNOWN)),
    Student("<i>eve</i>", note="the notebook is not valid JSON"),
]


class Text(HTMLParser):
    """The words of a page, and its tags."""

    def __init__(self, page: str):
        super().__init__()
        self.words, self.tags, self._style = [], [], False
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self._style = tag == "style"

    def handle_data(self, data):
        if not self._style:
            self.words += data.split()

    def __str__(self):
        return " ".join(self.words).replace(" .", ".")


def test_mistakes_are_counted_the_most_frequent_first():
    made = report.mistakes_made(CLASS)
    once = {M[0].sentence: ("bob",), UNKNOWN: ("dee",)}
    assert [(one.sentence, one.students) for one in made] == [
        (M[1].sentence, ("cem", "dee")),
        *sorted(once.items()),
    ]


def test_the_page_says_it_all():
    text = str(Text(report.page(Class("p3-pendulum", 15.0, CLASS))))
    assert (
        "4 of 5 submissions graded. Of the 3 in which everything is read: mean 2, median 1 of 15 points."
        in text
    )
    assert "A person still has to read 1 answer: points in brackets are without them" in text
    assert "ada (10) 1" in text
    assert f"2 {CHECK} {M[1].sentence} who cem, dee" in text
    assert "bob 4" in text
    assert "<i>eve</i> the notebook is not valid JSON" in text
    assert f"{CHECK} 1 3" in text


def test_nothing_of_a_student_becomes_markup():
    tags = Text(report.page(Class("p3-pendulum", 15.0, CLASS))).tags
    assert not {"b", "i", "script"} & set(tags)


def test_the_terminal_gets_the_same_counts():
    lines = report.summary(Class("", 15.0, CLASS)).splitlines()
    assert lines[0] == "4 of 5 graded, 3 of these in full, mean 2, median 1 of 15 points"
    assert lines[1:] == [
        f"   2 × {CHECK}: {M[1].sentence}",
        *(f"   1 × {CHECK}: {sentence}" for sentence in sorted([M[0].sentence, UNKNOWN])),
    ]


@pytest.mark.parametrize("check", ["p3-M", "p3-inertia_about_pivot", "c6-regressor"])
def test_a_mistake_is_told_in_the_words_that_the_student_read_and_in_no_others(check):
    made = CHECKS[check].known_mistakes[-1]
    told = {"check": check, "state": "incorrect", "credit": 0.0, "diagnosis": [made.sentence]}
    of = Class("", 15.0, [Student(name, 0.0, 0, {check: told}) for name in ("ada", "bob")])
    assert report.summary(of).splitlines()[1] == f"   2 × {check}: {made.sentence}"
    for page in (report.page(of), report.term_page([of])):
        text = str(Text(page))
        assert f"2 of 2 students, {check}. {made.sentence}" in text
        assert made.name not in text.replace(made.sentence, "")


def test_an_empty_class_has_a_page_too():
    assert "0 of 0 submissions graded." in str(Text(report.page(Class("p3-pendulum", 15.0, []))))
    assert report.summary(Class("", 15.0, [])) == "0 of 0 graded"


def test_of_what_is_not_graded_nothing_is_said_but_what_to_do():
    of = Class(P3, 15.0, [Student("ada", note="not graded yet")])
    for page in (report.page(of), report.term_page([of])):
        text = str(Text(page))
        assert f"Nothing is graded yet: run autograder grade {P3} , then the report again." in text
        assert "Criteria that nobody met" not in text


def test_a_damaged_notebook_is_refused_by_name(tmp_path):
    path = tmp_path / "p3-pendulum.ipynb"
    path.write_text("{")
    with pytest.raises(ValueError, match=r"p3-pendulum\.ipynb cannot be read"):
        report.read_graded(path)


def test_the_command_reports_what_grading_left(tmp_path, monkeypatch, capsys):
    root = courses.new_course(tmp_path / "course")
    release = courses.release(root)
    for student, made in (("ada", p3_pendulum.right), ("bob", p3_pendulum.wrong)):
        courses.submit(root, student, made(release))
    monkeypatch.chdir(root)
    assert main(["grade", P3, "--jobs", "1"]) == 0
    courses.submit(root, "cem", "no notebook")
    courses.submit(root, "dee", release)
    (courses.submit(root, "eve", release).parent / "away").symlink_to("/etc/hostname")
    courses.submit(root, "fay", "{}").unlink()
    capsys.readouterr()
    assert main(["report", P3]) == 0
    said = capsys.readouterr().out
    assert (
        "2 of 6 graded, 1 of these in full, mean 0, median 0 of 15 points; "
        "the checks alone: mean 5, median 5 of 10 points"
    ) in said
    wrong = grade(p3_pendulum.wrong(release), release, "seed").verdicts
    text = str(Text((root / "course" / "report" / f"{P3}.html").read_text(encoding="utf-8")))
    for check, verdict in wrong.items():
        for sentence in verdict.diagnosis:
            assert f"{sentence} who bob" in text, check
    assert f"cem {P3}.ipynb is not valid JSON: ask the student for it again" in text
    assert f"dee not graded yet: run `autograder grade {P3}`" in text
    assert "eve away is a link out of the submission: ask the student for the file itself" in text
    assert "fay there is no notebook in what was handed in" in text


def test_an_unknown_assignment_is_refused_by_name(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(courses.new_course(tmp_path / "course"))
    assert main(["report", "p9-flying"]) == 2
    assert "there is no solutions/p9-flying/p9-flying.ipynb" in capsys.readouterr().err


def test_names_who_handed_in_nothing_and_who_was_late():
    student = Student("ada", 10.0, called="Ada <b>", late="late, −1.5")
    of = Class(P3, 15.0, [student], missing=("Nil Nihil", "<i>Bo</i>"))
    page = Text(report.page(of))
    assert "2 of the class handed in nothing Nil Nihil, <i>Bo</i>" in str(page)
    assert "ada Ada <b>" in str(page)
    assert "late, −1.5" in str(page)
    assert not {"i", "b"} & set(page.tags)
    assert report.summary(of).splitlines()[1] == "nothing handed in: 2 of the class"
