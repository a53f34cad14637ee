"""What the pipeline asks of whatever knows the submissions and keeps their grades."""

from collections.abc import Mapping
from pathlib import Path
from typing import Protocol

from autograder.notebook.beside import Beside


class Standing(Protocol):
    """What is recorded of one student: points, how many cells a person has still to read, and all of it
    as text.
    """

    @property
    def score(self) -> float: ...
    @property
    def to_read(self) -> int: ...
    @property
    def rows(self) -> str: ...


class Recorder(Protocol):
    """One assignment's submissions, and where they are recorded."""

    assignment: str
    source: str  # the source notebook, as JSON
    settings: str  # what decides a grade beside submission, source and seed
    max_score: float

    def submissions(self) -> dict[str, Path]:
        """Student → where that student's notebook is, or should be; in order of the names."""

    def standings(self) -> Mapping[str, Standing]:
        """What is recorded, by student."""

    def autograded(self, student: str) -> Path:
        """Where the judged notebook is, or will be."""

    def refusal(self, student: str) -> str:
        """Why nothing of a submission is to be read; empty where it may be."""

    def counted(self, student: str) -> tuple[Path, list[str]]:
        """The notebook that is graded, and what to know of the others; FileNotFoundError for none."""

    def laid_in(self, student: str) -> Beside:
        """The files that the notebook's cells find beside it."""

    def seed_of(self, student: str) -> str:
        """What decides the student's random cases."""

    def files_of(self, student: str) -> str:
        """What lies beside a submission and its source, as text that changes when a file does."""

    def record(self, student: str, judged: dict) -> Standing:
        """Record a judged notebook; where that fails, what was recorded before stays."""

    def refuse(self, student: str) -> None:
        """Record that a submission cannot be graded."""

    def forget(self) -> None:
        """After an error: drop what was not committed."""
