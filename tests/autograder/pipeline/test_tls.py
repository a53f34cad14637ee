"""A cluster that only those can use who have a certificate, by the commands of docs/workers.md."""

import os
import subprocess
import sys
import time

import dask
import pytest
from distributed import Client
from distributed.security import Security

from armdyn.ports.toolchain import processes
from autograder import cli
from tests.autograder import courses
from tests.autograder.courses import P3, submit
from tests.class_server.document import about_workers
from tests.class_server.server import free_port
from tests.submissions import p3_pendulum

CERTIFICATES, SCHEDULER, WORKER, GRADE = (block.script for block in about_workers())
START_SECONDS = 250.0

pytestmark = pytest.mark.skipif(os.name == "nt", reason="the page is about Linux")


class Cluster:
    """A scheduler and a worker, in a home of their own."""

    def __init__(self, home):
        self.home = home
        self.port = free_port()
        self.address = f"tls://127.0.0.1:{self.port}"
        paths = [str(courses.ROOT / "lib"), str(courses.ROOT)]
        self.environment = {
            "HOME": str(home),
            "PATH": f"{os.path.dirname(sys.executable)}:{os.environ['PATH']}",
            "PYTHONPATH": os.pathsep.join(paths),
        }
        self.started: list[subprocess.Popen] = []

    def here(self, script: str) -> str:
        for there, ours in {
            "10.0.0.5": "127.0.0.1",
            "8786": str(self.port),
            "--nworkers 4": "--nworkers 1",
        }.items():
            script = script.replace(there, ours)
        return script

    def run(self, script: str) -> None:
        subprocess.run(
            ["bash", "-euc", script], env=self.environment, check=True, capture_output=True
        )

    def start(self, script: str) -> None:
        with (self.home / "log").open("ab") as log:
            command = ["bash", "-euc", f"exec {self.here(script)}"]
            process = processes.start(
                command, env=self.environment, cwd=self.home, stdout=log, stderr=log
            )
        self.started.append(process)

    def security(self, folder="tls") -> Security:
        there = self.home / folder
        return Security(
            tls_ca_file=str(there / "ca.pem"),
            tls_client_cert=str(there / "client.pem"),
            tls_client_key=str(there / "client.key"),
            require_encryption=True,
        )

    def wait(self) -> None:
        deadline = time.monotonic() + START_SECONDS
        while True:
            try:
                with Client(self.address, security=self.security(), timeout=5) as client:
                    client.wait_for_workers(1, timeout=START_SECONDS)
                    return
            except OSError:
                assert time.monotonic() < deadline, (self.home / "log").read_text()


@pytest.fixture(scope="module")
def cluster(needs, tmp_path_factory):
    needs("openssl")
    cluster = Cluster(tmp_path_factory.mktemp("cluster"))
    cluster.run(CERTIFICATES)
    cluster.start(SCHEDULER)
    cluster.start(WORKER)
    try:
        cluster.wait()
        yield cluster
    finally:
        for process in reversed(cluster.started):
            process.terminate()
            processes.end(process, 30)


def configured(cluster):
    """Dask's settings, as they are in that home."""
    found = dask.config.collect([str(cluster.home / ".config" / "dask")], env={})
    return dask.config.set(dask.config.merge(dask.config.config, found))


def test_who_has_a_certificate_grades_there(cluster, tmp_path, monkeypatch, capsys):
    there = courses.new_course(tmp_path / "there")
    submit(there, "ada", p3_pendulum.right(courses.release(there)))
    monkeypatch.chdir(there)
    program, *arguments = cluster.here(GRADE).split()
    assert program == "autograder"
    with configured(cluster):
        assert cli.main(arguments) == 0
    assert "1 graded" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("stranger", "fails", "seconds"),
    [("other", "certificate does not match", 60), ("", "Timed out|Connection", 2)],
    ids=["signed by another", "no TLS"],
)
def test_nobody_else_gives_it_work(cluster, stranger, fails, seconds):
    address, security = cluster.address.replace("tls", "tcp"), None
    if stranger:
        (cluster.home / stranger).mkdir()
        cluster.run(CERTIFICATES.replace("~/", f"{cluster.home / stranger}/"))
        address, security = cluster.address, cluster.security(f"{stranger}/tls")
    with (
        dask.config.set({"distributed.comm.timeouts.connect": f"{seconds}s"}),
        pytest.raises(OSError, match=fails),
    ):
        Client(address, security=security, timeout=seconds)


def test_without_a_certificate_it_is_said_what_is_missing(cluster, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(courses.new_course(tmp_path / "course"))
    with dask.config.set({"distributed.comm.timeouts.connect": "2s"}):
        assert cli.main(["grade", P3, "--scheduler", cluster.address]) == 2
    assert "certificate" in capsys.readouterr().err
