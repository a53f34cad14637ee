"""What a report knows of a class: each student's verdicts and answers, and what else is on file."""

from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path

import nbformat

from autograder.notebook.answers import answers_to
from autograder.notebook.outputs import read_marks, read_verdict
from autograder.notebook.recognise import grade_id
from autograder.proofs import derivation_of
from autograder.protocol import one_line


@dataclass(frozen=True)
class Student:
    """One student's points, and the verdicts on the autograded notebook.

    points: with those that a person gave; None if nothing is graded. to_read: how many cells a
    person still has to read. of_checks: the points of the checks alone, without a penalty.
    verdicts: by check. note: why there are none. answers: the code cell that defines each check's
    function, by check. handed_in: in UTC, None where that is not known. hints: how many were seen,
    by check or derivation; None where that is not known. derivations: the marks, by id. arms: which
    arm an answer is about, in words, by check, where arms differ from student to student. called:
    the full name, "" where no class list tells it. late: as "late, −1.5", "" for one in time.
    """

    name: str
    points: float | None = None
    to_read: int = 0
    verdicts: dict[str, dict] = field(default_factory=dict)
    note: str = ""
    answers: dict[str, str] = field(default_factory=dict)
    handed_in: datetime | None = None
    hints: dict[str, int] | None = None
    derivations: dict[str, dict] = field(default_factory=dict)
    arms: dict[str, str] = field(default_factory=dict)
    called: str = ""
    late: str = ""
    of_checks: float = 0.0

    @property
    def in_full(self) -> bool:
        """Whether everything is graded and read."""
        return self.points is not None and not self.to_read


@dataclass(frozen=True)
class Class:
    """The students who handed in an assignment, which gives `most` points.

    missing: who of the class list did not. counts: whether it is part of the totals. of_checks: the
    points that the checks give, without what a person reads.
    """

    assignment: str
    most: float
    students: list[Student]
    missing: tuple[str, ...] = ()
    counts: bool = True
    of_checks: float = 0.0

    @property
    def checks(self) -> list[str]:
        """Of all students, in the order of the notebook."""
        return list(dict.fromkeys(check for one in self.students for check in one.verdicts))

    @property
    def derivations(self) -> list[str]:
        """Of all students, in the order of the notebook."""
        return list(dict.fromkeys(id for one in self.students for id in one.derivations))

    @property
    def graded(self) -> list[Student]:
        """Those who have points, also where a person still has to read an answer."""
        return [one for one in self.students if one.points is not None]

    @property
    def scores(self) -> list[float]:
        """Of those of whom everything is graded and read, in points."""
        return [one.points or 0.0 for one in self.students if one.in_full]

    @property
    def check_scores(self) -> list[float]:
        """The points of the checks alone, of all who are graded."""
        return [one.of_checks for one in self.graded]


def read_graded(
    notebook: Path,
) -> tuple[dict[str, dict], dict[str, str], dict[str, dict]]:
    """The verdicts in an autograded notebook, and the answers that they are on, both by check; and the
    marks of its derivations.

    ValueError if it cannot be read.
    """
    try:
        cells = nbformat.read(notebook, as_version=4).cells
        found = [
            read_verdict(output)
            for cell in cells
            if cell.metadata.get("nbgrader", {}).get("grade")
            for output in cell.get("outputs", [])
        ]
        verdicts = {one["check"]: one for one in found if one}
        marks = {
            one["derivation"]: one
            for cell in cells
            if derivation_of(grade_id(cell) or "")  # below no other cell it is the grader's
            for one in filter(None, map(read_marks, cell.get("outputs", [])))
        }
        return verdicts, answers_to(list(verdicts), cells), marks
    except Exception as error:  # the file may be JSON of any other kind
        raise ValueError(f"{notebook.name} cannot be read: {one_line(str(error))}") from None
