"""The gradebook in a PostgreSQL server holds what it holds in SQLite."""

import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest

from autograder.cli import main
from tests.autograder import courses
from tests.autograder.courses import P3, rows, submit
from tests.autograder.postgresql import running
from tests.submissions import p3_pendulum


@pytest.fixture(scope="module")
def server(needs):
    """The folder of a private server's socket; no other way leads to it."""
    programs = Path(needs("postgresql")).resolve().parent
    with running(programs, "grader", "trust") as folder:
        made = [programs / "createdb", "--host", folder, "--username", "grader", "gradebook"]
        subprocess.run(made, check=True)
        yield folder


def test_rows_are_those_of_sqlite(server, tmp_path, monkeypatch, capsys):
    url = f"postgresql+psycopg2://grader@/gradebook?host={server}"
    there = courses.new_course(tmp_path / "there")
    for name in ("right", "partly_right", "blank", "mangled"):
        submit(there, name, p3_pendulum.CLASS[name](courses.release(there)))
    submit(there, "invalid", '{"cells": [')
    here = tmp_path / "here"
    shutil.copytree(there, here)
    (there / "course" / "gradebook.db").unlink()
    with (there / "nbgrader_config.py").open("a") as config:
        config.write(f"c.CourseDirectory.db_url = {url!r}\n")
    courses.run(there, "nbgrader", "generate_assignment", P3, "--force")
    for root in (here, there):
        monkeypatch.chdir(root)
        assert main(["grade", P3, "--jobs", "1"]) == 1
        assert "4 graded, 0 unchanged, 1 could not be graded" in capsys.readouterr().out
    assert not (there / "course" / "gradebook.db").exists()
    assert rows(url) == rows(courses.database(here))
    before = rows(url)
    assert main(["grade", P3, "--jobs", "1"]) == 1
    assert "0 graded, 4 unchanged, 1 could not be graded" in capsys.readouterr().out
    assert rows(url) == before
    # An archive holds it as a file; emptying the course leaves the server alone, and says so.
    assert main(["archive", "--anyway", "--empty", "--yes", "--to", "year.zip"]) == 1
    said = capsys.readouterr().out
    assert "the gradebook is still in postgresql" in said
    zipfile.ZipFile("year.zip").extractall(tmp_path)
    assert rows(courses.database(tmp_path / "year")) == before == rows(url)
