"""A container file, followed step by step in a folder, with stand-ins for what installs."""

import json
import os
import re
import shutil
import subprocess
import sys
from fnmatch import fnmatch
from pathlib import Path

ROOT = Path(__file__).parents[2]
FILES = sorted((ROOT / "containers").glob("*.Containerfile"))
PROGRAMS = ("apt-get", "install", "python", "useradd")
IGNORED = (ROOT / ".dockerignore").read_text(encoding="utf-8").splitlines()[1:]


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
                shutil.copytree(source, to, dirs_exist_ok=True, ignore=_ignored)
            else:
                shutil.copy(source, to)

    def run(self, script: str, stand_ins: Path) -> None:
        """Run a command, whose programs only write down how they were called."""
        self.here(".").mkdir(parents=True, exist_ok=True)
        told = self.root / "told"
        environment = {"PATH": f"{stand_ins}:/usr/bin:/bin", "TOLD": str(told)}
        script = script.replace("/var/", f"{self.root}/var/")
        subprocess.run(["sh", "-ec", script], cwd=self.here("."), env=environment, check=True)
        if told.exists():
            self.ran += told.read_text().splitlines()
            told.unlink()

    @property
    def files(self) -> list[str]:
        """The files that the steps of this stage leave, by their paths in the image."""
        found = (path for path in self.root.rglob("*") if path.is_file())
        return sorted(path.relative_to(self.root).as_posix() for path in found)


def _ignored(folder: str, names: list[str]) -> list[str]:
    return [n for n in names if any(fnmatch(n, rule.removeprefix("**/")) for rule in IGNORED)]


def steps(path: Path) -> list[tuple[str, str]]:
    """The instructions of a file, and what each is given."""
    lines = path.read_text(encoding="utf-8").splitlines()
    split = (line.partition(" ") for line in lines if line and not line.startswith("#"))
    return [(instruction, given) for instruction, _, given in split]


def followed(path: Path, context: Path, folder: Path) -> list[Stage]:
    """Every stage of a file, followed to its end. context: the folder that it is built in."""
    stand_ins = folder / "bin"
    stand_ins.mkdir()
    for program in PROGRAMS:
        (stand_ins / program).write_text(f'#!/bin/sh\necho "{program} $*" >>"$TOLD"\n')
        (stand_ins / program).chmod(0o755)
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
            origin = stages[options["from"]].root if "from" in options else context
            found = [(source, sorted(origin.glob(source.lstrip("/")))) for source in sources]
            missing = [source for source, paths in found if not paths]
            assert not missing, f"{path.name} copies {missing}, which are not there"
            stage.copy([one for _, paths in found for one in paths], target)
        elif instruction == "RUN":
            stage.run(given, stand_ins)
        elif instruction == "WORKDIR":
            stage.work = given
        elif instruction == "USER":
            stage.user = given
        elif instruction == "CMD":
            stage.command = json.loads(given)
        else:
            assert instruction in ("ARG", "ENV", "EXPOSE", "STOPSIGNAL"), (
                f"{instruction} is not followed here"
            )
    return list(stages.values())
