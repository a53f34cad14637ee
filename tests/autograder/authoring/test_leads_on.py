"""A course's own file says where its cards lead: tried, released, and read in a kernel."""

import shutil
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient
from nbformat.v4 import new_code_cell

from autograder.authoring.leads_on import led_on
from autograder.authoring.template import template
from autograder.cli import main
from autograder.mechanisms.file import mechanism_of
from tests.autograder.courses import run

ROOT = Path(__file__).parents[3]
LESSON = "05-gravity"
OWN = """
    further={"M": "Put two sleds on the spring, and M is their sum."},
    sections={"M": ("05-gravity", "05-properties", "2 · What g(q) depends on, and what not")},
)
"""
SLED = template("sled").rstrip().removesuffix(")") + OWN.lstrip("\n")


@pytest.fixture
def root(tmp_path):
    (tmp_path / "lessons").mkdir()
    shutil.copy(ROOT / "lessons" / f"{LESSON}.ipynb", tmp_path / "lessons")
    return tmp_path


@pytest.mark.parametrize(
    ("before", "after", "said"),
    [
        ('further={"M"', 'further={"m"', "further has 'm', which is none of M, C, M_dot, g_vec"),
        ('sections={"M"', 'sections={"W"', "sections has 'W', which is none of M, C"),
        ('"05-gravity"', '"05-graviti"', "there is no lesson '05-graviti'; did you mean '05-grav"),
        (
            '"05-properties"',
            '"05-2"',
            "no cell '05-2'; its sections begin at '05-title' (05 · Gra",
        ),
        ("2 · What g(q) dep", "2 · What g dep", "; did you mean '2 · What $g(q)$ depends on, and"),
    ],
)
def test_try_says_what_leads_nowhere(root, before, after, said):
    def lines(text):
        return list(led_on(root, mechanism_of(text, "sled.py", "sled")))

    assert lines(SLED) == []
    (line,) = lines(SLED.replace(before, after, 1))
    assert not line.good
    assert said in line.text


def test_a_lesson_that_is_damaged_or_not_there(root):
    sled = mechanism_of(SLED, "sled.py", "sled")
    (root / "lessons" / f"{LESSON}.ipynb").write_text('{"cells": [3]}')
    (line,) = led_on(root, sled)
    assert "05-gravity.ipynb is no notebook that can be read" in line.text
    shutil.rmtree(root / "lessons")
    assert list(led_on(root, sled)) == []


def test_a_student_reads_it_in_a_kernel(root, monkeypatch):
    """Of a problem as an instructor makes it, and as a student has it."""
    monkeypatch.chdir(root)
    shutil.copy(ROOT / "nbgrader_config.py", root)
    folder = root / "solutions" / "sled"
    folder.mkdir(parents=True)
    (folder / "sled.py").write_text(SLED, encoding="utf-8")
    assert main(["try", "sled", "--asks", "M"]) == 0
    assert main(["new-problem", "sled", "--asks", "M,g_vec"]) == 0
    run(root, "nbgrader", "generate_assignment", "sled")
    fetched = shutil.copytree(root / "course" / "release" / "sled", root / "problems" / "sled")

    unmet, met = cards(
        fetched, "def M(q, arm):\n    return 7", "def M(q, arm):\n    return [[arm.m]]"
    )
    link = "../../lessons/05-gravity.ipynb#cell-id=05-properties"
    assert f'<a href="{link}">2 · What g(q) depends on, and what not</a>' in unmet
    assert "Put two sleds" not in unmet
    assert "sled-M: correct" in met
    assert "Put two sleds on the spring, and M is their sum." in met
    assert "lessons/" not in met


def cards(folder: Path, *answers: str) -> list[str]:
    """What check("sled-M") shows as HTML below each answer, in a kernel that has run the set-up cell."""
    notebook = nbformat.read(folder / "sled.ipynb", 4)
    set_up = next(cell for cell in notebook.cells if cell.id == "sled-setup")
    check = next(cell for cell in notebook.cells if cell.id == "sled-M-check")
    notebook.cells = [set_up]
    for answer in answers:
        notebook.cells += [new_code_cell(answer), new_code_cell(check.source)]
    where = {"metadata": {"path": str(folder)}}
    NotebookClient(notebook, allow_errors=True, resources=where).execute()
    return [
        "".join(out.get("data", {}).get("text/html", "") for out in cell.outputs)
        for cell in notebook.cells[2::2]
    ]
