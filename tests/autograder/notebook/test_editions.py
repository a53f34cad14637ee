"""A submission is held against the edition that its student got, and not against a later source."""

import copy

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell

from autograder.notebook.editions import begun_with, of_release, of_source
from autograder.notebook.recognise import grade_id
from autograder.notebook.released import TEXT_STUB, released
from autograder.notebook.repair import repair
from tests.autograder.course_problems import problem
from tests.submissions.answers import cell_of

SOURCE = problem("p3-pendulum").source


def handed_out(source):
    """A source as its students get it."""
    notebook = copy.deepcopy(source)
    for cell in notebook.cells:
        cell.source = released(cell)
    return notebook


BLANK = handed_out(SOURCE)
EARLIER = [of_release(nbformat.writes(BLANK))]


def more_points(source):
    cell_of(source, "p3-M").metadata["nbgrader"]["points"] += 1


def other_setup(source):
    cell_of(source, "p3-setup").source += "\nimport math"


def other_question(source):
    """The stub of an answer that a person reads."""
    cell_of(source, "p3-derivation").metadata["nbgrader"]["points"] = 1
    for cell in source.cells:
        if cell.cell_type == "markdown" and not grade_id(cell):
            cell.source += "\n\nCorrected."


def removed(source):
    source.cells.remove(cell_of(source, "p3-C"))


def moved(source):
    cell = cell_of(source, "p3-C")
    source.cells.remove(cell)
    source.cells.insert(2, cell)


def kind(source):
    cell_of(source, "p3-setup").cell_type = "raw"


CHANGES = [more_points, other_setup, other_question, removed, moved, kind]


def changed(change):
    source = copy.deepcopy(SOURCE)
    change(source)
    return source


@pytest.mark.parametrize("change", CHANGES)
def test_no_student_is_told_of_what_the_instructor_changed(change):
    source = changed(change)
    notebook, notes = repair(BLANK, source, earlier=EARLIER)
    assert notes == []
    for cell in source.cells:
        name = grade_id(cell)
        if name and not cell.metadata["nbgrader"].get("solution"):
            assert cell_of(notebook, name).source == cell.source
            assert cell_of(notebook, name).metadata["nbgrader"] == cell.metadata["nbgrader"]
    assert sum(bool(grade_id(cell)) for cell in notebook.cells) == sum(
        bool(grade_id(cell)) for cell in source.cells
    )


@pytest.mark.parametrize("change", [more_points, other_setup, other_question, removed, kind])
def test_without_the_edition_the_student_would_be_told(change):
    """So that the test above can fail."""
    assert repair(BLANK, changed(change))[1]


def test_after_a_corrected_text_an_untouched_proof_is_still_untouched():
    source = changed(other_question)
    notebook, _ = repair(BLANK, source, earlier=EARLIER)
    assert cell_of(notebook, "p3-derivation").source == TEXT_STUB


def test_an_untouched_answer_gets_the_stub_of_now():
    """As nbgrader knows an untouched answer by it."""
    source = copy.deepcopy(SOURCE)
    cell_of(source, "answer-M").source = "# Mind the pivot.\n" + cell_of(source, "answer-M").source
    notebook, notes = repair(BLANK, source, earlier=EARLIER)
    assert notes == []
    assert cell_of(notebook, "answer-M").source.startswith("# Mind the pivot.")


def test_an_answer_stays_whatever_its_stub_was():
    source = copy.deepcopy(SOURCE)
    cell_of(source, "answer-M").source = "# Mind the pivot.\n" + cell_of(source, "answer-M").source
    submission = copy.deepcopy(BLANK)
    cell_of(submission, "answer-M").source = "def M(q, pend):\n    return 1"
    notebook, _ = repair(submission, source, earlier=EARLIER)
    assert cell_of(notebook, "answer-M").source == "def M(q, pend):\n    return 1"


def test_what_the_student_changed_is_said_all_the_same():
    submission = copy.deepcopy(BLANK)
    cell_of(submission, "p3-C").metadata["nbgrader"]["points"] = 100
    cell_of(submission, "p3-g_vec").source += "\n1 / 0"
    submission.cells.remove(cell_of(submission, "p3-lagrangian"))
    _, notes = repair(submission, changed(more_points), earlier=EARLIER)
    assert [note.partition(";")[0] for note in notes] == [
        "the nbgrader settings of p3-C had been changed",
        "the text of p3-g_vec had been changed",
        "p3-lagrangian was missing",
    ]


def test_a_new_cell_is_put_in_as_it_is_handed_out_now():
    source = copy.deepcopy(SOURCE)
    about = {"schema_version": 3, "locked": False, "solution": True, "task": False}
    why = new_markdown_cell("Because.")
    why.metadata["nbgrader"] = {**about, "grade": True, "grade_id": "p3-why", "points": 1}
    check = new_code_cell('check("p3-new")')
    check.metadata["nbgrader"] = {
        **about, "grade": True, "locked": True, "solution": False, "grade_id": "p3-new", "points": 1
    }  # fmt: skip
    source.cells += [why, check]
    notebook, notes = repair(BLANK, source, earlier=EARLIER)
    assert notes == [
        "p3-why is newer than the student's notebook; it was put in",
        "p3-new is newer than the student's notebook; it was put in",
    ]
    assert cell_of(notebook, "p3-why").source == TEXT_STUB


def test_the_edition_is_the_one_with_most_in_common():
    editions = [of_source(changed(change)) for change in CHANGES] + EARLIER
    for change, edition in zip(CHANGES, editions, strict=False):
        if change is not moved:  # which changes no cell
            assert begun_with(handed_out(changed(change)), editions) is edition
    assert begun_with(BLANK, [*editions[:4], EARLIER[0]]) is EARLIER[0]
