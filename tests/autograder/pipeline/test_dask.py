"""The same grading on a Dask cluster: a scheduler and two workers, one of which is killed."""

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import dask
import pytest
from distributed import Client

from autograder import cli
from autograder.commands.grade import open_recorder
from autograder.pipeline import run as pipeline
from tests.autograder import courses
from tests.autograder.courses import P3, rows, submit
from tests.submissions import p3_pendulum
from tests.submissions.answers import blank

START_SECONDS = 250.0
STUDENTS = 12


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    """The scheduler's address, and the two workers' processes."""
    folder = tmp_path_factory.mktemp("cluster")
    file = folder / "scheduler.json"
    log = (folder / "log").open("wb")

    def start(*arguments):
        command = [Path(sys.executable).parent / "dask", *map(str, arguments)]
        paths = [str(courses.ROOT / "lib"), str(courses.ROOT)]
        environment = os.environ | {"PYTHONPATH": os.pathsep.join(paths)}
        return subprocess.Popen(command, cwd=folder, env=environment, stdout=log, stderr=log)

    scheduler = start("scheduler", "--host", "127.0.0.1", "--port", 0, "--no-dashboard",
                      "--scheduler-file", file)  # fmt: skip
    workers = [
        start("worker", "--scheduler-file", file, "--no-nanny", "--nthreads", 1, "--no-dashboard")
        for _ in range(2)
    ]
    try:
        with Client(scheduler_file=str(file), timeout=START_SECONDS) as client:
            client.wait_for_workers(2, timeout=START_SECONDS)
            address = client.scheduler.address
        yield address, workers
    finally:
        for process in (*workers, scheduler):
            process.kill()
            process.wait()
        log.close()


def test_a_killed_worker_costs_nobody_a_grade(cluster, tmp_path, monkeypatch):
    address, workers = cluster
    there = courses.new_course(tmp_path / "there")
    kinds = (p3_pendulum.right, p3_pendulum.partly_right, blank)
    for number in range(STUDENTS):
        submit(there, f"student{number:02}", kinds[number % 3](courses.release(there)))
    # What lies beside a notebook travels with it.
    with_module = p3_pendulum.right_but(courses.release(there), g_vec="from mine import g_vec")
    folder = submit(there, "student00", with_module).parent
    (folder / "mine.py").write_text("import numpy as np\n\n\n" + p3_pendulum.RIGHT["g_vec"])
    here = tmp_path / "here"
    shutil.copytree(there, here)

    settled = []
    settle = pipeline._Run._settle

    def kill_half_way(run, student, outcome, **how):
        settled.append(student)
        if len(settled) == STUDENTS // 3:
            workers[0].send_signal(signal.SIGKILL)
            workers[0].wait()
        settle(run, student, outcome, **how)

    monkeypatch.setattr(pipeline._Run, "_settle", kill_half_way)
    lines = pipeline.grade_all(there, P3, open_recorder, scheduler=address)
    assert workers[0].returncode == -signal.SIGKILL
    assert workers[1].poll() is None
    assert all(line.graded and line.redone for line in lines)
    assert lines[0].score == sum(p3_pendulum.POINTS.values())
    monkeypatch.setattr(pipeline._Run, "_settle", settle)
    assert [line.score for line in pipeline.grade_all(here, P3, open_recorder, jobs=1)] == [
        line.score for line in lines
    ]
    assert rows(courses.database(there)) == rows(courses.database(here))


def test_a_wrong_address_is_said_plainly(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(courses.new_course(tmp_path / "course"))
    with dask.config.set({"distributed.comm.timeouts.connect": "1s"}):
        assert cli.main(["grade", P3, "--scheduler", "tcp://127.0.0.1:9"]) == 2
    assert "tcp://127.0.0.1:9" in capsys.readouterr().err
