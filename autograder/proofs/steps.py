"""Whether a step holds in all worlds where its reasons are given."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from autograder.proofs.evaluating import Value, kind
from autograder.proofs.expression import Node
from autograder.proofs.parsing import LineError
from autograder.proofs.subject import Reason, Subject, World

MOST_WORK = 60_000  # nodes valued for one derivation, about a second
ROUNDING = 1e-11  # of the magnitudes that were added up


class TooMuchError(Exception):
    """MOST_WORK is done."""


@dataclass(frozen=True)
class Step:
    """relation: "=", ">" or ">=", between the line before and the one after."""

    relation: str
    before: Node
    after: Node


class Worlds:
    """The worlds of one subject, drawn when they are first asked for.

    limited: whether to raise TooMuchError once MOST_WORK is done.
    """

    def __init__(self, subject: Subject, rng: np.random.Generator):
        self._subject = subject
        self._rng = rng
        self._worlds: dict[frozenset[str], World] = {}
        self.limited = False

    def hold(self, step: Step, given: tuple[Reason, ...], more: Iterable[str] = ()) -> bool:
        """Whether the step follows from these reasons. more: properties that hold, too."""
        if self.limited and self._work() > MOST_WORK:
            raise TooMuchError
        world = self.given(given, more)
        try:
            before, after = world.value(step.before), world.value(step.after)
        except LineError:
            return False
        compared = _difference(before, after)
        if compared is None:
            return False
        difference, bound = compared
        if step.relation == "=":
            return bool((abs(difference) <= bound).all())
        if difference.shape[1:] != (1, 1):
            raise LineError(f"{step.relation} compares numbers; these are not.")
        if step.relation == ">":
            return bool((difference > bound).all())
        return bool((difference >= -bound).all())

    def same(self, one: Node, other: Node) -> bool:
        """Whether two expressions are equal by algebra."""
        return one == other or self.hold(Step("=", one, other), ())

    def given(self, given: tuple[Reason, ...], more: Iterable[str] = ()) -> World:
        """The world in which these reasons are given, and no other."""
        key = frozenset([*(reason.name for reason in given), *more])
        if key not in self._worlds:
            # As the subject lists them, so that the order in which they are typed does not matter.
            order = {reason.name: at for at, reason in enumerate(self._subject.reasons)}
            ordered = sorted(given, key=lambda reason: order.get(reason.name, len(order)))
            self._worlds[key] = World(self._subject, self._rng, tuple(ordered), more)
        return self._worlds[key]

    def witness(self, step: Step) -> str:
        """Both sides in one state where everything true is given."""
        world = self.given((self._subject.everything,), self._subject.truth)
        try:
            before, after = world.value(step.before), world.value(step.after)
        except LineError as error:
            return str(error)
        compared = _difference(before, after)
        if compared is None:
            return f"it is {kind(after)}, and the line before is {kind(before)}"
        difference, bound = compared
        off = abs(difference) - bound if step.relation == "=" else bound - difference
        at = np.unravel_index(np.argmax(off), off.shape)
        where = f"entry [{at[1]}, {at[2]}] of " if off.shape[1:] != (1, 1) else ""
        there = [np.broadcast_to(value.numbers, off.shape)[at] for value in (before, after)]
        return (
            f"in a random state of a random mechanism, {where}the line before is {there[0]:.3g}, and "
            f"this one {there[1]:.3g}"
        )

    def _work(self) -> int:
        return sum(world.work for world in self._worlds.values())


def _difference(before: Value, after: Value) -> tuple[np.ndarray, np.ndarray] | None:
    """Before − after, and the rounding that it may have; None where their shapes differ. Zero
    has every shape.
    """
    if before.shape != after.shape and not (before.is_zero or after.is_zero):
        return None
    difference = before.numbers - after.numbers
    return difference, ROUNDING * (before.size + after.size)
