"""What a command costs with all its processes, what a class of any size costs, and what came of it."""

import os
import resource
import sqlite3
import subprocess
import sys
import time
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from tests.autograder.descendants import adopting

FULL_MARKS = """
    SELECT submitted_assignment.student_id, base_cell.name FROM grade
    JOIN submitted_notebook ON submitted_notebook.id = grade.notebook_id
    JOIN submitted_assignment ON submitted_assignment.id = submitted_notebook.assignment_id
    JOIN base_cell ON base_cell.id = grade.cell_id
    JOIN grade_cells ON grade_cells.id = grade.cell_id
    WHERE grade.auto_score = grade_cells.max_score
"""


@dataclass(frozen=True)
class Spent:
    """One run of a command, s: wall: until it ended; cpu: of it and of every process it started.

    Sandboxed processes end unseen, and are not in `cpu`: it holds for runs that start none.
    """

    wall: float
    cpu: float

    def least(self, other: "Spent") -> "Spent":
        return Spent(min(self.wall, other.wall), min(self.cpu, other.cpu))


def run(root: Path, program: str, *arguments: str) -> Spent:
    """Run one of the environment's commands in the folder `root`. RuntimeError where it fails."""
    command = [Path(sys.executable).parent / program, *arguments]
    with adopting() as processes:
        before, start = _children(), time.perf_counter()
        done = subprocess.run(command, cwd=root, capture_output=True, text=True, env=os.environ)
        wall = time.perf_counter() - start
        processes.wait()
        cpu = _children() - before
    if done.returncode:
        raise RuntimeError(f"{program} ended with {done.returncode}: {done.stderr[-2000:]}")
    return Spent(wall, cpu)


def _children() -> float:
    """The processor time of all processes below this one that have ended, s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class BusyMachineError(Exception):
    """More submissions took less time: nothing can be said of either."""


@dataclass(frozen=True)
class Line:
    """What classes of several sizes cost: start-up, and so much for each submission.

    each: the slope of the wall-clock time from the smallest size to the largest, s; BusyMachineError
    where it is not positive.
    """

    runs: dict[int, Spent]

    @property
    def each(self) -> float:
        slope = self._slope(min(self.runs), max(self.runs))
        if slope <= 0:
            walls = {size: round(spent.wall, 1) for size, spent in self.runs.items()}
            raise BusyMachineError(f"wall-clock times, s, by size: {walls}")
        return slope

    @property
    def start(self) -> float:
        large = max(self.runs)
        return self.runs[large].wall - large * self.each

    def at(self, size: int) -> float:
        """The wall-clock time of a class of that size: as measured, or by the slope."""
        if size in self.runs:
            return self.runs[size].wall
        return self.start + size * self.each

    def steps(self) -> list[float]:
        """The slopes from each size to the next: all the same where the cost is linear."""
        return [self._slope(small, large) for small, large in pairwise(sorted(self.runs))]

    def _slope(self, small: int, large: int) -> float:
        return (self.runs[large].wall - self.runs[small].wall) / (large - small)


def full_marks(root: Path) -> set[tuple[str, str]]:
    """The (student, cell) to which grading gave all points."""
    with sqlite3.connect(root / "course" / "gradebook.db") as connection:
        return set(connection.execute(FULL_MARKS))
