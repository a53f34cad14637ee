"""Opens the course: installs it into .venv the first time, then starts JupyterLab."""

import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
WHEEL_NAME = "WHEEL"


def main() -> int:
    if sys.version_info < (3, 11):
        print("start.py: this needs Python 3.11 or newer; you have", sys.version.split()[0])
        return 1
    folder = HERE / ".venv" / ("Scripts" if os.name == "nt" else "bin")
    done = HERE / ".venv" / "installed.txt"
    try:
        if not done.is_file() or done.read_text(encoding="utf-8") != WHEEL_NAME:
            print(
                "Installing the course into .venv; the first time takes some minutes.", flush=True
            )
            subprocess.run([sys.executable, "-m", "venv", str(HERE / ".venv")], check=True)
            install = [str(folder / "python"), "-m", "pip", "install", "--quiet", "--upgrade"]
            pins = ["-c", "constraints.txt"] if (HERE / "constraints.txt").is_file() else []
            subprocess.run([*install, *pins, f"{HERE / WHEEL_NAME}[lab]"], cwd=HERE, check=True)
            done.write_text(WHEEL_NAME, encoding="utf-8")
    except (OSError, subprocess.CalledProcessError) as error:
        print(f"start.py: installing failed: {error}. Is the network there?")
        return 1
    try:
        command = [str(folder / "autograder"), "lab", *sys.argv[1:]]
        return subprocess.run(command, cwd=HERE, check=False).returncode
    except KeyboardInterrupt:
        return 0


if __name__ == "__main__":
    sys.exit(main())
