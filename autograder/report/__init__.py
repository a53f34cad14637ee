"""Reports a class on one page: scores, the state of each check, and how many made which mistake.

The verdicts come from the autograded notebooks, so it does not matter which command graded them; the
scores come from the gradebook, and include the points that a person gave.
"""

from collections import Counter, defaultdict
from collections.abc import Iterable
from dataclasses import dataclass, field
from importlib import resources
from pathlib import Path
from statistics import mean, median

import jinja2
import nbformat

from autograder.judging.card import LOOKS
from autograder.judging.verdict import State
from autograder.notebook.outputs import read_verdict
from autograder.problems import check_for
from autograder.protocol import one_line
from autograder.terminal import shown_note, shown_points

MOST_LINES = 10  # mistakes in the terminal; the page has all of them


@dataclass(frozen=True)
class Student:
    """One student's points, and the verdicts on the autograded notebook.

    points: with those that a person gave; None if nothing is graded. to_read: how many cells a person
    still has to read. verdicts: by check. note: why there are none.
    """

    name: str
    points: float | None = None
    to_read: int = 0
    verdicts: dict[str, dict] = field(default_factory=dict)
    note: str = ""


@dataclass(frozen=True)
class Made:
    """A sentence of the diagnosis, its check, and the students who got it.

    name: the mistake's name, if a person wrote the mistake.
    """

    check: str
    name: str
    sentence: str
    students: tuple[str, ...]


def read_verdicts(notebook: Path) -> dict[str, dict]:
    """The verdicts in an autograded notebook, by check. ValueError if it cannot be read."""
    try:
        cells = nbformat.read(notebook, as_version=4).cells
        verdicts = [
            read_verdict(output)
            for cell in cells
            if cell.metadata.get("nbgrader", {}).get("grade")
            for output in cell.get("outputs", [])
        ]
        return {one["check"]: one for one in verdicts if one}
    except Exception as error:  # the file may be JSON of any other kind
        raise ValueError(f"{notebook.name} cannot be read: {one_line(str(error))}") from None


def mistakes_made(students: Iterable[Student]) -> list[Made]:
    """Each sentence that a student got, the most frequent first."""
    to_whom = defaultdict(list)
    for student in students:
        for check, verdict in student.verdicts.items():
            for sentence in verdict["diagnosis"]:
                to_whom[check, sentence].append(student.name)
    made = [
        Made(check, _name_of(check, sentence), sentence, tuple(names))
        for (check, sentence), names in to_whom.items()
    ]
    return sorted(made, key=lambda one: (-len(one.students), one.check, one.sentence))


def _name_of(check: str, sentence: str) -> str:
    """Of a mistake that a person wrote; of one that follows from a mechanism the sentence says more."""
    known = check_for(check)
    mistakes = known.mistakes if known else ()
    return next((mistake.name for mistake in mistakes if mistake.sentence == sentence), "")


def page(assignment: str, most: float, students: list[Student]) -> str:
    """The report as an HTML page. most: the points of the assignment."""
    checks = list(dict.fromkeys(check for student in students for check in student.verdicts))
    counts = {
        check: Counter(
            student.verdicts[check]["state"] for student in students if check in student.verdicts
        )
        for check in checks
    }
    scores = [student.points for student in students if student.points is not None]
    template = resources.files(__package__).joinpath("page.html").read_text(encoding="utf-8")
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    environment.filters["points"] = shown_points
    return environment.from_string(template).render(
        assignment=assignment,
        most=most,
        students=students,
        checks=checks,
        counts=counts,
        states=[state.value for state in State],
        looks={state.value: look for state, look in LOOKS.items()},
        made=mistakes_made(students),
        graded=len(scores),
        mean=mean(scores) if scores else 0.0,
        median=median(scores) if scores else 0.0,
        to_read=sum(student.to_read for student in students),
    )


def summary(most: float, students: list[Student]) -> str:
    """The same in a few lines, for the terminal."""
    scores = [student.points for student in students if student.points is not None]
    lines = [f"{len(scores)} of {len(students)} graded"]
    if scores:
        middle = f"mean {shown_points(mean(scores))}, median {shown_points(median(scores))}"
        lines[0] += f", {middle} of {shown_points(most)} points"
    for one in mistakes_made(students)[:MOST_LINES]:
        lines.append(
            f"{len(one.students):4d} × {shown_note(f'{one.check}: {one.name or one.sentence}')}"
        )
    return "\n".join(lines)
