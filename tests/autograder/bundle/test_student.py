"""A student has the archive alone: unpacks it, opens it, answers, and hands in."""

import json
import re
import shutil
import socket
import sys
import urllib.request
from pathlib import Path
from urllib.parse import urljoin

import nbformat
import pytest

from armdyn.ports.toolchain import processes
from autograder.judging.passages import filled
from autograder.lab_server import course_of
from autograder.notebook.version import other_version, version_of
from autograder.protocol.limits import NO_LIMIT
from tests.autograder.bundle import sitting
from tests.autograder.course_problems import NAMES, problem, without_plots
from tests.autograder.eventually import eventually

SITTING = str(Path(sitting.__file__))
LEFT = {"p1-inertia": 1, "p4-gravity": 1, "c8-control": 2}  # checks that only the grader makes


def sit(installed, tmp_path, name, notebook, *how):
    """What the cells of a notebook print, from the student's folder."""
    folder = tmp_path / "problems" / name
    shutil.copytree(installed.folder / "problems" / name, folder)
    shutil.copytree(installed.folder / "lessons", tmp_path / "lessons", dirs_exist_ok=True)
    nbformat.write(notebook, folder / f"{name}.ipynb")
    done = installed.run(
        "-W", "ignore", SITTING, str(folder / f"{name}.ipynb"), *how, env={"MPLBACKEND": "agg"}
    )
    (used,) = re.findall("package: (.*)", done.stdout)
    assert Path(used).is_relative_to(installed.python.parents[1])
    return done.stdout


def handed_out(installed, name):
    return nbformat.read(installed.folder / "problems" / name / f"{name}.ipynb", as_version=4)


@pytest.mark.parametrize(
    "name",
    [pytest.param(n, marks=[] if n[:2] in ("p1", "p3") else pytest.mark.long) for n in NAMES],
)
def test_right_answers_are_right(installed, tmp_path, name):
    of = problem(name)
    answered = without_plots(of.submissions.right(handed_out(installed, name)))
    said = sit(installed, tmp_path, name, answered)
    checks = len(of.submissions.POINTS)
    assert len(re.findall("^[pc][1-8]-.*: correct$", said, re.MULTILINE)) == checks - LEFT.get(
        name, 0
    )
    assert said.count("judged when you hand it in") == LEFT.get(name, 0)
    assert "NotCorrectError" not in said


def test_a_wrong_answer_is_named_as_on_any_other_system(installed, tmp_path):
    """Without what Windows lacks: signals, forks, files' locks."""
    wrong = problem("p3-pendulum").submissions.wrong(handed_out(installed, "p3-pendulum"))
    here, there = (
        sit(installed, tmp_path / where, "p3-pendulum", without_plots(wrong), *how)
        for where, how in (("here", ()), ("there", ("elsewhere",)))
    )
    assert here.count("NotCorrectError") == 6
    assert "the cosine of q where the sine belongs" in " ".join(here.split())
    assert "Lesson 01 prepares this" in here
    assert "points checked" in here
    # From Python 3.12 on code can be stopped without signals too.
    unlimited = f"{filled(NO_LIMIT, indent=0)}\n"
    assert there.count(unlimited) == (sys.version_info < (3, 12))
    assert there.replace(unlimited, "") == here


def test_the_notebook_says_its_version_and_keeps_it(installed):
    for name in NAMES:
        notebook, source = handed_out(installed, name), problem(name).source
        assert notebook.metadata.armdyn.version == version_of(source, {})
        assert other_version(notebook, source, {}) == ""
        nbformat.validate(notebook)


def test_the_command_opens_the_course_where_there_is_none(installed, tmp_path):
    """As `uvx --from …whl autograder lab` does in an empty folder."""
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    command = installed.python.parent / "autograder"
    home = tmp_path / "home"
    home.mkdir()
    log = (tmp_path / "log").open("w")
    server = processes.start(
        [command, "lab", f"--port={port}", "--no-browser"], cwd=tmp_path, stdout=log, stderr=log,
        env={"HOME": str(home), "PATH": "/usr/bin:/bin", "PYTHONUNBUFFERED": "1"},
    )  # fmt: skip
    try:
        shown = re.compile("Open (http.*)")
        log_of = (tmp_path / "log").read_text
        assert eventually(lambda: server.poll() is not None or shown.search(log_of()))
        assert server.poll() is None, log_of()
        address = shown.search(log_of())
        # Another port than the one asked for, where another program has taken that meanwhile.
        token = address[1].partition("token=")[2]
        url = urljoin(address[1], f"/api/contents/problems?token={token}")
        with urllib.request.urlopen(url) as answer:
            assert "p3-pendulum" in answer.read().decode()
    finally:
        server.terminate()
        processes.end(server, 30)
        log.close()
    course = tmp_path / "armdyn"
    assert f"Your course is in {course}" in (tmp_path / "log").read_text()
    assert (course / "lessons" / "00-start-here.ipynb").is_file()
    page = json.loads((course / ".lab" / "lab" / "settings" / "page_config.json").read_text())
    assert "@jupyter/nbgrader:assignment-list" in page["disabledExtensions"]
    assert course_of(course / "problems") == course
    assert not (course / "solutions").exists()
