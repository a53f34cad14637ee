"""A room ends with the grader that made it, however that ends, and whatever the room is doing."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from autograder.sandbox.ways import Way
from tests.autograder.eventually import eventually
from tests.autograder.sandbox.rooms import EVERY_WAY, appears, gone

ROOT = Path(__file__).parents[3]
DEAF = (
    "import os, signal, subprocess, sys, time\n"
    "for number in (signal.SIGALRM, signal.SIGPROF): signal.signal(number, signal.SIG_IGN)\n"
)
BUSY = {
    "spins": "while True: pass",
    "sleeps": "time.sleep(999)",
    # The children that it leaves: in a session of their own, and orphans.
    "spins in others": "if os.fork() == 0: os.setsid(); os.fork()\nwhile True: pass",
}
# The grader: a fork of it lives on with all its descriptors, as a forked helper of a library would.
GRADER = """
import os, sys, time
from autograder.sandbox.room import Room
from autograder.sandbox.ways import Way
room = Room(Way[sys.argv[1]])
fork = os.fork()
if fork == 0:
    os.setsid()
    time.sleep(999)
    os._exit(0)
print(fork, flush=True)
room.run(os.environ["CELL"])
"""
# A grader of several: this process shares its warm process with the one that it starts.
WORKERS = """
import os, sys
from autograder.sandbox import room as sandbox
from autograder.sandbox.ways import use_shared
from autograder.pipeline.executors import Processes

def spin(source):
    sandbox.Room().run(source)

if __name__ == "__main__":
    with Processes(1, ("autograder.sandbox.room",), sandbox.share, use_shared) as pool:
        future = pool.executor().submit(spin, os.environ["CELL"])
        (worker,) = pool.executor()._processes
        print(worker, flush=True)
        try:
            future.result()
        except Exception:
            sys.stdin.read()
"""


def student(mark: str, busy: str) -> str:
    sleeper = f"[sys.executable, '-c', 'import time; time.sleep(99)', {mark!r}]"
    return f"{DEAF}subprocess.Popen({sleeper}, start_new_session=True)\n{BUSY[busy]}"


@EVERY_WAY
@pytest.mark.parametrize("busy", BUSY)
def test_a_killed_grader_takes_its_room_along(way, busy, tmp_path):
    mark = f"mark-{os.urandom(8).hex()}"
    with subprocess.Popen(
        [sys.executable, "-c", GRADER, way.name],
        stdout=subprocess.PIPE,
        cwd=ROOT,
        # A room without walls lies in a folder below, which its processes name.
        env=os.environ | {"TMPDIR": str(tmp_path), "CELL": student(mark, busy)},
    ) as grader:
        fork = int(grader.stdout.readline())
        try:
            assert appears(mark)
            grader.kill()
            grader.wait()
            assert gone(mark)
            if not way.walled:
                assert gone(f"{tmp_path}/room-")
            if way is Way.UNWALLED:
                assert eventually(lambda: not list(tmp_path.iterdir()))
        finally:
            grader.kill()
            os.kill(fork, signal.SIGKILL)


@pytest.mark.parametrize("victim", ["grader", "worker"])
def test_a_killed_pool_takes_its_rooms_along(victim, needs, tmp_path, tmp_path_factory):
    needs("bubblewrap")
    mark = f"mark-{os.urandom(8).hex()}"
    program = tmp_path / "workers.py"
    program.write_text(WORKERS, encoding="utf-8")
    with subprocess.Popen(
        [sys.executable, program],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        cwd=ROOT,
        env=os.environ
        | {"CELL": student(mark, "spins"), "TMPDIR": str(tmp_path_factory.mktemp("t"))},
    ) as grader:
        worker = int(grader.stdout.readline())
        try:
            assert appears(mark)
            os.kill(grader.pid if victim == "grader" else worker, signal.SIGKILL)
            assert gone(mark)
            assert (grader.poll() is None) == (victim == "worker")
        finally:
            grader.kill()
