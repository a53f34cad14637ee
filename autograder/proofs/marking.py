"""Marks a derivation line by line, by numbers, and says what is still to be shown."""

import itertools
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from autograder.proofs.derivation import (
    ALGEBRA,
    MOST_REASONS,
    Derivation,
    FalseStep,
    Misuse,
    Row,
)
from autograder.proofs.evaluating import kind
from autograder.proofs.expression import Derivative, Name, Node, walk
from autograder.proofs.lines import Line, nearest
from autograder.proofs.marks import Marked, MarkedLine
from autograder.proofs.parsing import LineError, relation_and_sides
from autograder.proofs.subject import Reason, World
from autograder.protocol import HandedIn
from autograder.protocol.proofs import MOST_LINES

# Wrong lines for which all other reasons and mistakes are tried: people mend the first ones first.
MOST_DIAGNOSED = 6
MOST_WORK = 60_000  # nodes valued for one derivation, about a second
ROUNDING = 1e-11  # of the magnitudes that were added up


def mark(derivation: Derivation, given: HandedIn, rng: np.random.Generator) -> Marked:
    """The lines marked, each against the line before it, in random states of random mechanisms."""
    if given.problem:
        return Marked(derivation, problem=given.problem)
    lines = [Line.read(parts, derivation.reason_names) for parts in given.lines]
    return _Marking(derivation, rng).marked(lines)


class _TooMuchError(Exception):
    """MOST_WORK is done."""


@dataclass(frozen=True)
class _Step:
    relation: str
    before: Node
    after: Node


class _Marking:
    def __init__(self, derivation: Derivation, rng: np.random.Generator):
        self._derivation = derivation
        self._subject = derivation.subject
        self._rng = rng
        self._diagnosed, self._limited = 0, False
        self._worlds: dict[object, World] = {}
        self._start = derivation.read(derivation.start)
        self._goal = derivation.read(derivation.goal)

    def marked(self, lines: list[Line]) -> Marked:
        marked: list[MarkedLine] = []
        earned: set[Row] = set()
        before, holding, last, strict = self._start, True, self._start, False
        for at, line in enumerate(lines[:MOST_LINES]):
            step, after, relation = None, before, "="
            try:
                step, (after, relation) = self._step(line, before, at == 0)
                said = self._said(step, line) if step else ""
            except LineError as error:
                said = str(error)
            marked.append(MarkedLine(line.text, line.reasons, not said, said))
            holding = holding and not said
            before = after
            if holding:
                last, strict = after, strict or relation == ">"
                earned.update(self._earned_by(after))
        done = holding and bool(lines) and self._is_goal(last, strict)
        still = "" if done else self._still(last, holding, bool(lines))
        least = self._derivation.least_lines
        if done and len(lines) < least:
            done, still = (
                False,
                f"The end is reached in one go: show why, in {least} lines or more.",
            )
        if len(lines) > MOST_LINES:
            done, still = False, f"Only the first {MOST_LINES} lines are read."
        rows = self._derivation.rows
        return Marked(
            self._derivation,
            tuple(marked),
            done,
            still,
            tuple(row for row in rows if done or row in earned),
        )

    def _step(self, line: Line, before: Node, first: bool):
        """The step that a line claims, None for a first line that only says where it starts; and the
        expression behind it, with its relation.
        """
        relation, left, right = relation_and_sides(line.text)
        read = self._derivation.read
        after = read(right)
        if left:
            head = read(left)
            if first and not self._same(head, before):
                raise LineError("The derivation starts elsewhere: look at what is given.")
            if not (self._same(head, before) or self._same(head, self._start)):
                raise LineError("The left side is not the line before, nor where you started.")
        elif first and not relation and self._same(after, before):
            return None, (after, "=")
        relation = relation or "="
        if relation != "=" and self._derivation.relation == "=":
            raise LineError("Every step of this derivation is an equality.")
        self._value(after, self._world(()))  # its shapes fit
        return _Step(relation, before, after), (after, relation)

    def _said(self, step: _Step, line: Line) -> str:
        """What is wrong with a step; "" where it holds by its reasons."""
        given = self._given(line.reasons)
        derivation = self._derivation
        circular = [reason.name for reason in given if reason.name in derivation.to_prove]
        if circular:
            return f'"{circular[0]}" is what is to be proved; here it is assumed.'
        if self._holds(step, given):
            return self._unneeded(step, given)
        for misuse in derivation.misused:
            if misuse.reason in line.reasons and self._is_misuse(step, given, misuse):
                return misuse.sentence
        self._diagnosed += 1
        if self._diagnosed <= MOST_DIAGNOSED:
            self._limited = True
            try:
                return self._why(step, given)
            except _TooMuchError:
                pass
            finally:
                self._limited = False
        return f"This does not follow by {_named(given)}. Mend the lines above first."

    def _why(self, step: _Step, given: tuple[Reason, ...]) -> str:
        """Why a step does not follow by its reasons. _TooMuchError if that takes too long to find."""
        if said := self._other_reasons(step, given):
            return said
        everything = (self._subject.everything,), self._subject.truth
        true = self._holds(step, *everything)
        if found := self._mistake(step, given, true):
            return found.sentence
        if true:
            return (
                f"This does follow from the line before, but not by {_named(given)}, nor by one or two "
                "other reasons: put the steps between on lines of their own."
            )
        return f"This does not follow from the line before: {self._witness(step)}."

    def _work(self) -> int:
        return sum(world.work for world in self._worlds.values())

    def _given(self, names: tuple[str, ...]) -> tuple[Reason, ...]:
        if not names:
            raise LineError("Give a reason for this line.")
        given = []
        for name in names:
            if reason := self._subject.reason(name):
                given.append(reason)
            elif name != ALGEBRA:
                meant = nearest(name, self._derivation.reason_names)
                more = f" Did you mean {meant}?" if meant else ""
                raise LineError(f"{name!r} is no reason of the list.{more}")
        if len(given) > MOST_REASONS:
            raise LineError(f"At most {MOST_REASONS} reasons to a line: split it.")
        return tuple(given)

    def _unneeded(self, step: _Step, given: tuple[Reason, ...]) -> str:
        if given and self._holds(step, ()):
            return f"The line is right, and follows by algebra alone; {_named(given)} is not used in it."
        for reason in given:
            rest = tuple(other for other in given if other is not reason)
            if self._holds(step, rest):
                return (
                    f"The line is right, and follows by {_named(rest)}; {_named((reason,))} is not "
                    "used in it."
                )
        return ""

    def _is_misuse(self, step: _Step, given: tuple[Reason, ...], misuse: Misuse) -> bool:
        if step.relation not in misuse.relations or self._holds(step, ()):
            return False
        return not misuse.gives or self._holds(replace(step, relation=misuse.gives), given)

    def _other_reasons(self, step: _Step, given: tuple[Reason, ...]) -> str:
        derivation = self._derivation
        others = [reason for reason in self._subject.reasons if reason not in given]
        allowed = [reason for reason in others if reason.name not in derivation.to_prove]
        named = _named(given)
        for other in allowed:
            if self._holds(step, (other,)):
                return f"The line is right, but not by {named}: it needs {other.kind}."
        for other in allowed:
            if given and self._holds(step, (*given, other)):
                return f"The line is right, but {named} is not enough: it also needs {other.kind}."
        for other in others:
            if other not in allowed and self._holds(step, (*given, other)):
                return "This step uses what is to be proved."
        for pair in itertools.combinations(allowed, 2):
            if self._holds(step, pair) or (given and self._holds(step, (*given, *pair))):
                kinds = " and ".join(dict.fromkeys(reason.kind for reason in pair))
                return f"The line is right, but not by {named}: it needs {kinds}."
        return ""

    def _mistake(self, step: _Step, given: tuple[Reason, ...], true: bool) -> FalseStep | None:
        """The first mistake with which the step would follow: alone, with the reasons given, with one
        more, or with all that is true, if the step itself is not.
        """
        subject = self._subject
        others = [reason for reason in subject.reasons if reason not in given]
        held = _names(step.after, subject.rates)
        known: list[tuple[tuple[Reason, ...], tuple[str, ...]]] = [((), ()), (given, ())]
        known += [((*given, other), ()) for other in others]
        if not true:
            known.append(((subject.everything,), tuple(subject.truth)))
        for facts, properties in known:
            for mistake in self._derivation.mistakes:
                if mistake.gone in held:
                    continue
                false = Reason(mistake.name, "", "", mistake.defines)
                more = (mistake.property,) if mistake.property else ()
                if self._holds(step, (*facts, false), (*properties, *more)):
                    return mistake
        return None

    def _holds(self, step: _Step, given: tuple[Reason, ...], more: Iterable[str] = ()) -> bool:
        if self._limited and self._work() > MOST_WORK:
            raise _TooMuchError
        world = self._world(given, more)
        try:
            before, after = self._value(step.before, world), self._value(step.after, world)
        except LineError:
            return False
        difference, bound = _difference(before, after)
        if difference is None:
            return False
        if step.relation == "=":
            return bool((abs(difference) <= bound).all())
        if difference.shape[1:] != (1, 1):
            raise LineError(f"{step.relation} compares numbers; these are not.")
        if step.relation == ">":
            return bool((difference > bound).all())
        return bool((difference >= -bound).all())

    def _same(self, one: Node, other: Node) -> bool:
        """Whether two expressions are equal by algebra."""
        return one == other or self._holds(_Step("=", one, other), ())

    def _world(self, given: tuple[Reason, ...], more: Iterable[str] = ()) -> World:
        key = frozenset([*(reason.name for reason in given), *more])
        if key not in self._worlds:
            # As the subject lists them, so that the order in which they are typed does not matter.
            order = {reason.name: at for at, reason in enumerate(self._subject.reasons)}
            ordered = sorted(given, key=lambda reason: order.get(reason.name, len(order)))
            self._worlds[key] = World(self._subject, self._rng, tuple(ordered), more)
        return self._worlds[key]

    def _value(self, node: Node, world: World):
        return world.value(node)

    def _earned_by(self, node: Node) -> list[Row]:
        read = self._derivation.read
        return [
            row
            for row in self._derivation.rows
            if row.milestone and self._same(node, read(row.milestone))
        ]

    def _is_goal(self, last: Node, strict: bool) -> bool:
        return self._same(last, self._goal) and (strict or self._derivation.relation == "=")

    def _still(self, last: Node, holding: bool, any_lines: bool) -> str:
        said = self._derivation.goal_said
        if not any_lines:
            return f"To be shown: {said}."
        if not holding:
            return f"Mend the lines marked ✗. To be shown: {said}."
        if self._same(last, self._goal):
            return f"Still to be shown: {said}. So far you have ≥."
        rates = self._subject.rates
        left = sorted(_names(last, rates) - _names(self._goal, rates))
        more = f" Your last line still holds {', '.join(left)}." if left else ""
        return f"All lines hold. Still to be shown: {said}.{more}"

    def _witness(self, step: _Step) -> str:
        """Both sides in one state where everything true is given."""
        world = self._world((self._subject.everything,), self._subject.truth)
        try:
            before, after = self._value(step.before, world), self._value(step.after, world)
        except LineError as error:
            return str(error)
        difference, bound = _difference(before, after)
        if difference is None:
            return f"it is {kind(after)}, and the line before is {kind(before)}"
        off = abs(difference) - bound if step.relation == "=" else bound - difference
        at = np.unravel_index(np.argmax(off), off.shape)
        where = f"entry [{at[1]}, {at[2]}] of " if off.shape[1:] != (1, 1) else ""
        there = [np.broadcast_to(value.numbers, off.shape)[at] for value in (before, after)]
        return (
            f"in a random state of a random mechanism, {where}the line before is {there[0]:.3g}, and "
            f"this one {there[1]:.3g}"
        )


def _difference(before, after):
    """Before − after, and the rounding that it may have; (None, None) where their shapes differ. Zero
    has every shape.
    """
    if before.shape != after.shape and not (before.is_zero or after.is_zero):
        return None, None
    difference = before.numbers - after.numbers
    return difference, ROUNDING * (before.size + after.size)


def _named(reasons: tuple[Reason, ...]) -> str:
    return " and ".join(f'"{reason.name}"' for reason in reasons) or ALGEBRA


def _names(node: Node, rates: Mapping[str, str]) -> set[str]:
    """The names in a line, a rate by its own; "a derivative" for any other derivative."""
    found = set()
    for part in walk(node):
        match part:
            case Derivative(Name(name), "t") if name in rates:
                found.add(rates[name])
            case Derivative():
                found.add("a derivative")
            case Name(name):
                found.add(name)
    return found
