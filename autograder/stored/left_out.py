"""A check that needs the equations themselves: a student's package leaves it to the grader."""

from dataclasses import dataclass

from autograder.judging.check import Ask, Check
from autograder.judging.verdict import State, Verdict


@dataclass(frozen=True)
class LeftOut(Check):
    """why: what it would need, as a sentence for the student."""

    why: str = ""

    def run(self, ask: Ask, rng, count: int = 0, carrying=None) -> Verdict:
        """That it is judged when it is handed in."""
        return Verdict(self.id, State.NOT_HERE, problem=self.why)
