"""What a card in a notebook ends with: the hint to call, the section to read, the points checked."""

import json
import re
import shutil
from pathlib import Path

import pytest

from autograder.judging.card import Line
from autograder.judging.verdict import State, Verdict
from autograder.problems import CHECKS
from autograder.student import below, failing, progress
from autograder.student.cell import NotCorrectError, check

ROOT = Path(__file__).parents[3]
SOURCES = sorted((ROOT / "solutions").glob("*/*.ipynb"))


@pytest.fixture(autouse=True)
def kernel(monkeypatch, tmp_path):
    """A kernel that has just started in a student's folder of p3."""
    monkeypatch.setattr(progress, "_credit", {})
    monkeypatch.setattr(progress, "_graded", {})
    monkeypatch.setattr(failing, "_failing", {})
    folder = tmp_path / "problems" / "p3-pendulum"
    folder.mkdir(parents=True)
    (tmp_path / "lessons").mkdir()
    monkeypatch.chdir(folder)
    return folder


@pytest.fixture
def notebook(kernel):
    """The problem's notebook, which is in that folder."""
    return Path(shutil.copy(ROOT / "solutions" / kernel.name / f"{kernel.name}.ipynb", kernel))


def checked(id, body) -> None:
    namespace = {"__name__": "__main__", "check": check}
    exec(f"from math import *\ndef {CHECKS[id].signature}:\n    {body}", namespace)
    exec(f"check({id!r})", namespace)


def test_points_add_up_as_checks_are_run(notebook, capsys):
    checked("p3-M", "return pend.I")
    assert capsys.readouterr().out.splitlines()[-1] == (
        "  1 of 15 points checked; a person gives 5 more."
    )
    assert progress.of("p3-M").rest == [
        "left to check: p3-lagrangian (3), p3-C (1), p3-g_vec (2), p3-inertia_about_pivot (1), "
        "p3-small_angle_frequency (2)",
        "read by a person: p3-derivation (5)",
    ]
    with pytest.raises(NotCorrectError):
        checked("p3-lagrangian", "return 0.5 * I * qd**2")
    assert "2.5 of 15 points checked;" in capsys.readouterr().out.splitlines()[-1]
    assert progress.of("p3-M").left["p3-lagrangian"] == 1.5
    with pytest.raises(NotCorrectError):
        checked("p3-M", "return 2 * pend.I")
    assert "1.5 of 15 points checked;" in capsys.readouterr().out.splitlines()[-1]
    assert progress.of("p3-M").left.keys() >= {"p3-lagrangian", "p3-M"}


@pytest.mark.parametrize("source", SOURCES, ids=lambda path: path.stem)
def test_each_notebook_of_the_course_is_understood(source, kernel, monkeypatch):
    shutil.copy(source, kernel)
    graded = progress.read_graded(source)
    judged = [name for name in graded if name in CHECKS]
    for name in judged:
        progress.note(Verdict(name, State.CORRECT, 1.0))
    of = progress.of(judged[0])
    assert of.left == {}
    assert of.by_person.keys() == set(graded) - set(judged)
    assert of.total == of.right + sum(of.by_person.values())
    stated = re.search(r"(\d+) points\.", source.read_text(encoding="utf-8"))
    assert of.total == float(stated[1])


@pytest.mark.parametrize(
    "text", ["", "{", "[]", "null", '{"cells": [{}]}', '{"cells": 3}', "[" * 9999]
)
def test_a_notebook_that_cannot_be_read_gives_no_points(text, kernel):
    (kernel / "p3-pendulum.ipynb").write_text(text)
    assert progress.of("p3-M") is None


def test_another_notebook_in_the_folder_is_not_taken_for_it(notebook, kernel):
    (kernel / "a.ipynb").write_text(json.dumps({"cells": []}))
    assert progress.of("p3-M").total == 15
    assert progress.of("p1-M") is None


def test_what_is_left_is_folded_and_no_line_ends_within_the_name_of_a_check(notebook):
    (line,) = below.points(Verdict("p3-M", State.CORRECT, 1.0))
    kept = re.findall(r'<span style="white-space: nowrap">([^<]*)</span>', line.html)
    assert kept[0] == "p3-lagrangian (3)"
    assert len(kept) == 7
    summary, _, rest = line.html.partition("</summary>")
    assert re.sub("<[^>]*>", "", summary) == line.text
    assert line.html.startswith("<details>")
    assert re.sub("<[^>]*>", "", rest) == "".join(progress.of("p3-M").rest)


def test_the_pictures_stand_between_the_hint_and_the_section():
    drawn = Line("See it.")
    lines = below.lines(Verdict("p3-M", State.INCORRECT), [drawn])
    assert lines.index(drawn) == 1
    assert len(lines) == 3
    assert below.lines(Verdict("p3-M", State.CORRECT, 1.0), []) == []


def test_a_heading_that_asks_needs_no_full_stop():
    (_, section) = texts(Verdict("c6-rank_of_excitation", State.INCORRECT))
    assert section.endswith("4 · How many parameters can a motion show?")


def texts(verdict) -> list[str]:
    return [line.text for line in below.lines(verdict)]


@pytest.mark.parametrize(
    "state", [State.INCORRECT, State.PARTLY_CORRECT, State.ERROR, State.NOT_ATTEMPTED]
)
def test_who_is_not_done_gets_the_hint_to_call_and_the_section(state, tmp_path):
    verdict = Verdict("p3-M", state)
    assert texts(verdict) == [
        'Stuck? Run hint("p3-M") for a hint. Hints cost no points.',
        "Lesson 01 prepares this: 4 · What each term is, and what it does.",
    ]
    assert "<a " not in "".join(line.html for line in below.lines(verdict))
    (tmp_path / "lessons" / "01-canonical-form.ipynb").write_text("{}")
    link = "../../lessons/01-canonical-form.ipynb"
    assert f'<a href="{link}#cell-id=01-terms">4 · What' in below.lines(verdict)[1].html
    assert texts(verdict)[1].endswith(f"({link})")


@pytest.mark.parametrize("state", [State.CORRECT, State.CHECK_FAILED])
def test_who_is_done_or_not_to_blame_does_not(state):
    assert texts(Verdict("p3-M", state)) == []


def test_a_check_of_a_mechanism_leads_to_the_section_too():
    assert texts(Verdict("cart-pole-M", State.INCORRECT)) == [
        'Stuck? Run hint("cart-pole-M") for a hint. Hints cost no points.',
        "Lesson 03 prepares this: 2 · From the bodies to the arm.",
    ]
