"""One archive for all of these tests, made by the command; and a fresh environment that has it."""

import os
import shutil
import subprocess
import sys
import sysconfig
import zipfile
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.once import made_once

ROOT = Path(__file__).parents[3]


@dataclass(frozen=True)
class Installed:
    """archive: the zip file. folder: where a student has unpacked it. python: of the environment."""

    archive: Path
    folder: Path
    python: Path

    def run(self, *arguments: str, **options) -> subprocess.CompletedProcess:
        """Run this Python from the student's folder, with nothing of ours around it."""
        home = self.folder.parent / "home"
        home.mkdir(exist_ok=True)
        kept = {name: os.environ[name] for name in ("PATH", "LANG") if name in os.environ}
        options = {"cwd": self.folder, "check": True, **options}
        return subprocess.run(
            [self.python, *arguments], capture_output=True, text=True,
            env=kept | {"HOME": str(home), **options.pop("env", {})}, **options,
        )  # fmt: skip


@pytest.fixture(scope="session")
def installed() -> Installed:
    top = made_once("bundle", _make)
    (archive,) = (top / "archive").iterdir()
    return Installed(archive, top / "armdyn", top / "env" / "bin" / "python")


def _make(top: Path) -> None:
    command = [Path(sys.executable).parent / "autograder", "bundle", "--to", top / "archive"]
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True)
    (archive,) = (top / "archive").iterdir()
    with zipfile.ZipFile(archive) as packed:
        packed.extractall(top)
    (wheel,) = (top / "armdyn").glob("*.whl")
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", top / "env"], check=True)
    # Its packages are ours, but for the course: no line of another .pth file is followed.
    (site,) = (top / "env" / "lib").glob("*/site-packages")
    (site / "packages.pth").write_text(sysconfig.get_paths()["purelib"])
    install = ["-m", "pip", "--python", top / "env" / "bin" / "python", "install", "--quiet"]
    subprocess.run(
        [sys.executable, *install, "--no-deps", "--no-index", wheel],
        check=True,
        capture_output=True,
    )
    shutil.rmtree(top / "env" / "lib64", ignore_errors=True)
