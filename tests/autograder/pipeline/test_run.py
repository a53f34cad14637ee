"""Many submissions: unchanged work is not redone, nobody stops the others."""

import operator
import os
import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.cli import main
from autograder.digest import digest
from autograder.pipeline import run as pipeline
from autograder.pipeline.cache import Cache
from autograder.pipeline.executors import Processes, outcomes
from autograder.sandbox.room import share
from autograder.sandbox.ways import use_shared
from tests.autograder import courses
from tests.autograder.courses import P3, submit
from tests.submissions import p3_pendulum
from tests.submissions.answers import blank, cell_of


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A course with one right submission; the working directory."""
    root = courses.new_course(tmp_path / "course")
    submit(root, "ada", p3_pendulum.right(courses.release(root)))
    monkeypatch.chdir(root)
    return root


def test_only_what_changed_is_judged_again(course, monkeypatch, capsys):
    release = courses.release(course)
    submit(course, "bob", blank(release))
    assert main(["grade", P3, "--jobs", "1"]) == 0
    assert "2 graded, 0 unchanged" in capsys.readouterr().out
    submit(course, "bob", p3_pendulum.partly_right(release))
    with monkeypatch.context() as watched:
        judged = []
        count = pipeline._Run._task
        watched.setattr(pipeline._Run, "_task",
                        lambda *given: judged.append(count(*given)) or judged[-1])  # fmt: skip
        assert main(["grade", P3, "--jobs", "1"]) == 0
    assert [task is None for task in judged] == [True, False]
    said = " ".join(capsys.readouterr().out.split())
    assert "bob 6.5 of 15" in said
    assert "1 graded, 1 unchanged" in said
    assert main(["grade", P3, "--jobs", "1", "--force"]) == 0
    assert "2 graded, 0 unchanged" in capsys.readouterr().out


def test_another_seed_or_student_is_another_result(course, capsys):
    submit(course, "bob", p3_pendulum.right(courses.release(course)))
    assert main(["grade", P3, "--jobs", "1"]) == 0
    results = course / "course" / "cache-of-results" / "results"
    assert len(list(results.rglob("*.json"))) == 2
    (course / "course" / "seed").write_text("another")
    assert main(["grade", P3, "--jobs", "1"]) == 0
    assert "2 graded, 0 unchanged" in capsys.readouterr().out
    assert len(list(results.rglob("*.json"))) == 4


def test_outside_a_ready_course_one_line_says_what_to_do(course, monkeypatch, capsys):
    assert main(["grade", "p9-nothing"]) == 2
    assert "solutions/p9-nothing/p9-nothing.ipynb" in capsys.readouterr().err
    (course / "course" / "gradebook.db").unlink()
    assert main(["grade", P3, "--jobs", "1"]) == 2
    assert f"run `nbgrader generate_assignment {P3}` first" in capsys.readouterr().err
    (course / "course" / "seed").write_text("\n")
    assert main(["grade", P3, "--jobs", "1"]) == 2
    assert "seed is empty: put the course's seed back" in capsys.readouterr().err


def test_no_jobs_at_all_is_refused():
    with pytest.raises(ValueError, match="jobs is 0; it must be at least 1"):
        Processes(0, (), share, use_shared)


def test_a_process_that_dies_takes_nobody_along():
    tasks = [(str(n), (abs, -n)) for n in range(6)]
    tasks.insert(2, ("deadly", (os._exit, 1)))
    tasks.insert(4, ("failing", (operator.truediv, 1, 0)))
    with Processes(2, ("autograder.pipeline.run",), share, use_shared) as pool:
        found = dict(outcomes(operator.call, tasks, pool))
    assert {name: found[name] for name in "012345"} == {str(n): n for n in range(6)}
    assert isinstance(found["failing"], ZeroDivisionError)
    assert "BrokenProcessPool" in type(found["deadly"]).__name__
    assert len(found) == len(tasks)


@given(st.lists(st.binary(max_size=5), max_size=4), st.lists(st.binary(max_size=5), max_size=4))
def test_different_parts_have_different_digests(one, other):
    assert (digest(*one) == digest(*other)) == (one == other)


def test_a_second_run_at_once_is_told_so(course):
    """The lock ends with its process, so that a killed run holds up nobody."""
    hold = "import sys; from pathlib import Path; from autograder.pipeline import lock\n"
    hold += "with lock.locked(Path(sys.argv[1]), ''): print('held', flush=True); sys.stdin.read()"
    command = [sys.executable, "-c", hold, course / pipeline.LOCK]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as holder:
        assert holder.stdout.readline() == b"held\n"
        said = courses.run(course, "autograder", "grade", P3, status=2)
        assert said == f"autograder: another `autograder grade` is running in {course}\n"
        assert not (course / "course" / "autograded").exists()
        holder.kill()
    assert main(["grade", P3, "--jobs", "1"]) == 0


@pytest.mark.parametrize(
    ("setting", "named"),
    [
        ("c.Autograde.autograde_preprocessors = []", "Autograde.autograde_preprocessors"),
        ("c.OverwriteCells.add_missing_cells = True", "OverwriteCells"),
        ("c.Autograde.post_convert_hook = print", "Autograde.post_convert_hook"),
    ],
)
def test_what_only_nbgrader_can_do_is_refused(course, capsys, setting, named):
    with (course / "nbgrader_config.py").open("a") as config:
        config.write(setting + "\n")
    assert main(["grade", P3, "--jobs", "1"]) == 2
    assert f"nbgrader_config.py sets {named}, which only nbgrader" in capsys.readouterr().err


def test_steps_on_the_judged_notebook_run(course):
    """nbgrader's own, with their settings."""
    with (course / "nbgrader_config.py").open("a") as config:
        config.write("c.LimitOutput.max_lines = 3\n")
    notebook = p3_pendulum.right(courses.release(course))
    cell_of(notebook, "answer-M").source += "\nprint('many\\n' * 50)"
    submit(course, "ada", notebook)
    assert main(["grade", P3, "--jobs", "1"]) == 0
    graded = (course / "course" / "autograded" / "ada" / P3 / f"{P3}.ipynb").read_text()
    assert "Output truncated" in graded
    assert graded.count('"many\\n"') == 2


def test_a_damaged_entry_is_none(tmp_path):
    cache = Cache(tmp_path)
    cache.store("a/b", {"x": 1})
    assert cache.load("a/b") == {"x": 1}
    for text in ("{", "[1]", ""):
        (tmp_path / "a" / "b.json").write_text(text)
        assert cache.load("a/b") is None
    assert cache.load("a/c") is None
