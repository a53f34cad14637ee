"""`autograder problems`: writes what is missing, and never over a student's work."""

import shutil
from pathlib import Path

import nbformat
import pytest

from autograder.cli import main
from autograder.nbgrader_glue import write_problem

ROOT = Path(__file__).parents[2]
P3 = "p3-pendulum"


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A course's folder, called as a student might, and the working directory."""
    root = tmp_path / "robots [2026] *"
    shutil.copytree(ROOT / "solutions" / P3, root / "solutions" / P3)
    shutil.copy(ROOT / "nbgrader_config.py", root)
    monkeypatch.chdir(root)
    return root


def files(folder: Path) -> dict[str, bytes]:
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file()
    }


def test_problems_are_written_without_solutions(course, capsys):
    assert main(["problems"]) == 0
    assert capsys.readouterr().out == f"problems/{P3}/{P3}.ipynb: written\n"
    written = course / "problems" / P3
    assert {path.name for path in written.iterdir()} == {f"{P3}.ipynb", "pendulum.svg"}
    notebook = nbformat.read(written / f"{P3}.ipynb", as_version=4)
    nbformat.validate(notebook)
    text = "\n".join(cell.source for cell in notebook.cells)
    for trace in ("BEGIN SOLUTION", "END SOLUTION", "HIDDEN TESTS", "fresh=True"):
        assert trace not in text
    assert "raise NotImplementedError" in text
    assert all(not cell.get("outputs") for cell in notebook.cells)
    tags = {
        cell.metadata.nbgrader.grade_id: cell.metadata.get("tags")
        for cell in notebook.cells
        if "nbgrader" in cell.metadata
    }
    assert tags["p3-M"] == ["raises-exception"]  # so that "Run All Cells" goes on
    assert tags["answer-M"] == ["raises-exception"]
    assert tags["p3-setup"] is None  # without it nothing else can run


def test_no_gradebook_is_made_and_the_solutions_stay(course):
    before = files(course / "solutions")
    assert main(["problems"]) == 0
    assert files(course / "solutions") == before
    assert not list(course.rglob("gradebook.db"))
    assert not list((course / "course").rglob(f"{P3}.ipynb"))


def test_a_second_call_keeps_the_students_file_byte_for_byte(course, capsys):
    assert main(["problems"]) == 0
    path = course / "problems" / P3 / f"{P3}.ipynb"
    path.write_bytes(
        path.read_bytes().replace(b"raise NotImplementedError", b"return 0") + b"\n \n"
    )
    (course / "problems" / P3 / "notes.txt").write_text("mine")
    before = files(course / "problems")
    capsys.readouterr()
    assert main(["problems"]) == 0
    assert files(course / "problems") == before
    assert capsys.readouterr().out == (
        f"problems/{P3}/{P3}.ipynb: kept, as it may hold your work; move it away to get a new one\n"
    )


def test_what_lies_beside_a_new_notebook_is_kept_too(course):
    folder = course / "problems" / P3
    folder.mkdir(parents=True)
    (folder / "pendulum.svg").write_text("my own drawing")
    write_problem(course, P3, folder)
    assert (folder / f"{P3}.ipynb").exists()
    assert (folder / "pendulum.svg").read_text() == "my own drawing"


def test_outside_the_courses_folder_one_line_says_what_to_do(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["problems"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.splitlines() == [
        f"autograder: {tmp_path} is not the course's folder: it has no nbgrader_config.py; "
        "change to the folder that holds solutions/ and try again"
    ]
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("command", "asked", "meant"),
    [
        ("grade", "p3", "Did you mean p3-pendulum?"),
        ("report", "P3-Pendulum", "Did you mean p3-pendulum?"),
        ("grade", "pendulum", "Did you mean p3-pendulum?"),
        ("report", "p3-pendelum", "Did you mean p3-pendulum?"),
        ("grade", "nothing", "There are p3-pendulum."),
        ("report", "", "There are p3-pendulum."),
    ],
)
def test_an_assignment_that_is_not_there_is_named_with_the_one_that_may_be_meant(
    course, capsys, command, asked, meant
):
    assert main([command, asked]) == 2
    said = f"autograder: there is no solutions/{asked}/{asked}.ipynb. {meant}\n"
    assert capsys.readouterr().err == said


@pytest.mark.parametrize(
    ("command", "asked"),
    [("grade", f"{P3}/"), ("report", f"solutions/{P3}"), ("grade", f"./solutions/{P3}/")],
)
def test_an_assignment_may_be_named_by_its_folder(course, capsys, command, asked):
    assert main([command, asked]) == 2  # nothing is released yet
    assert "there is no solutions/" not in capsys.readouterr().err


@pytest.mark.parametrize("arguments", [[], ["no-such-command"], ["problems", "--force"]])
def test_what_is_not_understood_is_refused(arguments, capsys):
    with pytest.raises(SystemExit) as stopped:
        main(arguments)
    assert stopped.value.code == 2
    assert "usage: autograder" in capsys.readouterr().err


def test_a_folder_whose_name_nbgrader_takes_for_a_pattern_is_written_and_named(course, capsys):
    name = "x [y]"
    (course / "solutions" / P3).rename(course / "solutions" / name)
    folder = course / "solutions" / name
    (folder / f"{P3}.ipynb").rename(folder / f"{name}.ipynb")
    (course / "course").mkdir()
    assert main(["problems"]) == 0
    assert f"problems/{name}/{name}.ipynb: written" in capsys.readouterr().out
    written = nbformat.read(course / "problems" / name / f"{name}.ipynb", as_version=4)
    assert "BEGIN SOLUTION" not in "".join(cell.source for cell in written.cells)
    for command in (["grade", name, "--jobs", "1"], ["report", name]):
        assert main(command) == 2
        assert capsys.readouterr().err == (
            "autograder: the gradebook does not know x [y]: nbgrader takes the [ in its name for a "
            "pattern, and cannot release it: give the folder solutions/x [y] and its notebook a name "
            "without it\n"
        )
