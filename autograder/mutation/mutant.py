"""A mutant: what was done wrong, and where."""

import re
from dataclasses import dataclass, replace

from autograder.judging.claims import Claim
from autograder.mutation.steps import STEPS


@dataclass(frozen=True)
class Mutant:
    """A mistake: what was done to which term, in which entry ("" for all) or on which step.

    in_energy: whether it was done to the energy, from which the answer was then derived. source: the
    answer in which it was made, where another one follows from that; "" for the one that is asked for.
    detail: what tells it from others that are like it in all of this, as the width of a tanh.
    """

    operator: str
    term: str = ""
    entry: str = ""
    put: str = ""
    instead_of: str = ""
    in_energy: bool = False
    source: str = ""
    detail: str = ""

    @property
    def name(self) -> str:
        """By which a teacher's own sentence finds it; no two of an answer have the same."""
        return " / ".join(
            filter(
                None,
                (
                    *(self.operator, self.term, self.entry, self.put, self.instead_of),
                    "in the energy" if self.in_energy else "",
                    f"in {self.source}" if self.source else "",
                    self.detail,
                ),
            )
        )

    @property
    def is_step(self) -> bool:
        """Whether it was done to the answer, not to a term of it."""
        return not self.source and self.operator in STEP_NAMES

    def claim(self, answer: str) -> Claim:
        """Of which numbers of the answer its sentence speaks.

        C q̇ alone shows a term, or a product of two velocities in a row; of anything else in C it shows
        nothing, and the properties must bear it out.
        """
        if not self.source and self.operator in OF_THE_WHOLE:
            return Claim.WHOLE
        of_a_product = not self.is_step and not re.fullmatch(r"C\d+", self.entry)
        return Claim.JUDGED if answer == "C" and not of_a_product else Claim.CHANGED

    @property
    def is_seldom(self) -> bool:
        """Whether it was done in one entry alone where whoever does it mostly does it in all."""
        return bool(self.entry) and self.operator in SELDOM_OF_AN_ENTRY

    def within(self, source: str) -> "Mutant":
        """The same mistake, seen in an answer that follows from `source`."""
        return replace(self, source=source)


# What is done to the whole: what is half, or zero, in one entry alone has another reason there.
OF_THE_WHOLE = (
    "half of the whole",
    "twice the whole",
    "sign of the whole",
    "zero",
    "inverse",
    "joints exchanged",
    "columns in another order",
    "halves of ẋ swapped",
    "state for its rate",
)
# What is mostly done in all entries alike.
SELDOM_OF_AN_ENTRY = (
    "wrong angle",
    "sine for cosine",
    "cosine for sine",
    "wave lost",
    "double angle",
    "triple angle",
    "wrong parameter",
)
STEP_NAMES = {name for steps in STEPS.values() for name in steps}
