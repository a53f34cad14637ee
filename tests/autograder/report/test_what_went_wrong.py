"""What a report takes for a mistake: no error that is only carried on; and answers without numbers."""

from dataclasses import replace

import pytest

from autograder import report
from autograder.judging.carried.judge import Carrying
from autograder.judging.verdict import State, Verdict
from autograder.notebook.outputs import of_verdict, read_verdict
from autograder.problems import CHECKS
from autograder.report import Class, Student
from autograder.report.mistakes import made_together
from autograder.report.stopped import Stopped, stopped
from tests.autograder.report.test_report import Text

P, G = "p4-potential_energy", "p4-g_vec"


def told(check: str, *diagnosis: str) -> dict:
    return {check: {"check": check, "state": State.INCORRECT.value, "diagnosis": [*diagnosis]}}


def stopped_by(check: str, problem: str) -> dict:
    output = of_verdict(Verdict(check, State.ERROR, problem=problem))
    return {check: read_verdict(output) or {}}


@pytest.mark.parametrize("share", [0.0, 0.5])
def test_an_error_carried_on_is_no_mistake_of_its_own(share):
    counts = Carrying(CHECKS.get, share)._counts(plain=False)
    follows = f"{CHECKS[G].follows[0].sentence} {counts}".strip()
    students = [
        Student(f"s{k}", 1.0, 0, told(P, "Upside down.") | told(G, follows)) for k in range(4)
    ]
    students += [Student(f"t{k}", 9.0, 0, {}) for k in range(40)]
    made = report.mistakes_made(students)
    assert [(one.check, one.sentence, len(one.students)) for one in made] == [
        (P, "Upside down.", 4)
    ]
    assert made_together(made, len(students)) == []
    # The same students, with a mistake of its own in the other answer.
    students[:4] = [
        replace(one, verdicts=told(P, "Upside down.") | told(G, "No link 2."))
        for one in students[:4]
    ]
    made = report.mistakes_made(students)
    assert [len(one.students) for one in made] == [4, 4]
    assert made_together(made, len(students))


def test_answers_that_gave_no_numbers_are_counted_with_what_most_of_them_read():
    raised = "g_vec(q, arm) raised NameError: name 'pi' is not defined"
    students = [
        Student("ada", 1.0, 0, stopped_by(G, f"{raised} (line 2: return pi * f(q).T). Or <b>?")),
        Student("bob", 1.0, 0, stopped_by(G, f"{raised} (line 7: x = pi).")),
        Student("cem", 1.0, 0, stopped_by(G, f"{raised} (the cell of P, line 7: x = pi).")),
        Student("dee", 1.0, 0, stopped_by(G, "g_vec(q, arm) did not return within 2 s.")),
        Student("eve", 1.0, 0, stopped_by(P, "potential_energy(q, arm) returned <i>.")),
        Student("fay", 1.0, 0, told(P, "Upside down.")),
    ]  # fmt: skip
    assert stopped(students) == [
        Stopped(G, 4, f"{raised}.", 3),
        Stopped(P, 1, "potential_energy(q, arm) returned <i>.", 1),
    ]
    page = Text(report.page(Class("p4-gravity", 15.0, students)))
    assert f"{G}: 4 students; 3 of them read: {raised}." in str(page)
    assert f"{P}: 1 student, who read: potential_energy(q, arm) returned <i>." in str(page)
    assert "i" not in page.tags
    # Some were graded by a version that did not keep what they read.
    unread = {G: {"state": State.ERROR.value, "diagnosis": []}}
    old = [Student(f"g{k}", 1.0, 0, unread) for k in range(9)]
    assert stopped(students + old)[0] == Stopped(G, 13, f"{raised}.", 3)
    text = str(Text(report.page(Class("p4-gravity", 15.0, old))))
    assert f"{G}: 9 students" in text
    assert "read:" not in text
    assert "Answers that gave no numbers" not in report.page(
        Class("p4-gravity", 15.0, students[5:])
    )
