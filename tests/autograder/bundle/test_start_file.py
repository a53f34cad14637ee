"""start.py, as a student's first command: what it installs and starts, and what it says if it cannot."""

import importlib.util
import re
import shutil
import subprocess
import sys

import pytest


@pytest.fixture
def folder(installed, tmp_path):
    """A folder with an archive's start.py, which has installed the course in it."""
    folder = tmp_path / "a student's folder [1]"
    folder.mkdir()
    (wheel,) = installed.folder.glob("*.whl")
    for path in (wheel, installed.folder / "start.py"):
        shutil.copy(path, folder)
    (folder / "lessons").mkdir()
    environment = installed.python.parents[1]
    (folder / ".venv" / "bin").mkdir(parents=True)
    (folder / ".venv" / "bin" / "python").symlink_to(installed.python.resolve())
    (folder / ".venv" / "lib").symlink_to(environment / "lib")
    shutil.copy(environment / "pyvenv.cfg", folder / ".venv")
    (folder / ".venv" / "installed.txt").write_text(wheel.name)
    return folder


def test_it_starts_what_it_has_installed(installed, folder):
    """Also in a folder that was moved since: there, no command of .venv finds its Python."""
    (folder / ".venv" / "bin" / "autograder").write_text("#!/where it was/.venv/bin/python\n")
    quick = {"PIP_NO_INDEX": "1"}  # to fail, if it installs
    done = installed.run("start.py", "--version", cwd=folder, env=quick)
    assert re.fullmatch(r"\d+\.\d+.*", done.stdout.strip())
    (wheel,) = folder.glob("*.whl")
    said = (installed.folder / "START-HERE.txt").read_text()
    assert f'uvx --from "{wheel.name}[lab]" autograder lab' in said
    wheel.unlink()
    done = installed.run("start.py", cwd=folder, check=False)
    assert (done.returncode, f"{wheel.name}, is not beside" in done.stdout) == (1, True)


@pytest.fixture
def ran(folder, monkeypatch):
    """Runs start.py of the folder in this process; the commands that it called, which did nothing.

    failing: what is in those that fail.
    """
    spec = importlib.util.spec_from_file_location("start", folder / "start.py")
    start = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(start)
    real = subprocess.run

    def run(failing="nothing"):
        calls = []

        def called(command, **options):
            if command[1:] == ["-c", ""]:
                return real(command, **options)
            calls.append(command)
            return subprocess.CompletedProcess(command, int(failing in command))

        monkeypatch.setattr(subprocess, "run", called)
        monkeypatch.setattr(sys, "argv", ["start.py"])
        status = start.main()
        monkeypatch.undo()
        return status, calls

    return run


def test_a_second_archive_in_the_same_folder_is_installed(folder, ran):
    """Both wheels have the same time, as a zip file's have: its own name tells which is the new one."""
    (wheel,) = folder.glob("*.whl")
    older = folder / "armdyn-1.0.0+00000000-py3-none-any.whl"
    shutil.copy2(wheel, older)
    (folder / ".venv" / "installed.txt").write_text(older.name)
    status, (install, lab) = ran()
    assert (status, install[-1], lab[-1]) == (0, f"{wheel.name}[lab]", "lab")
    assert (folder / ".venv" / "installed.txt").read_text() == wheel.name
    assert ran() == (0, [lab])


@pytest.mark.parametrize("lacks", ["its Python", "what an interrupted installation lacks"])
def test_a_broken_environment_is_made_anew(folder, ran, lacks):
    if lacks == "its Python":
        (folder / ".venv" / "bin" / "python").unlink()
        (folder / ".venv" / "bin" / "python").symlink_to("/gone/python3")
    else:
        (folder / ".venv" / "installed.txt").unlink()
    status, (make, install, _) = ran()
    assert (status, make[1:4], "pip" in install) == (0, ["-m", "venv", "--clear"], True)


@pytest.mark.parametrize(
    ("failing", "said"),
    [("venv", "Can you write into this folder"), ("pip", "Is the network there?")],
)
def test_it_says_what_failed_and_starts_nothing(folder, ran, capsys, failing, said):
    (folder / ".venv" / "bin" / "python").unlink()
    status, calls = ran(failing)
    assert (status, failing in calls[-1]) == (1, True)
    assert said in capsys.readouterr().out
