"""Marks a derivation line by line, by numbers, and says what is still to be shown."""

import numpy as np

from autograder.proofs.derivation import ALGEBRA, MOST_REASONS, Derivation, Row
from autograder.proofs.expression import Node, Number, names_in
from autograder.proofs.forms import divides_by_motion, half, shows
from autograder.proofs.lines import Line, nearest
from autograder.proofs.marks import Marked, MarkedLine
from autograder.proofs.parsing import LineError, relation_and_sides
from autograder.proofs.steps import Step, TooMuchError, Worlds
from autograder.proofs.subject import Reason
from autograder.proofs.why import Why, named
from autograder.protocol import HandedIn
from autograder.protocol.proofs import MOST_LINES

# Wrong lines for which all other reasons and mistakes are tried: people mend the first ones first.
MOST_DIAGNOSED = 6
DIVIDES = (
    "This line divides by what is zero at rest, where it then says nothing. Which way leads there "
    "without a division?"
)


def mark(derivation: Derivation, given: HandedIn, rng: np.random.Generator) -> Marked:
    """The lines marked, each against the line before it, in random states of random mechanisms."""
    if given.problem:
        return Marked(derivation, problem=given.problem)
    lines = [Line.read(parts, derivation.reason_names) for parts in given.lines]
    return _Marking(derivation, rng).marked(lines)


class _Marking:
    def __init__(self, derivation: Derivation, rng: np.random.Generator):
        self._derivation = derivation
        self._subject = derivation.subject
        self._diagnosed = 0
        self._worlds = Worlds(derivation.subject, rng)
        self._why = Why(derivation, self._worlds)
        self._start = derivation.read(derivation.start)
        self._goal = derivation.read(derivation.goal)

    def marked(self, lines: list[Line]) -> Marked:
        marked: list[MarkedLine] = []
        shown: set[Row] = set()
        before, holding, last, strict = self._start, True, self._start, False
        steps, brought = 0, set[str]()  # names that a fact has brought in
        for at, line in enumerate(lines[:MOST_LINES]):
            step, after, relation = None, before, "="
            try:
                step, (after, relation) = self._step(line, before, at == 0)
                said = self._said(step, line) if step else ""
            except LineError as error:
                said = str(error)
            marked.append(MarkedLine(line.text, line.reasons, not said, said))
            holding = holding and not said
            steps += after != before
            if line.reasons != (ALGEBRA,):
                brought |= self._names(after)
            before = after
            if holding:
                last, strict = after, strict or relation == ">"
                shown.update(self._shown_by(after))
        rows = self._derivation.rows
        still = self._still(last, holding, bool(lines), strict) or self._one_go(steps, brought)
        if len(lines) > MOST_LINES:
            still = f"Only the first {MOST_LINES} lines are read."
        reached = not still
        unshown = [row.form.said for row in rows if row.form and row not in shown]
        if reached and unshown:
            still = f"All lines hold. Still to be shown: {unshown[0]}."
        earned = (row for row in rows if self._is_earned(row, row in shown, reached))
        return Marked(self._derivation, tuple(marked), not still, still, tuple(earned))

    def _step(self, line: Line, before: Node, first: bool):
        """The step that a line claims, None for a first line that only says where it starts; and the
        expression behind it, with its relation.
        """
        relation, left, right = relation_and_sides(line.text)
        read = self._derivation.read
        after = read(right)
        if left:
            head = read(left)
            self._worlds.given(()).value(head)
            if first and not self._worlds.same(head, before):
                raise LineError("The derivation starts elsewhere: look at what is given.")
            if not (self._worlds.same(head, before) or self._worlds.same(head, self._start)):
                raise LineError("The left side is not the line before, nor where you started.")
        elif first and not relation and self._worlds.same(after, before):
            return None, (after, "=")
        relation = relation or "="
        if relation != "=" and self._derivation.relation == "=":
            raise LineError("Every step of this derivation is an equality.")
        self._worlds.given(()).value(after)  # its shapes fit
        return Step(relation, before, after), (after, relation)

    def _said(self, step: Step, line: Line) -> str:
        """What is wrong with a step; "" where it holds by its reasons."""
        given = self._given(line.reasons)
        derivation = self._derivation
        circular = [reason.name for reason in given if reason.name in derivation.to_prove]
        if circular:
            return f'"{circular[0]}" is what is to be proved; here it is assumed.'
        if divides_by_motion(step.after) and not divides_by_motion(step.before):
            return DIVIDES
        if self._worlds.hold(step, given):
            return self._unneeded(step, given) or self._first_half(step, given)
        if said := self._why.misused(step, given):
            return said
        self._diagnosed += 1
        if self._diagnosed <= MOST_DIAGNOSED:
            self._worlds.limited = True
            try:
                return self._why.said(step, given)
            except TooMuchError:
                pass
            finally:
                self._worlds.limited = False
        return f"This does not follow by {named(given)}. Mend the lines above first."

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

    def _unneeded(self, step: Step, given: tuple[Reason, ...]) -> str:
        if given and self._worlds.hold(step, ()):
            are = "are" if len(given) > 1 else "is"
            return (
                f"The line is right, and follows by algebra alone; {named(given)} {are} not used in "
                "it."
            )
        for reason in given:
            rest = tuple(other for other in given if other is not reason)
            if self._worlds.hold(step, rest):
                return (
                    f"The line is right, and follows by {named(rest)}; {named((reason,))} is not "
                    "used in it."
                )
        return ""

    def _first_half(self, step: Step, given: tuple[Reason, ...]) -> str:
        """What is said of X + X' = Y + Y' where Y + Y' is zero whatever stands for Y, and X is not Y."""
        before, after = half(step.before), half(step.after)
        if before is None or after is None or not self._worlds.same(step.after, Number(0.0)):
            return ""
        if self._worlds.hold(Step("=", before, after), given):
            return ""
        return (
            "Both sums are zero, but what stands in the first bracket is not what stood there before. "
            "Look at each sign and factor in it."
        )

    def _shown_by(self, node: Node) -> list[Row]:
        """The rows whose milestone this line is, or whose form it shows where they have none."""
        return [row for row in self._derivation.rows if self._shows(node, row)]

    def _shows(self, node: Node, row: Row) -> bool:
        if row.milestone and not self._worlds.same(node, self._derivation.read(row.milestone)):
            return False
        if row.form is None:
            return bool(row.milestone)
        return shows(node, row.form, self._derivation, self._worlds)

    def _is_earned(self, row: Row, shown: bool, reached: bool) -> bool:
        if row.milestone and shown:
            return True
        return reached and (shown or row.form is None)

    def _one_go(self, steps: int, brought: set[str]) -> str:
        """What is said of lines that hold and show nothing; a line that repeats the one before is no
        step, and what a fact says stands in names that are neither given nor asked for.
        """
        least = self._derivation.least_lines
        if steps < least:
            return f"The end is reached in one go: show why, in {least} lines or more."
        if not brought - self._names(self._start) - self._names(self._goal):
            return "The end is reached in one go: show why. Put in what a reason says, as a line."
        return ""

    def _names(self, node: Node) -> set[str]:
        return set(names_in(node, self._subject.rates))

    def _still(self, last: Node, holding: bool, any_lines: bool, strict: bool) -> str:
        """What keeps the lines from their end; "" where they reach it."""
        said = self._derivation.goal_said
        if not any_lines:
            return f"To be shown: {said}."
        if not holding:
            return f"Mend the lines marked ✗. To be shown: {said}."
        left = sorted(self._names(last) - self._names(self._goal))
        if not left and self._worlds.same(last, self._goal):
            if strict or self._derivation.relation == "=":
                return ""
            return f"Still to be shown: {said}. So far you have ≥."
        more = f" Your last line still holds {', '.join(left)}." if left else ""
        return f"All lines hold. Still to be shown: {said}.{more}"
