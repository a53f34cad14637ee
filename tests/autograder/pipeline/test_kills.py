"""Killed with SIGKILL at random points, a run goes on to what an undisturbed run leaves."""

import os
import random
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.autograder import courses
from tests.autograder.descendants import adopting
from tests.autograder.pipeline import classes
from tests.submissions import start_here
from tests.submissions.start_here import ASSIGNMENT

COMMAND = (Path(sys.executable).parent / "autograder", "grade", ASSIGNMENT, "--jobs", "2")
SECONDS = 250.0  # for one run, on a busy machine
pytestmark = pytest.mark.skipif(os.name == "nt", reason="there is no SIGKILL on Windows")


@dataclass(frozen=True)
class Course:
    """temporary: where a run that is killed leaves what it has no time to remove."""

    root: Path
    students: int
    temporary: Path

    def start(self) -> subprocess.Popen:
        return subprocess.Popen(
            COMMAND,
            cwd=self.root,
            env=os.environ | {"TMPDIR": str(self.temporary)},
            start_new_session=True,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )

    def begun(self) -> int:
        """For how many students the files are there, or are being written."""
        folder = self.root / "course" / "autograded"
        return len(os.listdir(folder)) if folder.exists() else 0

    def rows(self) -> dict[str, list[tuple]]:
        return courses.rows(courses.database(self.root))

    def files(self) -> dict[str, object]:
        return courses.files(self.root / "course" / "autograded")

    def notebooks(self) -> dict[str, Path]:
        folder = self.root / "course" / "autograded"
        return {path.parts[-3]: path for path in folder.glob(f"*/{ASSIGNMENT}/*.ipynb")}

    def judged(self) -> dict[Path, int]:
        """The results that are kept, and when each was written."""
        results = self.root / "course" / "cache-of-results" / "results"
        return {path: path.stat().st_mtime_ns for path in results.rglob("*.json")}


@dataclass(frozen=True)
class Durations:
    """Of a run, s: until the first files, until the last, and until its end."""

    start: float
    work: float
    tail: float

    @classmethod
    def of(cls, course: Course) -> "Durations":
        begin = time.monotonic()
        process = course.start()
        reach(course, process, 1)
        first = time.monotonic()
        reach(course, process, course.students)
        last = time.monotonic()
        assert process.wait(SECONDS) == 0
        return cls(first - begin, last - first, time.monotonic() - last)


def reach(course: Course, process: subprocess.Popen, count: int) -> None:
    deadline = time.monotonic() + SECONDS
    while course.begun() < count and process.poll() is None:
        assert time.monotonic() < deadline
        time.sleep(0.001)


def rest_before(course: Course, seconds: float) -> None:
    """Wait so long, but no longer than until the next files: the machine may be quicker by now."""
    begun, end = course.begun(), time.monotonic() + seconds
    while course.begun() == begun and time.monotonic() < end:
        time.sleep(0.001)


def kill_points(
    rng: random.Random, took: Durations, students: int, kills: int
) -> list[tuple[int, float]]:
    """How many students are to be reached, and how long to wait then, s; one point in the tail.

    Uniform over the time that an undisturbed run takes. Those while it starts, which bring no run any
    further, lie anywhere between those while it works.
    """
    starting, working = [], []
    for k in range(kills - 1):
        at = (k + rng.random()) / (kills - 1) * (took.start + took.work)
        if at < took.start:
            starting.append((0, at))
        else:
            done, part = divmod((at - took.start) / took.work * students, 1)
            working.append((int(done) + 1, part * took.work / students))
    assert starting
    assert working
    for point in starting:
        working.insert(rng.randint(0, len(working)), point)
    return [*working, (students, rng.random() * took.tail)]


def kill(process: subprocess.Popen, with_group: bool) -> None:
    if with_group:
        os.killpg(process.pid, signal.SIGKILL)
    else:
        process.kill()
    process.wait()


def assert_part_of(course: Course, expected: dict[str, list[tuple]], texts: dict) -> None:
    """At any moment what is there is as it will be: no half student, no half file."""
    found = course.rows()
    for table, rows in found.items():
        assert set(map(repr, rows)) <= set(map(repr, expected[table])), table
    notebooks = course.notebooks()
    assert notebooks.keys() <= {dict(row)["id"] for row in found["student"]}
    for student, path in notebooks.items():
        assert path.read_bytes() == texts[student], student
    # What is recorded has been kept before.
    assert len(notebooks) <= len(course.judged())


@pytest.mark.parametrize(
    ("students", "kills"), [(40, 4), pytest.param(200, 20, marks=pytest.mark.long)]
)
def test_killed_runs_go_on_to_the_same_gradebook(tmp_path, tmp_path_factory, students, kills):
    rng = random.Random(4)
    root = classes.new_course(tmp_path / "killed", ASSIGNMENT, start_here.source())
    classes.hand_in(root, ASSIGNMENT, start_here, students)
    temporary = tmp_path_factory.mktemp("t")  # short: there are sockets in it
    course, whole = (Course(top, students, temporary) for top in (root, tmp_path / "whole"))
    shutil.copytree(course.root, whole.root)
    judged, written, killed, rewritten = {}, {}, 0, 0
    with adopting() as processes:
        took = Durations.of(whole)
        processes.wait()
        expected = whole.rows()
        texts = {name: path.read_bytes() for name, path in whole.notebooks().items()}
        for count, rest in kill_points(rng, took, students, kills):
            process = course.start()
            reach(course, process, min(max(count, course.begun() + 1), students) if count else 0)
            rest_before(course, rest)
            kill(process, with_group=rng.random() < 0.5)
            killed += process.returncode == -signal.SIGKILL
            processes.wait()
            assert_part_of(course, expected, texts)
            assert judged.items() <= course.judged().items()
            judged = course.judged()
            now = {name: path.stat().st_mtime_ns for name, path in course.notebooks().items()}
            rewritten += sum(now.get(name) != when for name, when in written.items())
            written = now
        assert course.start().wait(SECONDS) == 0
        processes.wait()
    assert killed > kills / 2
    assert judged.items() <= course.judged().items()
    assert rewritten <= kills  # by one writer, who was interrupted so often
    assert course.rows() == expected
    assert len(expected["submitted_notebook"]) == students
    assert course.files() == whole.files()
    assert not list((course.root / "course").rglob("*.part"))
