"""What a Jupyter server of the environment does for a course; the rest is tested in the browser."""

import asyncio
import json
import logging
import os
import re
import shutil
import socket
import subprocess
import sys
import urllib.request
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from pathlib import Path

import nbformat
import psutil
import pytest
from ipykernel.ipkernel import IPythonKernel
from jupyter_client.kernelspec import KernelSpecManager
from jupyter_server.serverapp import ServerApp
from nbgrader.apps.baseapp import NbGrader

from armdyn.ports.toolchain import processes
from autograder import cli, lab_server
from autograder.lab_server import NOT_FOR_STUDENTS, CourseContents
from tests.autograder.courses import P3, ROOT, new_course
from tests.autograder.eventually import eventually

DIRECTLY = urllib.request.build_opener(urllib.request.ProxyHandler({}))
LESSON = "lessons/00-start-here.ipynb"


@pytest.fixture
def course(tmp_path):
    """A course with one lesson, p3 in problems/, and in the exchange p3 and another assignment."""
    root = new_course(tmp_path / "course of mine")
    (root / "lessons").mkdir()
    shutil.copy(ROOT / LESSON, root / "lessons")
    shutil.copytree(root / "course" / "release" / P3, root / "problems" / P3)
    lab_server.enable()  # as `autograder problems` does
    outbound = root / "course" / "exchange" / "armdyn" / "outbound"
    shutil.copytree(root / "course" / "release" / P3, outbound / P3)
    shutil.copytree(root / "course" / "release" / P3, outbound / "p9-new")
    return root


@contextmanager
def plain_jupyter_lab(root):
    """`jupyter lab lessons/00-start-here.ipynb` in the course's folder; gives what asks it."""
    command = [Path(sys.executable).with_name("jupyter"), "lab", LESSON, "--no-browser", "--port=0"]
    root_may = ["--allow-root"] if getattr(os, "geteuid", lambda: 1)() == 0 else []
    log = root.parent / "jupyter.log"
    with (
        log.open("w") as said,
        processes.start(
            [*command, *root_may, "--IdentityProvider.token=t"], cwd=root, stderr=said
        ) as server,
    ):
        try:
            shown = re.compile(r"(http://127\.0\.0\.1:\d+)/lab")
            assert eventually(lambda: server.poll() is not None or shown.search(log.read_text()))
            assert server.poll() is None, log.read_text()
            address = shown.search(log.read_text()).group(1)
            # The address may be in the log before anything listens there.
            assert eventually(lambda: _listens(int(address.rpartition(":")[2])))

            def ask(path: str, /, **data: str):
                request = urllib.request.Request(
                    address + path,
                    headers={"Authorization": "token t", "Content-Type": "application/json"},
                    data=json.dumps(data).encode() if data else None,
                )
                with DIRECTLY.open(request, timeout=250) as answer:
                    return json.load(answer)

            yield ask
        finally:
            server.terminate()
            processes.end(server, 30)


def _listens(port: int) -> bool:
    with socket.socket() as trial:
        return trial.connect_ex(("127.0.0.1", port)) == 0


@pytest.mark.skipif(os.name == "nt", reason="nbgrader has no exchange on Windows")
def test_plain_jupyter_lab_knows_the_course(course):
    work = course / "problems" / P3 / f"{P3}.ipynb"
    work.write_text(work.read_text() + "\n")
    mine = work.read_text()
    with plain_jupyter_lab(course) as ask:
        shown = {entry["name"] for entry in ask("/api/contents")["content"]}
        assert {"lessons", "problems", "solutions"} <= shown
        assert ask("/courses")["value"] == ["armdyn"]
        listed = ask("/assignments?course_id=armdyn")["value"]
        assert {a["assignment_id"]: a["status"] for a in listed} == {
            P3: "fetched",
            "p9-new": "released",
        }
        for assignment in ("p9-new", P3):
            answer = ask("/assignments/fetch", course_id="armdyn", assignment_id=assignment)
            assert answer["success"]
        listed = answer["value"]
        assert [a["path"] for a in listed] == [f"problems/{P3}", "problems/p9-new"]
        damaged_is_told(ask, work)
    assert work.read_text() == mine
    assert (course / "problems" / "p9-new" / f"{P3}.ipynb").exists()


def environments() -> Iterator[dict[str, str]]:
    """Of the processes that this one has started, and these."""
    for process in psutil.Process().children(recursive=True):
        with suppress(psutil.Error):  # it has ended, or is another account's
            yield process.environ()


def damaged_is_told(ask, work):
    """Validate answers with a sentence, where nbgrader would say "Success" or show its own code."""
    notebook = nbformat.read(work, as_version=4)
    for cell in notebook.cells:
        cell.metadata.pop("nbgrader", None)
    ends = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell("import os; os._exit(1)")])
    for made, said in (
        (notebook, "have lost nbgrader's settings"),
        (ends, "Python itself stopped"),
    ):
        nbformat.write(made, work.with_name("damaged.ipynb"))
        answer = ask("/assignments/validate", path=f"problems/{P3}/damaged.ipynb")
        assert not answer["success"]
        assert said in answer["value"]
        assert "Traceback" not in answer["value"]
    # Nothing of the failed ones is left in the server, from which a student's kernel would have it.
    ask("/api/kernels", name="python3")
    kernels = [environment for environment in environments() if "JPY_PARENT_PID" in environment]
    assert kernels
    assert not [
        one for one in kernels if {"NBGRADER_EXECUTION", "NBGRADER_VALIDATING"} & one.keys()
    ]
    sound = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell("1 + 1")])
    nbformat.write(sound, work.with_name("sound.ipynb"))
    assert ask("/assignments/validate", path=f"problems/{P3}/sound.ipynb")["success"]


@pytest.fixture
def contents():
    return CourseContents(root_dir=str(ROOT))


@pytest.mark.parametrize(
    "path",
    [p.relative_to(ROOT) for f in ("lessons", "solutions") for p in (ROOT / f).rglob("*.ipynb")],
)
def test_jupyterlab_finds_nothing_to_add_to_a_notebook(contents, path):
    """It adds what the kernel says of itself and its specification, and ids to cells of nbformat 4.4."""
    notebook = awaited(contents.get(str(path)))["content"]
    kernel = KernelSpecManager().get_kernel_spec("python3")
    assert notebook["metadata"]["language_info"] == IPythonKernel.language_info
    assert notebook["metadata"]["kernelspec"] == {
        "name": "python3",
        "display_name": kernel.display_name,
        "language": kernel.language,
    }
    assert (notebook["nbformat"], notebook["nbformat_minor"]) == (4, 5)


def test_a_notebook_for_another_kernel_is_left_as_it_is(tmp_path):
    metadata = {"kernelspec": {"name": "octave", "display_name": "Octave"}}
    notebook = {"cells": [], "metadata": metadata, "nbformat": 4, "nbformat_minor": 5}
    (tmp_path / "other.ipynb").write_text(json.dumps(notebook))
    model = awaited(CourseContents(root_dir=str(tmp_path)).get("other.ipynb"))
    assert model["content"]["metadata"] == metadata


def awaited(coroutine):
    """What it gives; in a thread, as this one may have the browser's event loop."""
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(asyncio.run, coroutine).result()


def names(contents: CourseContents, folder: str = "") -> set[str]:
    return {entry["name"] for entry in awaited(contents.get(folder))["content"]}


def test_a_student_sees_lessons_problems_and_what_is_their_own(tmp_path):
    for name in ("lessons", "problems", "my notes", "solutions", "problems/solutions"):
        (tmp_path / name).mkdir()
    contents = CourseContents(root_dir=str(tmp_path), for_student=True)
    assert names(contents) == {"lessons", "problems", "my notes"}
    assert names(contents, "problems") == {"solutions"}
    contents.for_student = False
    assert "solutions" in names(contents)


def test_all_of_the_kit_but_the_lessons_is_hidden_from_a_student():
    listed = subprocess.run(
        [shutil.which("git"), "ls-files", "-z"],
        cwd=ROOT,
        capture_output=True,
        check=True,
        text=True,
    )
    kit = {name.split("/")[0] for name in listed.stdout.split("\0") if name[:1] not in ("", ".")}
    assert kit - set(NOT_FOR_STUDENTS) == {"lessons"}


def test_a_server_elsewhere_is_left_as_it_is(tmp_path, monkeypatch):
    monkeypatch.delenv("JUPYTER_CONFIG_PATH", raising=False)
    server = ServerApp(root_dir=str(tmp_path))
    before = server.config.copy(), server.contents_manager_class
    lab_server._link_jupyter_server_extension(server)
    assert (server.config, server.contents_manager_class) == before
    assert server.root_dir == str(tmp_path)
    assert "JUPYTER_CONFIG_PATH" not in os.environ


def test_nbgrader_misses_no_settings_where_a_student_needs_none(tmp_path, monkeypatch, capsys):
    (tmp_path / "lessons").mkdir()
    (tmp_path / "armdyn.json").write_text("{}")
    monkeypatch.setenv("JUPYTER_CONFIG_PATH", "")  # is changed
    monkeypatch.chdir(tmp_path)
    log = logging.getLogger("NbGrader")
    try:
        NbGrader().load_config_file()
        assert "No nbgrader_config.py file found" in capsys.readouterr().err
        lab_server._link_jupyter_server_extension(ServerApp(root_dir=str(tmp_path)))
        NbGrader().load_config_file()
        assert capsys.readouterr().err == ""
    finally:
        log.removeFilter(lab_server.is_needed)
        log.handlers.clear()


@pytest.fixture
def empty_course(tmp_path, monkeypatch):
    shutil.copy(ROOT / "nbgrader_config.py", tmp_path)
    monkeypatch.chdir(tmp_path)


def test_problems_has_every_server_of_the_environment_load_it(empty_course, monkeypatch, tmp_path):
    monkeypatch.setattr("jupyter_server.extension.serverextension.ENV_CONFIG_PATH", [str(tmp_path)])
    assert cli.main(["problems"]) == 0
    (written,) = tmp_path.glob("jupyter_server_config.d/*.json")
    loaded = json.loads(written.read_text())["ServerApp"]["jpserver_extensions"]
    assert loaded == {"autograder.lab_server": True}


def test_an_environment_that_cannot_be_written_is_named(empty_course, monkeypatch, capsys):
    def refuse():
        raise PermissionError(13, "Permission denied", "etc/jupyter")

    monkeypatch.setattr(lab_server, "enable", refuse)
    assert cli.main(["problems"]) == 0
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "Permission denied: 'etc/jupyter'" in said
    assert "use `autograder lab` instead" in said
