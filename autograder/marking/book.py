"""What the page for marking asks of a gradebook."""

from dataclasses import dataclass
from typing import Protocol

from autograder.marking.rubric import Rubric


@dataclass(frozen=True)
class Proof:
    """An answer of an assignment that a person reads, of all students. title: in Markdown."""

    assignment: str
    title: str
    rubric: Rubric

    @property
    def cell(self) -> str:
        return self.rubric.cell


@dataclass(frozen=True)
class Paper:
    """One student's answer to it, as the gradebook has it.

    id: of the submission; it says nothing of the student. suggested: points that marked lines suggest,
    None for none. by_hand: points that a person gave, None for none. to_read: whether a person still has
    to decide. blank: nothing was written. comment: a person's.
    """

    id: str
    student: str
    suggested: float | None
    by_hand: float | None
    to_read: bool
    blank: bool
    comment: str

    @property
    def points(self) -> float | None:
        """Those that count; None until they are decided."""
        if self.to_read:
            return None
        return self.suggested if self.by_hand is None else self.by_hand


@dataclass(frozen=True)
class Written:
    """What a student wrote, as HTML that runs nothing and asks nothing of another host.

    answer: the answer's cells. rest: the notebook's other cells. beside: pictures that no cell shows.
    content: a name for the answer's content. suggested: the rows of the rubric, from 1, that the lines
    of a derivation suggest. fault: why there is nothing to read; "" if there is.
    """

    answer: str = ""
    rest: str = ""
    beside: str = ""
    content: str = ""
    suggested: tuple[int, ...] = ()
    fault: str = ""


class Book(Protocol):
    """A gradebook, and the notebooks that were graded."""

    def proofs(self) -> list[Proof]:
        """In order of the assignments' names, then of the notebook."""

    def papers(self, proof: Proof) -> list[Paper]:
        """In an order that says nothing of the students."""

    def written(self, proof: Proof, student: str, hidden: bool) -> Written:
        """hidden: without the student's id and name, wherever they stand in text."""

    def content(self, proof: Proof, student: str) -> str:
        """Of what is written, `content` alone, which takes no page to make."""

    def shown(self, proof: Proof, markdown: str) -> str:
        """A text of the assignment as HTML."""

    def called(self, student: str) -> str:
        """The full name, or the id where no name is known."""

    def record(self, proof: Proof, student: str, points: float | None, comment: str) -> None:
        """Enter points and a comment; None for points puts the answer back to those to be read."""
