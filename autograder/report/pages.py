"""A report's pages, of one assignment and of the term, and the same in a few lines for the terminal."""

from collections import Counter
from functools import cache
from importlib import resources
from statistics import mean, median

import jinja2

from autograder.judging.card import LOOKS
from autograder.judging.verdict import State
from autograder.report import figures, term
from autograder.report.mistakes import example_of, made_together, mistakes_made
from autograder.report.stopped import stopped
from autograder.report.students import Class, Student
from autograder.terminal import shown_note, shown_points

MOST_LINES = 10  # mistakes in the terminal; the page has all of them
MOST_MADE = 3  # with an example


def page(of: Class) -> str:
    """The report on an assignment as an HTML page."""
    students = of.students
    counts = {
        check: Counter(
            student.verdicts[check]["state"] for student in students if check in student.verdicts
        )
        for check in of.checks
    }
    return _rendered(
        "page.html",
        of=_of_class(of),
        states=[state.value for state in State],
        looks={state.value: look for state, look in LOOKS.items()},
        counts=counts,
        made=mistakes_made(students),
    )


def term_page(classes: list[Class]) -> str:
    """The report on all assignments as an HTML page."""
    classes = term.in_order(classes)
    students = _of_term(classes)
    made = mistakes_made(students)
    standings = term.standings(classes)
    graded = {of.assignment: {one.name: one for one in of.graded} for of in classes}
    return _rendered(
        "term.html",
        classes=[_of_class(of) for of in classes],
        steps=term.steps(classes),
        standings=standings,
        absent=term.absent(classes),
        behind=[one for one in standings if one.is_behind],
        fall=term.FALL,
        graded=graded,
        worst=[(one, example_of(one, students)) for one in made[:MOST_MADE]],
        together=made_together(made, len(students)),
    )


def summary(of: Class) -> str:
    """The report on an assignment in a few lines, for the terminal."""
    students = of.students
    lines = [_how_many(of)]
    if of.missing:
        lines.append(f"nothing handed in: {len(of.missing)} of the class")
    for one in mistakes_made(students)[:MOST_LINES]:
        lines.append(f"{len(one.students):4d} × {shown_note(f'{one.check}: {one.sentence}')}")
    for never in figures.never_met(students):
        lines.append(shown_note(f"nobody met: {never.check}: {never.text}"))
    return "\n".join(lines)


def term_summary(classes: list[Class]) -> str:
    """The report on all assignments in a line each, and how many students fall behind."""
    lines = [f"{of.assignment}: {_how_many(of)}" for of in term.in_order(classes)]
    standings = term.standings(term.in_order(classes))
    behind = sum(one.is_behind for one in standings)
    return "\n".join([*lines, f"fallen behind: {behind} of {len(standings)} students"])


def _how_many(of: Class) -> str:
    graded, full = len(of.graded), len(of.scores)
    said = f"{graded} of {len(of.students)} graded"
    if graded > full:
        said += f", {full} of these in full"
    if of.scores:
        said += f", {_middle(of.scores, of.most)}"
    if graded > full and of.of_checks:
        said += f"; the checks alone: {_middle(of.check_scores, of.of_checks)}"
    return said


def _middle(scores: list[float], most: float) -> str:
    points = f"mean {shown_points(mean(scores))}, median {shown_points(median(scores))}"
    return f"{points} of {shown_points(most)} points"


def _of_class(of: Class) -> dict:
    """What both pages show of an assignment."""
    made = mistakes_made(of.students)
    return {
        "assignment": of.assignment,
        "most": of.most,
        "students": of.students,
        "missing": of.missing,
        "counts": of.counts,
        "checks": of.checks,
        "graded": len(of.graded),
        "full": len(of.scores),
        "middle": _middle(of.scores, of.most) if of.scores else "",
        "of_checks": _middle(of.check_scores, of.of_checks) if of.graded and of.of_checks else "",
        "to_read": sum(student.to_read for student in of.students),
        "worst": [(one, example_of(one, of.students)) for one in made[:MOST_MADE]],
        "together": made_together(made, len(of.students)),
        "never": figures.never_met(of.students),
        "stopped": stopped(of.students),
        "derived": figures.derived(of),
        "hints": figures.hints_seen(of),
        "times": figures.handed_in(of.students),
    }


def _of_term(classes: list[Class]) -> list[Student]:
    """Each student once, with the verdicts and answers of all assignments, in order of the names."""
    found: dict[str, Student] = {}
    for of in classes:
        for one in of.students:
            before = found.get(one.name, Student(one.name))
            found[one.name] = Student(
                one.name,
                verdicts=before.verdicts | one.verdicts,
                answers=before.answers | one.answers,
                arms=before.arms | one.arms,
            )
    return [found[name] for name in sorted(found)]


def _rendered(template: str, **values) -> str:
    return _environment().get_template(template).render(**values)


@cache
def _environment() -> jinja2.Environment:
    folder = resources.files(__package__)
    environment = jinja2.Environment(
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        loader=jinja2.FunctionLoader(
            lambda name: folder.joinpath(name).read_text(encoding="utf-8")
        ),
    )
    environment.filters["points"] = shown_points
    return environment
