"""What each student earns, from what was handed in and what the lecturer decided: no code of the kit."""

import math
import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from zoneinfo import ZoneInfo

from tests.rehearsal.mistakes import Mistake

BERLIN = ZoneInfo("Europe/Berlin")
DAY = 86_400


def percent(each: float, most: float = 100) -> Callable[[float, float], float]:
    return lambda points, late: points * min(each * math.ceil(late / DAY), most) / 100


def by_points(each: float, grace: float) -> Callable[[float, float], float]:
    return lambda points, late: min(points, each * math.ceil(max(0, late - 60 * grace) / DAY))


@dataclass
class Rule:
    """When an assignment is due, and what its late hand-ins lose: lost(points, seconds late)."""

    due: datetime
    written: str  # as the calendar has it
    lost: Callable[[float, float], float]
    counts: bool = True


def due(month: int, day: int, hour: int = 18) -> datetime:
    return datetime(2026, month, day, hour, tzinfo=BERLIN)


# p3 is due on the eve of the night in which Berlin's clocks go back.
RULES = {
    "p1-inertia": Rule(due(10, 9), "{ percent-per-day = 10, most-percent = 50 }", percent(10, 50)),
    "p2-energy-skew": Rule(due(10, 16), '"zero"', percent(100)),
    "p3-pendulum": Rule(
        due(10, 24), "{ points-per-day = 1, grace-minutes = 15 }", by_points(1, 15)
    ),
    "p4-gravity": Rule(due(10, 30), '"none"', lambda points, late: 0.0),
    "p5-state-space": Rule(due(11, 6), "{ percent-per-day = 25 }", percent(25)),
    "c6-regressor": Rule(due(11, 13), '"none"', lambda points, late: 0.0, False),
    "c7-recursive": Rule(due(11, 20), "{ percent-per-day = 10 }", percent(10)),
    "c8-control": Rule(due(11, 27), '"none"', lambda points, late: 0.0, False),
}
LATE = (-3 * DAY, -DAY, -3600, -1, 0, 60, 14 * 60, 16 * 60, DAY - 1, DAY + 1, 2 * DAY, 9 * DAY)
OFTEN = (20, 20, 20, 20, 20, 1, 1, 1, 2, 2, 2, 1)
WRONG = 0.4  # of the hand-ins


@dataclass
class HandIn:
    """answered: how many of the answers are there, from the first on; wrong: what is wrong in them, None
    where all are right. late: seconds after the due date.

    proof: its text. read: the points that a person gave it, None while nobody has read it.
    """

    answered: int
    proof: str
    late: int
    damaged: bool = False
    read: float | None = None
    to_read_again: bool = False
    wrong: Mistake | None = None

    @property
    def unread(self) -> bool:
        return bool(self.proof) and (self.read is None or self.to_read_again)


@dataclass
class Ledger:
    """hand_ins: by student and assignment. extensions: as long after the due date.

    points: of each assignment, the points of its tests in their order, by their names.
    """

    points: dict[str, dict[str, float]] = field(default_factory=dict)
    hand_ins: dict[tuple[str, str], HandIn] = field(default_factory=dict)
    extensions: dict[tuple[str, str], timedelta] = field(default_factory=dict)
    withdrawn: set[str] = field(default_factory=set)

    def status(self, student: str, name: str) -> str:
        """As the marks' table says it, without what it says of being late."""
        one = self.hand_ins.get((student, name))
        if one is None:
            return "nothing handed in"
        if one.damaged:
            return "could not be read"
        return "proof not yet marked" if one.unread else "graded"

    def raw(self, student: str, name: str) -> float:
        one = self.hand_ins[student, name]
        kept = one.wrong.kept if one.wrong else {}
        answered = list(self.points[name].items())[: one.answered]
        earned = sum(points * kept.get(test, 1) for test, points in answered)
        return earned + (one.read or 0)

    def made(self, name: str, wrong: Mistake) -> list[str]:
        """The students in whose hand-in this is wrong."""
        return [student for (student, of), one in self.hand_ins.items()
                if of == name and one.wrong is wrong and not one.damaged]  # fmt: skip

    def penalty(self, student: str, name: str) -> float:
        late = self.late(student, name)
        return RULES[name].lost(self.raw(student, name), late) if late > 0 else 0.0

    def late(self, student: str, name: str) -> float:
        granted = self.extensions.get((student, name), timedelta(0)).total_seconds()
        return self.hand_ins[student, name].late - granted

    def mark(self, student: str, name: str) -> float | None:
        if self.status(student, name) != "graded":
            return None
        return self.raw(student, name) - self.penalty(student, name)

    def total(self, student: str) -> float:
        marks = (self.mark(student, name) for name, rule in RULES.items() if rule.counts)
        return sum(one for one in marks if one is not None)


def drawn(
    dice: random.Random, name: str, asked: int, student: str, mistakes: Iterator[Mistake]
) -> HandIn | None:
    """What one student hands in; None for nothing."""
    if dice.random() > (0.95 if name.startswith("p") else 0.3):
        return None
    wrong = next(mistakes) if dice.random() < WRONG else None
    answered = asked if wrong else dice.choice((0, *range(asked + 1), asked, asked, asked))
    proof = f"By {student}: multiply by $\\dot q^T$, …" if dice.random() < 0.8 else ""
    (late,) = dice.choices(LATE, OFTEN)
    return HandIn(answered, proof, late, wrong=wrong)


def calendar(extensions: dict[tuple[str, str], timedelta], names: list[str]) -> str:
    """course/calendar.toml of these assignments, with these extensions."""
    lines = ['time-zone = "Europe/Berlin"']
    for name in names:
        rule = RULES[name]
        lines += [f"\n[{name}]", f'due = "{rule.due:%Y-%m-%d %H:%M}"', f"penalty = {rule.written}"]
        if name.startswith("c") and rule.counts:
            lines.append("counts = true")
        given = {who: long for (who, of), long in extensions.items() if of == name}
        if given:
            lines.append(f"\n[{name}.extensions]")
        # In UTC, so that an hour that Berlin has twice is no question.
        lines += [f'"{who}" = "{(rule.due.astimezone(ZoneInfo("UTC")) + long).isoformat()}"'
                  for who, long in given.items()]  # fmt: skip
    return "\n".join(lines) + "\n"
