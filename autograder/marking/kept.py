"""What the gradebook has no place for, kept in course/marking/: the rows of the rubric that an answer
met, and a second marker's points.

A file an assignment: {cell: {student: {"first": …, "second": …, "counts": …}}}. Each of the three is a
`Given`; "counts" is the choice between the two, where one was made.
"""

import json
import stat
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path

from autograder.files import put_in_place
from autograder.pipeline.lock import locked

FOLDER = Path("course") / "marking"
LOCK = ".lock"
FIRST, SECOND, COUNTS = "first", "second", "counts"
PATIENCE = 20.0  # s, while another program writes


@dataclass(frozen=True)
class Met:
    """A row of the rubric as it was when somebody marked by it. given: of its points."""

    text: str
    points: float
    given: float


@dataclass(frozen=True)
class Given:
    """What one person gave an answer. points: in all, which may differ from the sum of the rows. answer:
    a name for the answer's content then. when: in UTC.
    """

    rows: tuple[Met, ...]
    points: float
    comment: str
    answer: str
    when: str


Entry = dict[str, Given]


def counting(entry: Entry, points: float | None) -> Given | None:
    """What stands behind the points that the gradebook has; None if they were given elsewhere."""
    for by in (COUNTS, FIRST):
        if by in entry and points is not None and abs(entry[by].points - points) < 1e-9:
            return entry[by]
    return None


class KeptError(ValueError):
    """A file cannot be read; the message names it."""


class Kept:
    """The files of one course, whose folder is `root`."""

    def __init__(self, root: Path):
        self._root = root

    def path(self, assignment: str) -> Path:
        return self._root / FOLDER / f"{assignment}.json"

    def cells(self, assignment: str) -> list[str]:
        """The answers of which something is kept."""
        return list(self._read(assignment))

    def of(self, assignment: str, cell: str) -> dict[str, Entry]:
        """By student. KeptError if the file is damaged."""
        found = self._read(assignment).get(cell, {})
        try:
            return {student: {by: _given(said) for by, said in entry.items()}
                    for student, entry in found.items()}  # fmt: skip
        except (AttributeError, KeyError, TypeError, ValueError):
            raise KeptError(_damaged(self.path(assignment))) from None

    def change(
        self, assignment: str, cell: str, student: str, change: Callable[[Entry], Entry]
    ) -> None:
        """Replace what is kept of one answer; nobody else writes meanwhile. OSError if that fails."""
        with _alone(self.folder() / LOCK):
            entry = change(self.of(assignment, cell).get(student, {}))
            whole = self._read(assignment)
            of_cell = whole.setdefault(cell, {})
            of_cell[student] = {by: asdict(given) for by, given in entry.items()}
            if not entry:
                del of_cell[student]
            self._write(assignment, whole)

    def naming(self, student: str) -> list[Path]:
        """The files that name a student."""
        found = []
        for path in sorted((self._root / FOLDER).glob("*.json")):
            if any(student in of_cell for of_cell in self._read(path.stem).values()):
                found.append(path)
        return found

    def forget(self, path: Path, student: str) -> None:
        """Remove a student from a file."""
        with _alone(self._root / FOLDER / LOCK):
            whole = self._read(path.stem)
            for of_cell in whole.values():
                of_cell.pop(student, None)
            self._write(path.stem, whole)

    def _read(self, assignment: str) -> dict[str, dict]:
        path = self.path(assignment)
        if not path.exists():
            return {}
        try:
            found = json.loads(path.read_text(encoding="utf-8"))
        except ValueError:
            found = None
        if not isinstance(found, dict) or not all(isinstance(of, dict) for of in found.values()):
            raise KeptError(_damaged(path))
        return found

    def _write(self, assignment: str, whole: dict) -> None:
        path = self.path(assignment)
        put_in_place(path, json.dumps(whole, ensure_ascii=False, indent=1) + "\n", 0o600)
        _share(path, path.parent)

    def folder(self) -> Path:
        """The folder, which is made if it is not there."""
        folder = self._root / FOLDER
        if not folder.exists():
            folder.mkdir(mode=0o700, exist_ok=True)
            _share(folder, folder.parent)
        if not (lock := folder / LOCK).exists():
            lock.touch(mode=0o600)
            _share(lock, folder)
        return folder


def _share(path: Path, course: Path) -> None:
    """Open a path to the group that writes into the course's folder, if one does, and to nobody else."""
    own = 0o700 if path.is_dir() else 0o600
    shared = course.stat().st_mode & stat.S_IWGRP
    path.chmod(own | own >> 3 if shared else own)


@contextmanager
def _alone(lock: Path) -> Iterator[None]:
    """Hold the lock of the folder, after waiting for whoever holds it."""
    until = time.monotonic() + PATIENCE
    with ExitStack() as held:
        while True:
            try:
                held.enter_context(locked(lock, f"another program is writing into {lock.parent}"))
                break
            except BlockingIOError:
                if time.monotonic() > until:
                    raise
                time.sleep(0.05)
        yield


def _given(said: dict) -> Given:
    rows = tuple(Met(str(row["text"]), float(row["points"]), float(row["given"]))
                 for row in said["rows"])  # fmt: skip
    return Given(
        rows, float(said["points"]), str(said["comment"]), str(said["answer"]), str(said["when"])
    )


def _damaged(path: Path) -> str:
    return (
        f"{path} is damaged: put a copy of it back, or move it away. The points are in the gradebook; "
        "without this file pages do not say which rows an answer met"
    )
