"""The term in figures: the order and the mean of assignments, hints, totals, and who falls behind."""

from dataclasses import replace
from datetime import datetime

import pytest

from autograder import report
from autograder.nbgrader_glue.class_list import _arms
from autograder.problems.material.conventions import drawn
from autograder.report import Class, Student, mistakes, term
from tests.autograder.course_problems import problem
from tests.autograder.report.test_report import Text


def of_class(assignment: str, month: int | None, points: dict[str, float | None], **more) -> Class:
    when = datetime(2026, month, 1) if month else None
    return Class(assignment, 10.0, [Student(name, one, handed_in=when, **more)
                                    for name, one in points.items()])  # fmt: skip


STEADY = {"ada": 8.0, "bob": 6.0, "cem": 6.0, "dee": 4.0}
TERM = [
    of_class("p1", 11, STEADY, hints={"p1-M": 2, "p1-symmetry": 1}),
    of_class("p3", 10, STEADY, to_read=1),
    of_class("p4", 12, {"ada": 8.0, "bob": 3.0, "cem": 7.0}),
]


def standings(classes):
    return {one.name: one for one in term.standings(term.in_order(classes))}


def test_assignments_stand_as_they_were_handed_in():
    assert [of.assignment for of in term.in_order(TERM)] == ["p3", "p1", "p4"]
    unknown = [TERM[2], of_class("p0", None, STEADY)]
    assert [of.assignment for of in term.in_order(unknown)] == ["p0", "p4"]


def test_an_assignment_in_figures():
    first, second, third = term.steps(term.in_order(TERM))
    assert first == term.Step("p3", 4, 10.0, None, None, 4, graded=4)
    assert second == term.Step("p1", 4, 10.0, pytest.approx(0.6), 3.0, 0, in_full=4, graded=4)
    assert (third.handed_in, third.share) == (3, pytest.approx(0.6))
    (ungraded,) = term.steps([of_class("p1", 11, {"ada": None})])
    assert ungraded.share is None
    assert (
        "%"
        not in str(Text(report.term_page([of_class("p1", 11, {"ada": None})]))).split("Fallen")[0]
    )


def test_until_a_proof_is_read_the_checks_alone_have_a_mean():
    students = [Student("ada", 8.0, 1, of_checks=4.0), Student("bob", 6.0, 1, of_checks=5.0)]
    unread = Class("p1", 10.0, students, of_checks=5.0)
    (step,) = term.steps([unread])
    assert (step.share, step.of_checks) == (None, pytest.approx(0.9))
    page = str(Text(report.term_page([unread])))
    assert "90 % of the checks" in page
    assert "ada (8) bob (6)" in page
    assert "Of the checks alone, of all: mean 4.5, median 4.5 of 5 points" in page
    read = replace(unread, students=[replace(students[0], to_read=0), students[1]])
    assert term.steps([read])[0].share == pytest.approx(0.8)
    page = str(Text(report.term_page([read])))
    assert "80 % of the 1 of 2 read in full; of all, 90 % of the checks" in page
    said = report.summary(read).splitlines()[0]
    assert said == (
        "2 of 2 graded, 1 of these in full, mean 8, median 8 of 10 points; "
        "the checks alone: mean 4.5, median 4.5 of 5 points"
    )


def test_who_handed_in_nothing_all_term_is_named():
    classes = [replace(TERM[0], missing=("Nil", "Bo")), replace(TERM[2], missing=("Bo",))]
    page = str(Text(report.term_page(classes)))
    assert "1 of the class handed in nothing at all Bo" in page


def test_totals_are_of_what_is_graded_and_read():
    found = standings(TERM)
    assert (found["ada"].points, found["ada"].most) == (16.0, 20.0)
    assert (found["dee"].points, found["dee"].most) == (4.0, 10.0)
    assert "ada (8) 8 8 16 80 %" in str(Text(report.term_page(TERM)))


def test_who_falls_behind_is_missing_or_lower_than_before():
    found = standings(TERM)
    assert {name for name, one in found.items() if one.is_behind} == {"bob", "dee"}
    assert found["dee"].missing == ("p4",)
    assert found["bob"].fell == pytest.approx(0.3)
    page = str(Text(report.term_page(TERM)))
    assert "2 of 4 students: an assignment is missing" in page
    assert "bob: 30 % lower than before" in page
    assert "dee: nothing for p4" in page
    assert report.term_summary(TERM).splitlines()[-1] == "fallen behind: 2 of 4 students"


def test_a_hard_assignment_makes_nobody_fall_behind():
    hard = of_class("p4", 12, {name: points - 4.0 for name, points in STEADY.items()})
    assert not [one for one in standings([*TERM[:2], hard]).values() if one.is_behind]


def test_an_assignment_that_is_still_open_makes_nobody_fall_behind():
    still_open = of_class("p4", 12, {"ada": 8.0})
    assert not [one for one in standings([*TERM[:2], still_open]).values() if one.is_behind]


def test_an_example_says_whose_arm_it_is_about():
    arms = _arms(problem("p1-inertia").source, "bob", ["p1-M", "p1-is_spd"])
    assert arms == {"p1-M": ", ".join(drawn("bob", 2026).facts)}
    verdict = {"check": "p1-M", "state": "incorrect", "credit": 0.0, "diagnosis": ["The sign."]}
    told = Student(
        "bob", 0.0, 0, {"p1-M": verdict}, answers={"p1-M": "def M(q, arm): ..."}, arms=arms
    )
    (made,) = mistakes.mistakes_made([told])
    assert mistakes.example_of(made, [told]).arm == arms["p1-M"]
    said = f"One of these answers, without comments. In this student's arm, {arms['p1-M']}:"
    for page in (
        report.page(Class("p1-inertia", 15.0, [told])),
        report.term_page([Class("p1", 15.0, [told])]),
    ):
        assert said in str(Text(page))
    alone = replace(told, arms={})
    assert "without comments:" in str(Text(report.page(Class("p1-inertia", 15.0, [alone]))))


def test_a_problem_without_a_family_has_no_arms():
    assert _arms(problem("p3-pendulum").source, "bob", ["p3-M"]) == {}
    assert _arms(None, "bob", ["p1-M"]) == {}


def test_what_does_not_count_is_shown_and_not_added_up():
    challenge = replace(of_class("c6", 12, {"ada": 9.0}), counts=False)
    found = standings([*TERM, challenge])
    assert (found["ada"].points, found["ada"].most) == (16.0, 20.0)
    page = str(Text(report.term_page([*TERM, challenge])))
    assert "c6 (10, not counted)" in page
    assert "p1 (10)" in page
