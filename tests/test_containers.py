"""The container files by what they do: their steps, followed in a folder with stand-ins for programs."""

import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
import zipfile
from fnmatch import fnmatch
from pathlib import Path

import pytest

from tests.class_server.document import PAGE

ROOT = Path(__file__).parents[1]
FILES = sorted((ROOT / "containers").glob("*.Containerfile"))
PROGRAMS = ("apt-get", "autograder", "python", "useradd")
IGNORED = (ROOT / ".dockerignore").read_text(encoding="utf-8").splitlines()[1:]

pytestmark = pytest.mark.skipif(os.name == "nt", reason="an image is of Linux")


class Stage:
    """One image as its file makes it: a folder as its root, and the commands that it ran."""

    def __init__(self, root: Path, base: str):
        self.root, self.base = root, base
        self.work, self.user, self.command = "/", "root", []
        self.ran: list[str] = []

    def here(self, path: str) -> Path:
        """Where a path of the image is; one that is relative begins where the image works."""
        return self.root / os.path.join(self.work, path).lstrip("/")

    def copy(self, sources: list[Path], target: str) -> None:
        for source in sources:
            to = self.here(target)
            to = to / source.name if target.endswith("/") else to
            to.parent.mkdir(parents=True, exist_ok=True)
            if source.is_dir():
                outside = source.is_relative_to(ROOT)  # what an image has, it keeps
                shutil.copytree(source, to, dirs_exist_ok=True, ignore=ignored if outside else None)
            else:
                shutil.copy(source, to)

    def run(self, script: str, stand_ins: Path) -> None:
        """Run a command, whose programs only write down how they were called."""
        self.here(".").mkdir(parents=True, exist_ok=True)
        told = self.root / "told"
        environment = {"PATH": f"{stand_ins}:/usr/bin:/bin", "TOLD": str(told)}
        script = script.replace("/var/", f"{self.root}/var/").replace("/tmp/", f"{self.root}/tmp/")
        subprocess.run(["sh", "-euc", script], cwd=self.here("."), env=environment, check=True)
        if told.exists():
            self.ran += told.read_text().splitlines()
            told.unlink()


def ignored(folder: str, names: list[str]) -> list[str]:
    return [n for n in names if any(fnmatch(n, rule.removeprefix("**/")) for rule in IGNORED)]


def steps(path: Path) -> list[tuple[str, str]]:
    """The instructions of a file, and what each is given."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return [tuple(line.split(" ", 1)) for line in lines if line and not line.startswith("#")]


def built(path: Path, folder: Path) -> list[Stage]:
    """Every stage of a file, followed to its end."""
    stand_ins = folder / "bin"
    stand_ins.mkdir()
    for program in PROGRAMS:
        (stand_ins / program).write_text(f'#!/bin/sh\necho "{program} $*" >>"$TOLD"\n')
        (stand_ins / program).chmod(0o755)
    # What it writes, other tests know; here it is enough that it has been there.
    with zipfile.ZipFile(folder / "made.zip", "w") as archive:
        for name in ("armdyn-1.0+0-py3-none-any.whl", "constraints.txt", "lessons/a", "problems/a"):
            archive.writestr(f"armdyn/{name}", "")
    with (stand_ins / "autograder").open("a") as file:
        file.write(f'[ "$1 $2" = "bundle --to" ] && mkdir -p "$3" && cp {folder}/made.zip "$3"\n')
    with (stand_ins / "python").open("a") as file:
        file.write(f'[ "$2" != zipfile ] || exec {sys.executable} "$@"\n')
    stages: dict[str, Stage] = {}
    for number, (instruction, given) in enumerate(steps(path)):
        if instruction == "FROM":
            base, _, name = given.partition(" AS ")
            stage = stages[name] = Stage(folder / f"stage-{number}", base)
        elif instruction == "COPY":
            options = dict(re.findall(r"--(\w+)=(\S+)", given))
            *sources, target = re.sub(r"--\w+=\S+ ", "", given).split()
            origin = stages[options["from"]] if "from" in options else None
            found = [origin.here(s) if origin else ROOT / s for s in sources]
            stage.copy(found, target)
        elif instruction == "RUN":
            stage.run(given, stand_ins)
        elif instruction == "WORKDIR":
            stage.work = given
        elif instruction == "USER":
            stage.user = given
        elif instruction == "CMD":
            stage.command = json.loads(given)
        else:
            assert instruction == "EXPOSE", f"{instruction} is not followed here"
    return list(stages.values())


@pytest.fixture(params=FILES, ids=lambda path: path.stem)
def image(request, tmp_path):
    return request.param.stem, built(request.param, tmp_path)


def test_there_is_one_for_students_and_one_for_graders():
    assert [path.stem for path in FILES] == ["graders", "students"]


def test_what_is_installed_is_pinned_and_the_user_is_not_root(image):
    _, stages = image
    installed = [line for stage in stages for line in stage.ran if line.startswith("python -m pip")]
    assert installed
    for install in installed:
        assert install.startswith("python -m pip install --no-cache-dir -c constraints.txt .")
    assert stages[-1].user != "root"
    assert any(f"useradd --create-home --uid 1000 {stages[-1].user}" == r for r in stages[-1].ran)


def test_the_base_is_a_python_that_the_course_runs_on(image):
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    oldest = project["requires-python"].removeprefix(">=")
    bases = {stage.base for stage in image[1]}
    assert bases == {f"docker.io/library/python:{oldest}-slim"}


def test_a_students_image_holds_no_solution_and_nothing_of_the_class(image):
    name, stages = image
    files = {path.relative_to(stages[-1].root).as_posix() for path in stages[-1].root.rglob("*")}
    assert not [file for file in files if "solutions" in file or "/course/course" in file]
    if name == "students":
        course = stages[-1].here(".")
        (wheel,) = course.glob("*.whl")
        assert {path.name for path in course.iterdir()} == {
            *(wheel.name, "constraints.txt", "lessons", "problems")
        }
        (install,) = [line for line in stages[-1].ran if line.startswith("python")]
        assert install.endswith(f" ./{wheel.name}[lab]")
        assert not [file for file in files if file.startswith(("usr/local", "course"))]
        assert stages[-1].command[:2] == ["autograder", "lab"]


def test_the_graders_have_the_sandboxs_program_and_work_where_the_course_is_mounted(image):
    name, stages = image
    if name == "graders":
        assert any("install" in line and "bubblewrap" in line for line in stages[-1].ran)
        assert stages[-1].work == "/course"
        assert '-v "$PWD":/course' in PAGE.read_text(encoding="utf-8")


def test_peoples_work_stays_out_of_the_build():
    work = (ROOT / ".gitignore").read_text(encoding="utf-8").partition("never commit")[2]
    folders = re.findall(r"^/(\w+)/$", work, re.M)
    assert len(folders) == 4
    assert set(folders) <= set(IGNORED)
