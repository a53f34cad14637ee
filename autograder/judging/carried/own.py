"""A student's functions, asked anew to see whether one follows from others."""

from dataclasses import replace
from typing import Any

import numpy as np

from autograder.judging import dependence
from autograder.judging.carried.follows import Way
from autograder.judging.check import Ask, Check
from autograder.judging.criterion import TOLERANCE, met_by, scales
from autograder.judging.loops import Loop
from autograder.judging.quantities import Numbers, each
from autograder.protocol import Call, Reply, is_finite

# What follows has at least this share of the right answer's size, or it is as good as nothing.
LEAST_SIZE = 0.05
# It moves with at least this share of the numbers that the right one moves with.
LEAST_MOVING = 0.5
# The calls by which an earlier answer is judged once more.
FEW = 6
# Beside numbers of the right size, what is less than this share is rounding.
OF_ZERO = 1e-3


class NoneFollowsError(Exception):
    """An earlier function gave no numbers, or none that this answer could follow from."""


class Own:
    """A student's functions, asked anew."""

    def __init__(self, check: Check, calls: list[Call], ask: Ask, rng: np.random.Generator):
        self._check, self._ask, self._rng = check, ask, rng
        # A loop has no value that could follow.
        self._calls = [call for call in calls if not isinstance(call, Loop)]
        if not self._calls or (
            len(self._calls) < len(calls) and not isinstance(check.quantities, each)
        ):
            raise NoneFollowsError

    def borne_out(self, way: Way, earlier: list[Check]) -> tuple[dict[int, bool], list[str]]:
        """The criteria in which the answer follows from earlier ones, of which one is wrong; and of
        each, whether these are too plain for that to show anything; the names of the wrong ones.
        """
        check, calls = self._check, self._calls
        theirs = self._values(calls)
        probes = [] if way.of_own else _probes(check, calls[0])
        every = [*calls, *(probe.call for probe in probes)]
        values = [*theirs, *(None for _ in probes)]
        asked = [way.asks(call, own) for call, own in zip(every, values, strict=True)]
        answers, wrong, plain = self._of_earlier(earlier, asked, judged_by=not probes)
        made = [way.made(*three) for three in zip(every, values, answers, strict=True)]
        if any(own is None or not is_finite(own) for own in made):
            raise NoneFollowsError
        by = (
            way.quantities(check.quantities, calls, answers[: len(calls)])
            if way.quantities
            else check.quantities
        )
        followed, given = by(calls, made[: len(calls)]), by(calls, theirs)
        right = check._quantities_of(check.reference, calls)
        still = (
            check.quantities(calls, [_still(way, call) for call in calls]) if way.still else None
        )
        moves = self._moves(probes, [made[0], *made[len(calls) :]]) if probes else None
        found = {}
        for k, criterion in enumerate(check.criteria):
            if not any(map(np.size, _of(k, followed))):
                continue  # the loops speak of it alone
            if _same(criterion.tolerance, *(_of(k, some) for some in (followed, given, right))):
                small = _size(followed, still, k) < LEAST_SIZE * _size(right, still, k)
                found[k] = plain or small or (moves is not None and not moves[k])
        return found, wrong

    def wrong_among(self, earlier: list[Check]) -> list[str]:
        """The names of those that are wrong; none where not all give numbers."""
        calls = [self._calls_of(check) for check in earlier]
        numbers = self._apart(calls)
        return [
            c.name for c, *own in zip(earlier, calls, numbers, strict=True) if _is_wrong(c, *own)
        ]

    def _of_earlier(
        self, earlier: list[Check], asked: list[list[Call]], judged_by: bool
    ) -> tuple[list[list], list[str], bool]:
        """What the earlier functions gave for the calls asked; NoneFollowsError where all are right.

        judged_by: whether by their own arguments too plain ones are to be found, and whether one is.
        """
        of_checks = [self._calls_of(check) for check in earlier]
        probes = [
            _probes(c, own[0]) if judged_by else []
            for c, own in zip(earlier, of_checks, strict=True)
        ]
        probed = [[probe.call for probe in some] for some in probes]
        numbers = self._apart([*asked, *of_checks, *probed])
        answers, rest = numbers[: len(asked)], numbers[len(asked) :]
        judged, moved = rest[: len(earlier)], rest[len(earlier) :]
        three = list(zip(earlier, of_checks, judged, strict=True))
        wrong = [check.name for check, *own in three if _is_wrong(check, *own)]
        if not wrong:
            raise NoneFollowsError
        plain = False
        for (check, calls, values), some, after in zip(three, probes, moved, strict=True):
            if some:
                base = [calls[0], *(probe.call for probe in some)]
                plain = plain or not any(_enough(check, some, base, [values[0], *after]))
        return answers, wrong, plain

    def _moves(self, probes: list[dependence.Probe], made: list) -> list[bool]:
        """For each criterion, whether what follows moves with enough of the arguments."""
        calls = [self._calls[0], *(probe.call for probe in probes)]
        return _enough(self._check, probes, calls, made)

    def _calls_of(self, check: Check) -> list[Call]:
        return check.calls(self._rng, FEW)

    def _apart(self, groups: list[list[Call]]) -> list[list]:
        """The values of all calls, asked in one go and in a random order, in their groups again."""
        every = [replace(call, without=(self._check.name,)) for group in groups for call in group]
        order = self._rng.permutation(len(every))
        shuffled = self._values([every[place] for place in order])
        values: list[Any] = [None] * len(every)
        for place, value in zip(order, shuffled, strict=True):
            values[place] = value
        ends = np.cumsum([len(group) for group in groups])
        return [values[end - len(group) : end] for end, group in zip(ends, groups, strict=True)]

    def _values(self, calls: list[Call]) -> list:
        replies = self._ask(calls) if calls else []
        if len(replies) < len(calls) or any(_gives_none(reply) for reply in replies):
            raise NoneFollowsError
        return [reply.value for reply in replies]


def _of(k: int, numbers: Numbers) -> list:
    return [case[k] for case in numbers]


def _same(tolerance: float, followed: list, given: list, right: list) -> bool:
    """Whether an answer's numbers are those that follow. Where these are 0, all but rounding must be."""
    floor = OF_ZERO * max(float(np.max(np.abs(value), initial=0.0)) for value in right)
    least = (
        np.maximum(scales(followed), floor) if np.any(_sizes(followed) > floor) else floor or 1.0
    )
    return bool(
        np.all(_sizes([a - b for a, b in zip(followed, given, strict=True)]) <= tolerance * least)
    )


def _sizes(values: list) -> np.ndarray:
    return np.array([np.max(np.abs(value), initial=0.0) for value in values])


def _gives_none(reply: Reply) -> bool:
    return bool(reply.fault) or not is_finite(reply.value)


def _is_wrong(check: Check, calls: list[Call], values: list) -> bool:
    right = check._quantities_of(check.reference, calls)
    return not all(met_by(check.criteria, right, check.quantities(calls, values)))


def _probes(check: Check, call: Call) -> list[dependence.Probe]:
    return dependence.probes(check.signature, call) if isinstance(check.quantities, each) else []


def _enough(
    check: Check, probes: list[dependence.Probe], calls: list[Call], values: list
) -> list[bool]:
    """For each criterion, whether its numbers move with enough of what the right ones move with."""
    right, theirs = check._quantities_of(check.reference, calls), check.quantities(calls, values)
    found = []
    for k in range(len(check.criteria)):
        needed, used = (len(dependence.moving(k, probes, n, TOLERANCE)) for n in (right, theirs))
        found.append(used >= LEAST_MOVING * needed)
    return found


def _still(way: Way, call: Call) -> Any:
    assert way.still is not None
    return way.still(call)


def _size(numbers: Numbers, still: Numbers | None, k: int) -> float:
    """The largest number of a criterion, or the furthest from where nothing happens."""
    values = _of(k, numbers)
    if still:
        values = [value - at for value, at in zip(values, _of(k, still), strict=True)]
    return float(np.max(_sizes(values)))
