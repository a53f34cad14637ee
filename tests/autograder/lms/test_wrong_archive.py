"""`autograder collect-zip` with an archive or a sheet that belongs to something else."""

import json

import pytest

from autograder.cli import main
from tests.autograder.courses import ROOT
from tests.autograder.lms.platforms import canvas_name, canvas_sheet, moodle_folder, zipped

P1, P3 = "p1-inertia", "p3-pendulum"
NOTEBOOK = json.dumps({"cells": [], "metadata": {}, "nbformat": 4, "nbformat_minor": 4})
WHO = {"ada": ("Ada Lovelace", 101), "bob": ("Bob Doe", 102)}


@pytest.fixture
def course(tmp_path, monkeypatch):
    for name in (P1, P3):
        (tmp_path / "solutions" / name).mkdir(parents=True)
        (tmp_path / "solutions" / name / f"{name}.ipynb").write_text("{}")
    (tmp_path / "course").mkdir()
    (tmp_path / "nbgrader_config.py").write_text((ROOT / "nbgrader_config.py").read_text())
    (tmp_path / "course" / "class.csv").write_text(
        "id,last_name,first_name,lms_id\nada,Lovelace,Ada,11\nbob,Doe,Bob,12\n"
    )
    monkeypatch.chdir(tmp_path)
    return tmp_path


def archive(course, called: str, **names: str):
    files = {f"{moodle_folder(*WHO[one])}/{name}": NOTEBOOK for one, name in names.items()}
    return zipped(course / f"{called}.zip", files)


def collect(capsys, *arguments) -> tuple[int, str]:
    return main(["collect-zip", P1, *map(str, arguments)]), capsys.readouterr().out


def submitted(course) -> list[str]:
    folder = course / "course" / "submitted"
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*.ipynb"))


def test_the_archive_of_another_assignment_is_not_taken(course, capsys):
    wrong = archive(course, "wrong", ada=f"{P3}.ipynb", bob="p3-pendulum (1).ipynb")
    status, said = collect(capsys, wrong)
    assert status == 1
    assert f"wrong.zip: its notebooks are those of {P3}, and not of {P1}: none was taken" in said
    assert submitted(course) == []


def test_one_student_with_the_notebook_of_another_assignment_keeps_the_earlier_one(course, capsys):
    collect(capsys, archive(course, "first", ada=f"{P1}.ipynb"))
    mixed = archive(course, "mixed", ada=f"{P3}.ipynb", bob="p1-inertia-1.ipynb")
    status, said = collect(capsys, mixed)
    assert status == 1
    assert f"ada: not taken: the notebook is called as that of {P3}" in said
    assert submitted(course) == [f"ada/{P1}/{P1}.ipynb", f"bob/{P1}/{P1}.ipynb"]


def test_a_hand_in_without_a_notebook_gives_way_to_any_with_one(course, capsys):
    held = course / "course" / "submitted" / "ada" / P1
    held.mkdir(parents=True)
    (held / "photo.png").write_text("png")
    (held / "timestamp.txt").write_text("2026-11-01 00:00:00 UTC\n")
    (course / "course" / "calendar.toml").write_text(f"[{P1}]\ndue = 2026-11-28T17:00:00Z\n")
    late = canvas_name("Lovelace, Ada", 11, 5, f"{P1}.ipynb", late=True)
    path = zipped(course / "canvas.zip", {late: NOTEBOOK})
    status, said = collect(capsys, path)
    assert status == 0
    assert "ada: taken" in said
    assert submitted(course) == [f"ada/{P1}/{P1}.ipynb"]


def test_a_sheet_that_names_nobody_of_the_archive_is_said(course, capsys):
    path = archive(course, "right", ada=f"{P1}.ipynb")
    sheet = canvas_sheet(
        course / "sheet.csv", [{"name": "Lovelace, Ada", "number": 11}], {P1: "15"}
    )
    status, said = collect(capsys, path, "--sheet", sheet)
    assert status == 1
    assert "right.zip: the sheet names nobody who handed this in" in said
    assert "ada: taken" in said
