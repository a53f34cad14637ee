"""Opens the course: installs it into .venv the first time, then starts JupyterLab."""

import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
WHEEL = HERE / "{wheel}"
VENV = HERE / ".venv"
PYTHON = VENV / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
INSTALLED = VENV / "installed.txt"
# Not by the command in .venv, which knows its folder by a path that ends when the folder is moved.
COMMAND = "import sys; from autograder.cli import main; sys.exit(main())"


def main() -> int:
    if sys.version_info < (3, 11):
        print("start.py: this needs Python 3.11 or newer; you have", sys.version.split()[0])
        return 1
    if not WHEEL.is_file():
        print("start.py: the course's package,", WHEEL.name + ", is not beside this file")
        return 1
    try:
        before = INSTALLED.read_text() if INSTALLED.is_file() and _runs() else ""
        if before != WHEEL.name and (failed := _install(again=bool(before))):
            print("start.py:", failed)
            return 1
        command = [str(PYTHON), "-c", COMMAND, "lab", *sys.argv[1:]]
        return subprocess.run(command, cwd=HERE).returncode
    except KeyboardInterrupt:
        return 0


def _runs() -> bool:
    """Whether the Python that .venv was made of is still on this machine."""
    try:
        return subprocess.run([str(PYTHON), "-c", ""], capture_output=True).returncode == 0
    except OSError:
        return False


def _install(again: bool) -> str:
    """Install the course; what failed, if something did. again: whether .venv is kept."""
    print("Installing the course into .venv; the first time takes some minutes.", flush=True)
    make = [sys.executable, "-m", "venv", "--clear", str(VENV)]
    if not again and subprocess.run(make).returncode:
        return (
            f"no .venv could be made in {HERE}. Can you write into this folder, and has this Python its "
            "venv (on Debian and Ubuntu: apt install python3-venv)?"
        )
    install = [str(PYTHON), "-m", "pip", "install", "--quiet", "--upgrade"]
    pins = ["-c", "constraints.txt"] if (HERE / "constraints.txt").is_file() else []
    if subprocess.run([*install, *pins, WHEEL.name + "[lab]"], cwd=HERE).returncode:
        return "installing failed, as pip says above. Is the network there?"
    try:
        INSTALLED.write_text(WHEEL.name)
    except OSError as error:
        return f"{INSTALLED} cannot be written: {error}"
    return ""


if __name__ == "__main__":
    sys.exit(main())
