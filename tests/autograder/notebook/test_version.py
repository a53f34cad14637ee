"""A notebook's version changes with the questions, and with nothing else."""

import copy

import pytest

from autograder.notebook.version import KEY, other_version, questions_of, stamp, version_of
from tests.autograder.course_problems import NAMES, problem


def changed(source, kind):
    notebook = copy.deepcopy(source)
    graded = [c for c in notebook.cells if (c.metadata.get("nbgrader") or {}).get("grade")]
    match kind:
        case "text":
            notebook.cells[0].source += " A typing error is mended."
        case "points":
            graded[0].metadata.nbgrader["points"] += 1
        case "answer":
            for cell in notebook.cells:
                cell.source = cell.source.replace("return", "return  ")
        case "a question less":
            notebook.cells.remove(graded[-1])
        case "another id":
            graded[0].metadata.nbgrader["grade_id"] = "p1-other"
        case "year":
            for cell in notebook.cells:
                cell.source = cell.source.replace("year=2026", "year=2027")
    return notebook


@pytest.mark.parametrize("kind", ["text", "points", "answer"])
def test_the_same_questions_are_one_version(kind):
    source = problem("p1-inertia").source
    assert version_of(changed(source, kind), {}) == version_of(source, {})


@pytest.mark.parametrize("kind", ["a question less", "another id", "year"])
def test_other_questions_are_another_version(kind):
    source = problem("p1-inertia").source
    assert version_of(changed(source, kind), {}) != version_of(source, {})


def test_each_problem_has_its_own():
    assert len({version_of(problem(name).source, {}) for name in NAMES}) == len(NAMES)


@pytest.mark.parametrize(
    ("kind", "refused"), [("a question less", False), ("another id", False), ("year", True)]
)
def test_what_was_handed_in_before_a_change_is_graded_if_its_other_questions_stand(kind, refused):
    source = problem("p1-inertia").source
    other = changed(source, kind)
    for given, now in ((source, other), (other, source)):
        handed_in = copy.deepcopy(given)
        stamp(handed_in, "p1-inertia", version_of(given, {}), questions_of(given, {}))
        assert bool(other_version(handed_in, now, {})) == refused


def test_one_whose_function_is_called_in_another_way_is_not():
    source = problem("p1-inertia").source
    asked = questions_of(source, {}) | {"p1-M": "0000"}
    handed_in = copy.deepcopy(source)
    stamp(handed_in, "p1-inertia", "0000", asked)
    assert other_version(handed_in, source, {})


@pytest.mark.parametrize(
    "stamped", [None, "x", 3, [], {}, {"version": None}, {"version": 7, "questions": []}]
)
def test_a_notebook_without_a_version_is_graded(stamped):
    """One from the repository, or with damaged metadata."""
    source = problem("p3-pendulum").source
    notebook = copy.deepcopy(source)
    if stamped is not None:
        notebook.metadata[KEY] = stamped
    assert other_version(notebook, source, {}) == ""


def test_a_hostile_version_is_quoted_in_short():
    source = problem("p3-pendulum").source
    notebook = copy.deepcopy(source)
    stamp(notebook, "p1-inertia", "x\n" * 1000, {})
    assert len(other_version(notebook, source, {})) < 300
    assert "\n" not in other_version(notebook, source, {})
