"""What a worker says of a file that is no notebook."""

import copy

import nbformat
import pytest

from autograder.notebook.version import questions_of, stamp, version_of
from autograder.pipeline.worker import judge
from tests.autograder.course_problems import problem


@pytest.mark.parametrize("content", [b"[]", b"null", b"3", b'"text"', b"{}"])
def test_json_of_something_else_is_no_notebook(content):
    refused = judge(content, "", "seed")["refused"]
    assert refused == "is not a notebook: ask the student for it again"


@pytest.mark.parametrize("content", [b"", b"{", "{}".encode("utf-16")])
def test_what_is_no_json_is_said_to_be_none(content):
    assert judge(content, "", "seed")["refused"].startswith("is not valid JSON")


def test_a_notebook_of_another_version_is_refused_in_a_sentence():
    """One that was handed out with other questions, as last year's arms."""
    source = problem("p1-inertia").source
    earlier, now = copy.deepcopy(source), version_of(source, {})
    setup = next(cell for cell in earlier.cells if "own_arm(" in cell.source)
    setup.source = setup.source.replace("year=2026", "year=2025")
    given = version_of(earlier, {})
    assert given != now
    stamp(earlier, "p1-inertia", given, questions_of(earlier, {}))
    refused = judge(nbformat.writes(earlier).encode(), nbformat.writes(source), "seed")["refused"]
    assert f"another version of this problem ({given}; the course has {now})" in refused
    assert "ask the student" in refused
