"""Opens the course: installs it into .venv the first time, then starts JupyterLab."""

import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent


def main() -> int:
    if sys.version_info < (3, 11):
        print("start.py: this needs Python 3.11 or newer; you have", sys.version.split()[0])
        return 1
    wheel = max(HERE.glob("armdyn-*.whl"), key=lambda path: path.stat().st_mtime, default=None)
    if wheel is None:
        print("start.py: the course's package, armdyn-….whl, is not beside this file")
        return 1
    folder = HERE / ".venv" / ("Scripts" if os.name == "nt" else "bin")
    done = HERE / ".venv" / "installed.txt"
    try:
        if not done.is_file() or done.read_text(encoding="utf-8") != wheel.name:
            print(
                "Installing the course into .venv; the first time takes some minutes.", flush=True
            )
            subprocess.run([sys.executable, "-m", "venv", str(HERE / ".venv")], check=True)
            install = [str(folder / "python"), "-m", "pip", "install", "--quiet", "--upgrade"]
            pins = ["-c", "constraints.txt"] if (HERE / "constraints.txt").is_file() else []
            subprocess.run([*install, *pins, f"{wheel}[lab]"], cwd=HERE, check=True)
            done.write_text(wheel.name, encoding="utf-8")
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
