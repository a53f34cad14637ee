"""What a lecturer may want to count: criteria that nobody met, derivations, hints, times of hand-in."""

from collections import Counter
from dataclasses import dataclass
from datetime import datetime, timedelta
from statistics import median

from autograder.judging.verdict import State
from autograder.problems import check_here
from autograder.report.students import Class, Student


@dataclass(frozen=True)
class NeverMet:
    """A criterion that nobody met, and by how many answers it was tried."""

    check: str
    text: str
    tried: int


@dataclass(frozen=True)
class HintsSeen:
    """Of one check or derivation: how many students saw hints, of how many whose count is known, and how
    many hints they saw together.
    """

    check: str
    students: int
    known: int
    seen: int


@dataclass(frozen=True)
class Derived:
    """How far students came with a derivation. often: what most of them read of their first line that
    does not hold, and how many did; "" where no two read the same.
    """

    id: str
    complete: int
    begun: int
    not_attempted: int
    often: str
    by: int


@dataclass(frozen=True)
class HandedIn:
    """When a class handed in, UTC. in_last_day: how many did so in the 24 hours before the last one."""

    first: datetime
    middle: datetime
    last: datetime
    in_last_day: int
    known: int


def never_met(students: list[Student]) -> list[NeverMet]:
    """In the order of the checks. Verdicts that store no criteria, as older ones do not, say nothing;
    but of a check that stopped every answer with an error, nobody met anything.
    """
    tried: dict[tuple[str, str], int] = {}
    met: set[tuple[str, str]] = set()
    for student in students:
        for check, verdict in student.verdicts.items():
            for row in verdict.get("rows", ()):
                of = check, row["text"]
                tried[of] = tried.get(of, 0) + 1
                if row["met"]:
                    met.add(of)
    states = Counter(
        (check, verdict["state"])
        for student in students
        for check, verdict in student.verdicts.items()
        if verdict["state"] != State.NOT_ATTEMPTED
    )
    judged = {check for check, state in states if state != State.ERROR}
    for (check, _), count in states.items():
        if check not in judged and (known := check_here(check)):
            tried |= {(check, criterion.text): count for criterion in known.criteria}
    order = list(dict.fromkeys(check for student in students for check in student.verdicts))
    never = [NeverMet(*of, count) for of, count in tried.items() if of not in met]
    return sorted(never, key=lambda one: order.index(one.check))


def hints_seen(of: Class) -> list[HintsSeen]:
    """For each check and derivation of which somebody saw a hint, the most students first."""
    known = [student.hints for student in of.students if student.hints is not None]
    found = []
    for check in [*of.checks, *of.derivations]:
        counts = [hints[check] for hints in known if hints.get(check)]
        if counts:
            found.append(HintsSeen(check, len(counts), len(known), sum(counts)))
    return sorted(found, key=lambda one: -one.students)


def derived(of: Class) -> list[Derived]:
    """In the order of the notebook."""
    found = []
    for id in of.derivations:
        marks = [one.derivations[id] for one in of.students if id in one.derivations]
        complete = sum(mark["done"] for mark in marks)
        untouched = sum(not mark["lines"] for mark in marks)
        read = Counter(mark["first_wrong"] for mark in marks if mark["first_wrong"])
        often, by = next((one for one in read.most_common(1) if one[1] > 1), ("", 0))
        found.append(Derived(id, complete, len(marks) - complete - untouched, untouched, often, by))
    return found


def handed_in(students: list[Student]) -> HandedIn | None:
    """None where no time is known."""
    times = sorted(one.handed_in for one in students if one.handed_in is not None)
    if not times:
        return None
    start = times[0]
    middle = start + timedelta(seconds=median((time - start).total_seconds() for time in times))
    late = sum(time > times[-1] - timedelta(days=1) for time in times)
    return HandedIn(start, middle, times[-1], late, len(times))
