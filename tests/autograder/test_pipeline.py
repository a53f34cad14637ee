"""Many submissions: unchanged work is not redone, nobody stops the others."""

import json
import operator
import os

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder import pipeline
from autograder.cache import Cache, digest, from_json, to_json
from autograder.cli import main
from autograder.executors import Processes, outcomes
from autograder.grade import Graded
from autograder.verdict import Row, State, Verdict, Witness
from tests.autograder import courses
from tests.autograder.courses import P3, submit
from tests.submissions import p3_pendulum


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A course with one right submission; the working directory."""
    root = courses.new_course(tmp_path / "course")
    submit(root, "ada", p3_pendulum.right(courses.release(root)))
    monkeypatch.chdir(root)
    return root


def test_only_what_changed_is_judged_again(course, monkeypatch, capsys):
    release = courses.release(course)
    submit(course, "bob", p3_pendulum.blank(release))
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
    assert main(["grade", P3, "--jobs", "0"]) == 2
    assert "jobs is 0" in capsys.readouterr().err


def test_a_process_that_dies_takes_nobody_along():
    tasks = [(str(n), (abs, -n)) for n in range(6)]
    tasks.insert(2, ("deadly", (os._exit, 1)))
    tasks.insert(4, ("failing", (operator.truediv, 1, 0)))
    with Processes(2, "autograder.pipeline") as pool:
        found = dict(outcomes(operator.call, tasks, pool))
    assert {name: found[name] for name in "012345"} == {str(n): n for n in range(6)}
    assert isinstance(found["failing"], ZeroDivisionError)
    assert "BrokenProcessPool" in type(found["deadly"]).__name__
    assert len(found) == len(tasks)


@given(st.lists(st.binary(max_size=5), max_size=4), st.lists(st.binary(max_size=5), max_size=4))
def test_different_parts_have_different_digests(one, other):
    assert (digest(*one) == digest(*other)) == (one == other)


verdicts = st.builds(
    Verdict,
    check=st.text(),
    state=st.sampled_from(State),
    credit=st.floats(0, 1),
    rows=st.lists(st.builds(Row, st.text(), st.floats(0, 1), st.booleans())).map(tuple),
    witness=st.none() | st.builds(Witness, st.text(), st.text(), st.text()),
    problem=st.text(),
    diagnosis=st.lists(st.text()).map(tuple),
    next_step=st.text(),
)


@given(verdicts)
def test_results_come_back_from_the_cache_as_they_went(verdict):
    graded = Graded({"cells": []}, {"p3-M": verdict}, ("a note",))
    assert from_json(json.loads(json.dumps(to_json(graded)))) == graded


def test_a_damaged_entry_is_none(tmp_path):
    cache = Cache(tmp_path)
    cache.store("a/b", {"x": 1})
    assert cache.load("a/b") == {"x": 1}
    for text in ("{", "[1]", ""):
        (tmp_path / "a" / "b.json").write_text(text)
        assert cache.load("a/b") is None
    assert cache.load("a/c") is None
