"""The rubric is the table of points in the problem's text; what is wrong with it is said."""

import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from autograder.marking.rubric import rubrics
from tests.autograder.course_problems import NAMES, problem

TABLE = "## D. By hand (3 points)\n\nShow it.\n\n| points | for |\n|---|---|\n"


def read_by_a_person(name="p-proof", points=3, **claims):
    settings = {"grade": True, "solution": True, "locked": False, "grade_id": name}
    settings |= {"points": points, "task": False, **claims}
    text = "### BEGIN SOLUTION\nIt is so.\n### END SOLUTION"
    return new_markdown_cell(text, metadata={"nbgrader": settings})


def judged(name):
    settings = {"grade": True, "solution": False, "locked": True, "grade_id": name, "points": 1}
    return new_code_cell("", metadata={"nbgrader": settings})


def rubric(text, points=3):
    (found,) = rubrics(
        new_notebook(cells=[new_markdown_cell(text), read_by_a_person(points=points)])
    )
    return found


@pytest.mark.parametrize("name", NAMES)
def test_each_problems_table_adds_up(name):
    found = rubrics(problem(name).source)
    assert found
    for one in found:
        assert one.fault == ""
        assert len(one.rows) > 2
        assert sum(row.points for row in one.rows) == one.points
        assert "SOLUTION" not in one.model
        assert len(one.model) > 200


def test_rows_are_read_as_they_stand():
    found = rubric(f"{TABLE}| 1 | $K$ and **why** |\n| 1,5 | a \\| b |\n| 0.5 | \n\nMore text.")
    assert [(row.points, row.text) for row in found.rows][:2] == [
        (1.0, "$K$ and **why**"),
        (1.5, "a | b"),
    ]
    assert found.model == "It is so."
    assert found.task.startswith("## D. By hand")


@pytest.mark.parametrize(
    ("rows", "fault"),
    [
        ("| 1 | a |\n| 2 | b |", ""),
        ("| 1 | a |\n| 1 | b |", "The rows of the table give 2 points in all, and the answer 3."),
        ("| 1 | a |\n| up to 2 | b |",
         "A row of the table has no number of points, but 'up to 2': b"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_a_table_is_said(rows, fault):
    assert rubric(TABLE + rows).fault == fault


def test_without_a_table_there_are_no_rows_and_no_fault():
    found = rubric("## E. In words\n\nWhat do you see?")
    assert (found.rows, found.fault, found.points) == ((), "", 3.0)


def test_a_table_of_another_answer_is_not_taken():
    cells = [
        new_markdown_cell(f"{TABLE}| 3 | the first |"),
        read_by_a_person("p-one"),
        new_markdown_cell("## E. Next\n\nSay more."),
        judged("p-M"),
        new_markdown_cell(f"{TABLE}| 3 | the last |"),
        read_by_a_person("p-two"),
    ]
    first, last = rubrics(new_notebook(cells=cells))
    assert [row.text for row in first.rows] == ["the first"]
    assert [row.text for row in last.rows] == ["the last"]


def test_a_task_has_its_table_in_itself():
    task = read_by_a_person("p-task", grade=False, solution=False, task=True)
    task.source = f"{TABLE}| 3 | all of it |"
    (found,) = rubrics(new_notebook(cells=[task]))
    assert [row.text for row in found.rows] == ["all of it"]
