"""The order of a feedback page: what went wrong first, each answer by its title, no cell lost."""

import copy

import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_output

from autograder.judging.verdict import State, Verdict
from autograder.nbgrader_glue.items import (
    FIRST,
    REST,
    RIGHT,
    TEXT,
    UNREAD,
    WRONG,
    arranged,
    title_of,
)
from autograder.notebook.grade import is_judged
from autograder.notebook.letter import letter
from autograder.notebook.recognise import grade_id
from autograder.notebook.scores import outputs_for
from tests.autograder.course_problems import NAMES, problem

P3 = problem("p3-pendulum")


def marked(notebook, wrong=(), unread=()):
    """A copy with grades, as the gradebook gives them, and with cards."""
    notebook = copy.deepcopy(notebook)
    for cell in notebook.cells:
        claims = cell.metadata.get("nbgrader") or {}
        if claims.get("grade"):
            name, points = grade_id(cell), claims["points"]
            claims |= {"score": 0 if name in wrong else points, UNREAD: name in unread}
            if is_judged(cell):
                state, credit = (State.INCORRECT, 0) if name in wrong else (State.CORRECT, 1)
                cell.outputs = outputs_for(Verdict(name, state, credit), points)
    return notebook


def sections(page):
    """Section → its cells."""
    found, title = {}, ""
    for cell in page.cells:
        if "section" in cell.metadata.page:
            title = cell.metadata.page.section.title
        found.setdefault(title, []).append(cell)
    return found


@pytest.mark.parametrize("name", NAMES)
def test_no_cell_is_lost_and_each_answer_has_a_title_of_its_own(name):
    source = problem(name).source
    graded = [
        grade_id(cell)
        for cell in source.cells
        if (cell.metadata.get("nbgrader") or {}).get("grade")
    ]
    page, items = arranged(marked(source, wrong=graded[1:3], unread=graded[-1:]), source)
    assert sorted(cell.source for cell in page.cells) == sorted(
        cell.source for cell in source.cells
    )
    assert sorted(item.id for item in items) == sorted(graded)
    titles = [item.title for item in items]
    assert len(set(titles)) == len(titles)
    assert not [title for title in titles if "point" in title and "(" in title]
    assert [item.kind for item in items] == [
        "wrong",
        "wrong",
        "open",
        *["right"] * (len(graded) - 3),
    ]
    assert items[2].state == "not yet read"
    ends = [cell.metadata.page for cell in page.cells]
    assert len([one for one in ends if "item" in one]) == len(
        [one for one in ends if "ends_item" in one]
    )
    assert len([one for one in ends if "section" in one]) == len(
        [one for one in ends if "ends_section" in one]
    )


def test_titles_of_p3():
    _, items = arranged(marked(P3.source), P3.source)
    assert [item.title for item in items] == [
        "lagrangian: The Lagrangian",
        "M: inertia about the pivot",
        "C: Coriolis matrix of one joint",
        "g_vec: gravity torque",
        "inertia_about_pivot: inertia moved to the pivot",
        "small_angle_frequency: angular frequency of small swings",
        "By hand",
    ]
    assert title_of(P3.source) == "Problem 3: the pendulum, a manipulator with one joint"


def test_what_went_wrong_comes_first_and_the_problems_text_last():
    mine = marked(P3.source, wrong=["p3-g_vec"], unread=["p3-derivation"])
    figure = new_output("display_data", data={"image/png": "AA=="})
    swing = next(cell for cell in mine.cells if grade_id(cell) == "p3-swing-plot")
    swing.outputs = [figure]
    mine.cells.insert(0, letter(["a note"]))
    mine.cells.insert(5, new_markdown_cell("my own thought"))
    mine.cells.append(new_markdown_cell("![my proof](proof.png)"))
    page, _ = arranged(mine, P3.source)
    found = sections(page)
    assert list(found) == [FIRST, WRONG, RIGHT, REST, TEXT]
    assert [grade_id(cell) for cell in found[WRONG][:2]] == ["answer-g_vec", "p3-g_vec"]
    assert found[WRONG][-1].source == "![my proof](proof.png)"
    assert [cell.source for cell in found[FIRST]] == ["- a note"]
    assert swing.source in [cell.source for cell in found[REST]]
    assert "my own thought" in [cell.source for cell in found[REST]]
    first = next(cell for cell in found[REST] if grade_id(cell) == "p3-swing-plot")
    assert first.metadata.page.heading == "From the data sheet to the swing"
    assert first.metadata.page.input == "folded"
    own = {cell.source.strip() for cell in P3.source.cells}
    assert {cell.source.strip() for cell in found[TEXT]} <= own


def test_a_changed_text_is_the_students_and_is_not_folded():
    mine = marked(P3.source)
    mine.cells[1].source += "\n\nmy remark"
    page, _ = arranged(mine, P3.source)
    assert mine.cells[1].source in [cell.source for cell in sections(page)[REST]]


def test_a_check_that_failed_is_open_and_the_bare_number_is_left_out():
    mine = marked(P3.source)
    cell = next(cell for cell in mine.cells if grade_id(cell) == "p3-M")
    cell.metadata.nbgrader["score"] = 0
    cell.outputs = outputs_for(Verdict("p3-M", State.CHECK_FAILED, problem="broken"), 1)
    page, items = arranged(mine, P3.source)
    assert (items[0].id, items[0].kind) == ("p3-M", "open")
    kinds = {one.output_type for cell in page.cells if is_judged(cell) for one in cell.outputs}
    assert kinds == {"display_data", "error"}


def test_comments_stand_with_the_answer():
    mine = marked(P3.source)
    mine.cells.append(new_code_cell("1"))
    proof = next(cell for cell in mine.cells if grade_id(cell) == "p3-derivation")
    proof.metadata.nbgrader["comment"] = "well done"
    lines = next(cell for cell in mine.cells if grade_id(cell) == "answer-p3-L")
    lines.metadata.nbgrader["comment"] = "No response."
    _, items = arranged(mine, P3.source)
    assert [item.comments for item in items if item.id == "p3-derivation"] == [["well done"]]
