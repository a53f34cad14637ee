"""Which mistakes a class made: how many made each, and who made the same two."""

import math
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import combinations

from autograder.judging.claims import as_written
from autograder.report.answers import anonymous
from autograder.report.carried_on import is_carried_on
from autograder.report.students import Student

MOST_GROUPS = 10
# Two answers are shown if chance brings so many who gave both together less often than this.
RARE = 0.01


@dataclass(frozen=True)
class Made:
    """A sentence of the diagnosis, its check, and the students who got it.

    Several mistakes may share a sentence, so no name of one stands here.
    """

    check: str
    sentence: str
    students: tuple[str, ...]


@dataclass(frozen=True)
class Together:
    """Wrong answers to two checks or more that the same students gave.

    expected: how many would have given all of them by chance, if to give one made no other likelier.
    """

    wrong: tuple[Made, ...]
    students: tuple[str, ...]
    expected: float


@dataclass(frozen=True)
class Example:
    """An answer that names nobody. arm: which arm it is about; "" where all have one."""

    code: str
    arm: str


def mistakes_made(students: Iterable[Student]) -> list[Made]:
    """Each sentence on a mistake that a student got, the most frequent first; none on an error that is
    only carried on.
    """
    to_whom = defaultdict(list)
    for student in students:
        for check, verdict in student.verdicts.items():
            own = [one for one in verdict["diagnosis"] if not is_carried_on(check, one)]
            said = map(as_written, own)
            for sentence in dict.fromkeys(said):
                to_whom[check, sentence].append(student.name)
    made = [Made(check, sentence, tuple(names)) for (check, sentence), names in to_whom.items()]
    return sorted(made, key=lambda one: (-len(one.students), one.check, one.sentence))


def made_together(made: list[Made], students: int) -> list[Together]:
    """The wrong answers to different checks that more students share than chance explains, rarest first.

    students: of the class. That answers are shared says that an explanation is missing, or that work was
    shared, or nothing: mistakes that many make come together by themselves.
    """
    found: dict[tuple[str, ...], dict[Made, None]] = {}
    shared = [one for one in made if len(one.students) > 1]
    for first, second in combinations(shared, 2):
        both = tuple(name for name in first.students if name in set(second.students))
        if first.check == second.check or len(both) < 2:
            continue
        if _chance(len(both), len(first.students), len(second.students), students) < RARE:
            found.setdefault(tuple(sorted(both)), {}).update({first: None, second: None})
    groups = []
    for names, answers in found.items():
        wrong = tuple(sorted(answers, key=lambda one: (one.check, one.sentence)))
        groups.append(Together(wrong, names, _expected(wrong, students)))
    groups.sort(key=lambda one: (one.expected / len(one.students), one.students))
    return groups[:MOST_GROUPS]


def _expected(wrong: tuple[Made, ...], students: int) -> float:
    """How many of a class would have given all these answers by chance; one of each check counts."""
    fewest: dict[str, int] = {}
    for one in wrong:
        fewest[one.check] = min(len(one.students), fewest.get(one.check, students))
    return students * math.prod(count / students for count in fewest.values())


def _chance(both: int, first: int, second: int, students: int) -> float:
    """The probability that at least so many made both, if to make one made the other no likelier."""
    ways = sum(
        math.comb(first, k) * math.comb(students - first, second - k)
        for k in range(both, min(first, second) + 1)
    )
    return ways / math.comb(students, second)


def example_of(made: Made, students: list[Student]) -> Example | None:
    """The shortest answer of those who made the mistake, without what could name its author."""
    names = [student.name for student in students]
    answers = [
        Example(anonymous(student.answers[made.check], names), student.arms.get(made.check, ""))
        for student in students
        if student.name in made.students and made.check in student.answers
    ]
    return min((one for one in answers if one.code), key=lambda one: len(one.code), default=None)
