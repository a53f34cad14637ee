"""What the pipeline needs from the code that knows the submissions and records their grades."""

from collections.abc import Mapping
from pathlib import Path
from typing import Protocol

from autograder.notebook.beside import Beside


class Standing(Protocol):
    """What is recorded about one student: points, the number of cells that a person still has to read,
    the rows as text, and in words how late the submission is.
    """

    @property
    def score(self) -> float: ...
    @property
    def to_read(self) -> int: ...
    @property
    def rows(self) -> str: ...
    @property
    def late(self) -> str: ...


class Recorder(Protocol):
    """One assignment's submissions, and where they are recorded."""

    assignment: str
    source: str  # the source notebook, as JSON
    settings: str  # what else decides a graded notebook, besides these, the submission and the seed
    earlier: tuple[str, ...]  # the editions that students may have, as JSON, the newest first
    carried_on: float  # the share of the points for an error that is carried on
    max_score: float

    def submissions(self) -> dict[str, Path]:
        """Student → where that student's notebook is, or should be; in order of the names."""

    def standings(self) -> Mapping[str, Standing]:
        """What is recorded about each student."""

    def autograded(self, student: str) -> Path:
        """Where the judged notebook is, or will be."""

    def refusal(self, student: str) -> str:
        """Why the grader must not read a submission; empty if it may."""

    def counted(self, student: str) -> tuple[Path, list[str]]:
        """The notebook that is graded, and notes on the others; FileNotFoundError if there is none."""

    def laid_in(self, student: str) -> Beside:
        """The files that the notebook's cells find beside it."""

    def laid_in_source(self) -> Beside:
        """The files that the source's own cells find beside it."""

    def seed_of(self, student: str) -> str:
        """What decides the student's random cases."""

    def files_of(self, student: str) -> str:
        """What lies beside a submission and its source, as text that changes when a file does."""

    def record(self, student: str, judged: dict) -> Standing:
        """Record a judged notebook; if that fails, what was recorded before stays."""

    def refuse(self, student: str) -> None:
        """Record that a submission cannot be graded."""

    def forget(self) -> None:
        """Drop what was not committed, after an error."""
