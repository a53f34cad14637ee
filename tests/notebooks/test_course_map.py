"""The page that maps the course is the one its notebooks make, and nothing is missing on it."""

import re

import pytest

from tests.notebooks.course_map import (
    ROOT,
    Section,
    files_testing,
    lessons,
    names_used,
    page,
    problems,
    sections,
)
from tests.notebooks.reading_time import stated

PAGE = ROOT / "docs" / "course-map.md"


def test_the_page_is_made_from_the_notebooks():
    assert PAGE.read_text(encoding="utf-8") == page(PAGE), (
        "docs/course-map.md is of before your change (it counts the mistakes, too): run "
        "`.venv/bin/python -m tests.notebooks.course_map docs/course-map.md`"
    )


def test_links_lead_somewhere():
    links = re.findall(r"\]\(([^)]+)\)", PAGE.read_text(encoding="utf-8"))
    assert len(links) > 50
    for link in links:
        assert (PAGE.parent / link).exists(), link


@pytest.mark.parametrize("problem", problems(), ids=lambda path: path.stem)
def test_a_lesson_prepares_each_problem(problem):
    by_lesson = [path for path in lessons()[1:] if f"problems/{problem.stem}/" in path.read_text()]
    assert by_lesson, f"no lesson but 00 links to ../problems/{problem.stem}/"


@pytest.mark.parametrize("lesson", lessons(), ids=lambda path: path.stem)
def test_what_a_lesson_computes_with_is_tested(lesson):
    for part, used in names_used(sections(lesson)):
        for name in used:
            assert files_testing(name), f"{part.title}: {name}"


def test_names_are_read_from_code():
    class Cell:
        cell_type = "code"
        source = """
from armdyn import Planar2R, plotting
from armdyn import properties as p
arm = Planar2R(1, 1, 1, 1, 1, 1, 1, 1)
plotting.figure()
p.symmetry(arm, [0, 0]).holds
arm.l1, arm.M([0, 0])
def turned(q): return arm.C(q, q)
"""

    (_, used), *_ = names_used([Section("a", (Cell,))])
    assert used == ["Planar2R.C", "Planar2R.M", "properties.symmetry"]


def test_lesson_00_tells_the_minutes_that_each_lesson_tells():
    start, *others = lessons()
    (table,) = (part.text for part in sections(start) if "The map of the course" in part.title)
    for lesson in others:
        rows = re.findall(rf"^.*\({lesson.name}\).*$", table, re.MULTILINE)
        assert len(rows) == 1, f"the table of lesson 00 needs one row that links to {lesson.name}"
        (row,), minutes = rows, stated(lesson)
        assert re.search(rf"\b{minutes}\b", row.rpartition(lesson.name)[2]), row
