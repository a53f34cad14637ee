"""A term as a lecturer follows it: each assignment in figures, totals, and who falls behind."""

from dataclasses import dataclass
from datetime import datetime
from statistics import mean

from autograder.report import figures
from autograder.report.students import Class

# An assignment that fewer have handed in may still be open.
MOST_OF_A_CLASS = 0.5
FALL = 0.25  # of an assignment's points, against the class


@dataclass(frozen=True)
class Step:
    """One assignment. share: the mean of those of whom everything is read, as a part of its points; None
    where there are none. of_checks: the same of the checks alone, of all who are graded.

    hints: how many a student saw, on average; None where no count is known. in_full: of how many
    everything is read, of `graded`.
    """

    assignment: str
    handed_in: int
    most: float
    share: float | None
    hints: float | None
    to_read: int
    of_checks: float | None = None
    in_full: int = 0
    graded: int = 0


@dataclass(frozen=True)
class Standing:
    """One student. points: in all, of `most` points of the assignments that count, are graded and read.
    missing: what the student has not handed in, and most others have. fell: by how much of an
    assignment's points the latest one lies below the earlier ones, each against the mean of the class.
    called: the full name, if it is known.
    """

    name: str
    points: float
    most: float
    missing: tuple[str, ...]
    fell: float
    called: str = ""

    @property
    def is_behind(self) -> bool:
        return bool(self.missing) or self.fell >= FALL


def in_order(classes: list[Class]) -> list[Class]:
    """As they were handed in; where a time is not known, by their names."""
    times = [figures.handed_in(of.students) for of in classes]

    def when(at: int) -> datetime:
        time = times[at]
        return time.middle if time else datetime.max

    if None in times:
        return sorted(classes, key=lambda of: of.assignment)
    return [classes[at] for at in sorted(range(len(classes)), key=when)]


def steps(classes: list[Class]) -> list[Step]:
    return [
        Step(
            of.assignment,
            len(of.students),
            of.most,
            mean(of.scores) / of.most if of.scores and of.most else None,
            _hints_each(of),
            sum(student.to_read for student in of.students),
            mean(of.check_scores) / of.of_checks if of.graded and of.of_checks else None,
            len(of.scores),
            len(of.graded),
        )
        for of in classes
    ]


def standings(classes: list[Class]) -> list[Standing]:
    """In order of the names. classes: in the order of the term."""
    names = sorted({student.name for of in classes for student in of.students})
    scores = [{one.name: one.points or 0.0 for one in of.students if one.in_full} for of in classes]
    called = {one.name: one.called for of in classes for one in of.students}
    found = []
    for name in names:
        graded = [(of, score) for of, score in zip(classes, scores, strict=True) if name in score]
        missing = [
            of.assignment
            for of in classes
            if name not in {student.name for student in of.students}
            and len(of.students) > MOST_OF_A_CLASS * len(names)
        ]
        found.append(
            Standing(
                name,
                sum(score[name] for of, score in graded if of.counts),
                sum(of.most for of, _ in graded if of.counts),
                tuple(missing),
                _fall([_against_the_class(of, score, name) for of, score in graded]),
                called[name],
            )
        )
    return found


def absent(classes: list[Class]) -> list[str]:
    """Who of the class list has handed in nothing at all."""
    return [name for name in classes[0].missing if all(name in of.missing for of in classes)]


def _hints_each(of: Class) -> float | None:
    known = [sum(student.hints.values()) for student in of.students if student.hints is not None]
    return mean(known) if known else None


def _against_the_class(of: Class, score: dict[str, float], name: str) -> float:
    return (score[name] - mean(score.values())) / of.most if of.most else 0.0


def _fall(apart: list[float]) -> float:
    return mean(apart[:-1]) - apart[-1] if len(apart) > 1 else 0.0
