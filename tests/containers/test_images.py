"""The images, really built and run by the commands of docs/containers.md."""

import json
import os
import re
import subprocess
import time
import urllib.request
from contextlib import contextmanager
from pathlib import Path

import pytest

from autograder.sandbox import refusal
from tests.autograder import courses
from tests.autograder.courses import P3
from tests.class_server.server import free_port
from tests.containers import page
from tests.containers.recipe import ROOT, steps
from tests.submissions import hostile, hostile_judge, p3_pendulum

BASE = steps(ROOT / "containers" / "graders.Containerfile")[0][1]
# What a build has of this machine: how a registry is reached, where that needs to be said.
FILES = ("/etc/pip.conf", "/etc/ssl/certs/ca-certificates.crt")
REACH = ["--network=host", *(f"-v={file}:{file}:ro" for file in FILES if os.path.exists(file))]
NUMBER = 1000  # of the user in both images
RUN_SECONDS = 300
OPENS = re.compile(r"Open http://127\.0\.0\.1:8888/\S*token=(\w+)")
HOSTILE = ("reads_the_solution", "writes_the_gradebook", "fork_bomb")

pytestmark = [pytest.mark.long, pytest.mark.timeout(3600)]


def podman(*arguments: str, seconds: float = RUN_SECONDS) -> subprocess.CompletedProcess:
    command = ["podman", *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=seconds)


def tried(*arguments: str, seconds: float = RUN_SECONDS) -> str:
    """What a command of podman's printed; it must end well."""
    ran = podman(*arguments, seconds=seconds)
    assert ran.returncode == 0, ran.stdout[-2000:] + ran.stderr[-4000:]
    return ran.stdout


@pytest.fixture(scope="module")
def builds(needs):
    """Podman, which has the base of the images and runs it; else the tests are skipped."""
    needs("podman")
    if podman("image", "exists", BASE).returncode and podman("pull", BASE).returncode:
        pytest.skip(f"no registry gives {BASE} here; it is not part of the project")
    ran = podman("run", "--rm", BASE, "true")
    if ran.returncode:
        pytest.skip(f"podman runs no container here: {ran.stderr.strip()}; not part of the project")


def build(image: str, context: Path) -> str:
    (command,) = page.commands("build", image)
    _, verb, *rest, _ = command.split()
    tried(verb, *REACH, *rest, str(context), seconds=1800)
    return image


@pytest.fixture(scope="module")
def students(builds, tmp_path_factory):
    made = tmp_path_factory.mktemp("made")
    courses.run(ROOT, "autograder", "bundle", P3, "--to", str(made))
    return build("armdyn-students", made)


@pytest.fixture(scope="module")
def graders(builds):
    return build("armdyn-graders", ROOT)


@contextmanager
def running(image: str, *options: str):
    name = f"armdyn-test-{os.getpid()}"
    tried("run", "--detach", "--name", name, *options, image)
    try:
        yield name
    finally:
        podman("rm", "--force", "--time", "5", name)


def test_a_students_image_opens_its_course_keeps_work_and_holds_no_answer(students):
    (command,) = page.commands("run", students)
    port, volume = free_port(), f"armdyn-test-{os.getpid()}"
    published, mounted = re.findall(r"-[pv] \S+", command)
    options = [
        *published.replace("127.0.0.1:8888:", f"127.0.0.1:{port}:").split(),
        *mounted.replace("my-work", volume).split(),
    ]
    try:
        for _ in range(2):  # the second finds what the first one wrote
            with running(students, *options) as name:
                deadline = time.monotonic() + RUN_SECONDS
                address = None
                while address is None and time.monotonic() < deadline:
                    time.sleep(1)
                    address = OPENS.search(tried("logs", name))
                assert address, tried("logs", name)
                asked = f"http://127.0.0.1:{port}/api/contents/problems/{P3}?token={address[1]}"
                with urllib.request.urlopen(asked, timeout=60) as reply:
                    files = [one["name"] for one in json.load(reply)["content"]]
                assert f"{P3}.ipynb" in files
                assert tried("exec", name, "id", "-u").strip() == str(NUMBER)
                tried("exec", name, "sh", "-c", f"echo mine >>armdyn/problems/{P3}/notes.txt")
                written = tried("exec", name, "cat", f"armdyn/problems/{P3}/notes.txt")
                installed = "/usr/local/lib/python*/site-packages/autograder"
                searched = f"grep -rl 'BEGIN SOLUTION' /home {installed}; ls /tmp/made"
                assert podman("exec", name, "sh", "-c", searched).stdout == ""
        assert written == "mine\nmine\n"
    finally:
        podman("volume", "rm", volume)


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A course with one right submission and three hostile ones, which its container's user owns."""
    root = courses.new_course(tmp_path / "course")
    monkeypatch.setattr(hostile_judge, "ROOT", Path("/course"))
    courses.submit(root, "right", p3_pendulum.right(courses.release(root)))
    for name in HOSTILE:
        courses.submit(root, name, hostile.ATTACKS[name].edit(courses.release(root)))
    if os.geteuid() == 0:
        subprocess.run(["chown", "--recursive", str(NUMBER), root], check=True)
        tmp_path.chmod(0o755)
    return root


def graded(root: Path, without: str = "") -> subprocess.CompletedProcess:
    """Grade by the page's command for Podman, without one of its flags."""
    command, _ = page.commands("run", "armdyn-graders")
    assert without in command
    command = command.replace(f"--security-opt {without} ", "").replace(" -it ", " ")
    words = command.replace('"$PWD"', str(root)).split()[1:]
    if os.geteuid() == 0:  # for whom Podman maps no numbers
        words = [word for word in words if not word.startswith("--userns")]
    return podman(*words)


def test_with_the_pages_flags_the_sandbox_keeps_hostile_code_in(graders, course):
    ran = graded(course)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert "bubblewrap does not work here" not in ran.stderr
    assert re.search(r"^right +10 of 15 ", ran.stdout, re.M), ran.stdout
    for name in HOSTILE:
        assert re.search(rf"^{name} +8 of 15 ", ran.stdout, re.M), ran.stdout


def test_without_a_flag_the_grader_says_which_one_is_missing(graders, course):
    ran = graded(course, "unmask=ALL")
    assert "bubblewrap does not work here (bwrap: Can't mount proc" in ran.stderr
    assert "Start it with --security-opt unmask=ALL (Podman)" in ran.stderr
    assert refusal.PAGE in ran.stderr


def test_the_graders_image_runs_as_an_ordinary_user_and_has_no_compiler(graders):
    said = tried(
        "run", "--rm", graders, "sh", "-c", "id -u; pwd; ls /tmp/made; which cc g++ || true"
    )
    assert said.split() == [str(NUMBER), "/course"]
