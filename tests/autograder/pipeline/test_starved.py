"""What a clock ended, and not the processor's time, is judged again alone, and is never certain."""

import pytest

from autograder.cli import main
from autograder.notebook.grade import UNCERTAIN
from autograder.pipeline import run as pipeline
from tests.autograder import courses
from tests.autograder.courses import P3, submit
from tests.submissions import p3_pendulum

# A right answer that waits once, as it would for a processor of a busy machine.
SLOW = """
import time
waits = [2.5]
def M(q, pend):
    if waits:
        time.sleep(waits.pop())
    return [[pend.I]]
"""


@pytest.fixture
def course(tmp_path, monkeypatch):
    root = courses.new_course(tmp_path / "course")
    release = courses.release(root)
    submit(root, "ada", p3_pendulum.right_but(release, M=SLOW))
    submit(root, "bob", p3_pendulum.right(release))
    # A course in which something was graded before starts no processes before it needs them.
    (root / pipeline.CACHE / "recorded" / P3).mkdir(parents=True)
    monkeypatch.chdir(root)
    return root


@pytest.fixture
def judged(monkeypatch):
    """Who is judged, in order, and whether while others are: all in this process, where limits are as
    the test sets them. `judged.busy(name, alone)`: whether that judging may wait for only a moment.
    """

    class Judged(list):
        def busy(self, name, alone):
            return False

    log = Judged()

    def here(work, tasks, pool):
        alone = isinstance(tasks, list)
        for name, given in tasks:
            log.append((name, alone))
            with monkeypatch.context() as limits:
                if log.busy(name, alone):
                    # Far less than the answer waits, and enough for those that compute.
                    limits.setattr("autograder.sandbox.room.CALL_SECONDS", 0.05)
                    limits.setattr("autograder.sandbox.room.GRACE_SECONDS", 0.6)
                outcome = work(*given)
            yield name, outcome

    monkeypatch.setattr(pipeline, "outcomes", here)
    return log


def grade(capsys) -> str:
    assert main(["grade", P3, "--jobs", "1"]) == 0
    return " ".join(capsys.readouterr().out.split())


def kept(root) -> int:
    """The number of results that later runs take as they are."""
    return len(list((root / pipeline.CACHE / "results").rglob("*.json")))


def test_what_others_held_up_is_judged_again_alone_and_is_certain_then(course, judged, capsys):
    judged.busy = lambda name, alone: name == "ada" and not alone
    said = grade(capsys)
    assert judged == [("ada", False), ("bob", False), ("ada", True)]
    assert "ada 10 of 15 6 correct" in said
    assert UNCERTAIN not in said
    assert kept(course) == 2
    assert "0 graded, 2 unchanged" in grade(capsys)
    assert len(judged) == 3


def test_what_a_clock_ended_again_is_noted_and_judged_by_the_next_run(course, judged, capsys):
    judged.busy = lambda name, alone: name == "ada"
    for others in ([("bob", False)], []):
        judged.clear()
        said = grade(capsys)
        assert judged == [("ada", False), *others, ("ada", True)]
        assert "ada 9 of 15 5 correct, 1 error in your code" in said
        assert said.count(f"{UNCERTAIN} M") == said.count(pipeline.AGAIN) == 1
        assert kept(course) == 1
    judged.busy = lambda name, alone: False
    judged.clear()
    said = grade(capsys)
    assert judged == [("ada", False)]
    assert "ada 10 of 15 6 correct" in said
    assert UNCERTAIN not in said
    assert kept(course) == 2


def test_what_the_processors_time_ended_is_certain(course, judged, capsys, monkeypatch):
    monkeypatch.setattr("autograder.sandbox.room.CALL_SECONDS", 0.2)
    monkeypatch.setattr("autograder.sandbox.room.GRACE_SECONDS", 0.6)
    endless = "def M(q, pend):\n    while True: pass"
    submit(course, "ada", p3_pendulum.right_but(courses.release(course), M=endless))
    said = grade(capsys)
    assert judged == [("ada", False), ("bob", False)]
    assert "ada 9 of 15" in said
    assert UNCERTAIN not in said
    assert kept(course) == 2
