"""Courses with submissions, for tests of whole grading runs, and what their gradebooks hold."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import nbformat
import sqlalchemy

from tests.autograder.course_problems import problem, without_plots
from tests.autograder.nbgrader_forks import PROGRAMS, installed
from tests.once import made_once

ROOT = Path(__file__).parents[2]
P3 = "p3-pendulum"
NOTEBOOK = f"{P3}.ipynb"
SEED = "0123456789abcdef"
TABLES = ("student", "submitted_assignment", "submitted_notebook", "grade", "comment")


def run(root: Path, *command: str, status: int = 0) -> str:
    """What one of the environment's commands printed; it must end with this status."""
    name, *arguments = command
    settings = {"JUPYTER_DATA_DIR": str(root / "data")}
    if name in PROGRAMS and hasattr(os, "fork"):
        ended, printed = installed(root, name, *arguments, **settings)
    else:
        result = subprocess.run(
            [Path(sys.executable).parent / name, *arguments],
            cwd=root,
            capture_output=True,
            text=True,
            env=os.environ | settings,
        )
        ended, printed = result.returncode, result.stdout + result.stderr
    assert ended == status, printed
    return printed


def before_the_first_command(root: Path) -> Path:
    """The folder `root`, which is made if need be, with the settings and p3 without its figures."""
    shutil.copytree(ROOT / "solutions" / P3, root / "solutions" / P3)
    shutil.copy(ROOT / "nbgrader_config.py", root)
    nbformat.write(without_plots(problem(P3).source), root / "solutions" / P3 / NOTEBOOK)
    return root


def _release(root: Path) -> None:
    before_the_first_command(root)
    run(root, "nbgrader", "generate_assignment", P3)
    (root / "course" / "seed").write_text(SEED)


def new_course(root: Path) -> Path:
    """A course whose p3, without its figures, is released, in the folder `root`, which is made."""
    shutil.copytree(made_once("course", _release), root)
    return root


def release(root: Path):
    return nbformat.read(root / "course" / "release" / P3 / NOTEBOOK, as_version=4)


def submit(root: Path, student: str, notebook, timestamp: str = "") -> Path:
    """Hand in a notebook, or a text that is none; the file."""
    folder = root / "course" / "submitted" / student / P3
    folder.mkdir(parents=True, exist_ok=True)
    text = notebook if isinstance(notebook, str) else json.dumps(notebook)
    (folder / NOTEBOOK).write_text(text)
    if timestamp:
        (folder / "timestamp.txt").write_text(timestamp)
    return folder / NOTEBOOK


def database(root: Path) -> str:
    return f"sqlite:///{root / 'course' / 'gradebook.db'}"


def rows(url: str) -> dict[str, list[tuple]]:
    """Every row that grading writes, by table, with names in the place of random ids."""
    engine = sqlalchemy.create_engine(url)
    with engine.connect() as connection:

        def all_of(table):
            result = connection.execute(sqlalchemy.text(f"SELECT * FROM {table}"))
            return [dict(row) for row in result.mappings()]

        names = {row["id"]: row["name"] for t in ("assignment", "notebook", "base_cell")
                 for row in all_of(t)}  # fmt: skip
        for row in all_of("submitted_assignment"):
            names[row["id"]] = f"{row['student_id']}/{names[row['assignment_id']]}"
        for row in all_of("submitted_notebook"):
            names[row["id"]] = f"{names[row['assignment_id']]}/{names[row['notebook_id']]}"
        found = {
            table: sorted(
                (tuple((key, names.get(value, value)) for key, value in row.items()
                       if (table, key) != ("grade", "id") and (table, key) != ("comment", "id"))
                 for row in all_of(table)),
                key=repr,
            )
            for table in TABLES
        }  # fmt: skip
    engine.dispose()
    return found


def files(folder: Path) -> dict[str, object]:
    """Every file below a folder, and the folders that hold some: permissions, and what is in it."""
    found = {}
    for path in sorted(folder.rglob("*")):
        if path.is_dir() and not any(below.is_file() for below in path.rglob("*")):
            continue  # nbgrader leaves an empty one where it failed
        shown = oct(path.stat().st_mode)
        if path.suffix == ".ipynb":
            notebook = nbformat.read(path, as_version=4)
            for cell in notebook.cells:
                cell.pop("id", None)  # nbformat replaces doubled ones by random ones
            found[str(path.relative_to(folder))] = shown, notebook
        else:
            found[str(path.relative_to(folder))] = shown, path.is_file() and path.read_bytes()
    return found
