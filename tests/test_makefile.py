"""What `make lab` does before it installs anything: it finds a Python, or says in one line why not."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


class Machine:
    """A checkout on a machine whose only programs are make, a shell's, and the Pythons put there."""

    def __init__(self, root: Path, make: str):
        self.checkout = root / "a checkout, größer"
        self.checkout.mkdir()
        self.bin = root / "bin"
        self.bin.mkdir()
        for name in ("Makefile", "pyproject.toml", "constraints.txt"):
            shutil.copy(ROOT / name, self.checkout)
        for program in (
            make,
            *map(shutil.which, ("sh", "cat", "touch", "grep", "tail", "mkdir", "cp")),
        ):
            (self.bin / Path(program).name).symlink_to(program)

    def python(self, name="python3", version="3.12.0", old=False, venv=True, broken=False):
        """A stand-in that answers what the Makefile asks of a Python, and installs nothing."""
        path = self.bin / name
        path.write_text(
            f"""#!/bin/sh
case "$*" in
  --version) echo "Python {version}" ;;
  *version_info*) exit {int(old)} ;;
  *ensurepip*) exit {int(not venv)} ;;
  "-m venv"*) mkdir -p .venv/bin; cp "$0" .venv/bin/python; echo "venv of {name}" >>made ;;
  *pip*) echo "$*" >>made; echo "ERROR: no such thing"; exit {int(broken)} ;;
esac
"""
        )
        path.chmod(0o755)

    def make(self, *arguments: str, **environment: str) -> subprocess.CompletedProcess:
        return subprocess.run(
            [self.bin / "make", *arguments],
            cwd=self.checkout,
            env={"PATH": str(self.bin), "HOME": str(self.checkout)} | environment,
            capture_output=True,
            text=True,
        )

    def made(self) -> list[str]:
        made = self.checkout / "made"
        return made.read_text().splitlines() if made.exists() else []


@pytest.fixture
def machine(needs, tmp_path):
    return Machine(tmp_path, needs("make"))


def refusal(result: subprocess.CompletedProcess) -> str:
    """The one line that says why, before make's own line about a target that failed."""
    assert result.returncode != 0
    why, own = result.stderr.splitlines()
    assert own.startswith("make: ***")
    return why


def test_no_python(machine):
    assert "Python 3.11 or newer, with venv, is needed" in refusal(machine.make("lab"))


def test_old_python(machine):
    machine.python(version="3.10.13", old=True)
    assert "python3 is Python 3.10.13" in refusal(machine.make("lab"))


def test_python_without_venv(machine):
    machine.python(venv=False)
    assert "python3 lacks venv (Debian, Ubuntu: apt install python3-venv)" in refusal(
        machine.make("lab")
    )


def test_named_python_that_is_not_there(machine):
    machine.python()
    assert "/no/python does not run" in refusal(machine.make("lab", "PYTHON=/no/python"))
    assert "/no/python does not run" in refusal(machine.make("lab", PYTHON="/no/python"))
    assert machine.made() == []


def test_first_python_that_is_fit_is_taken(machine):
    machine.python("python3", version="3.9.2", old=True)
    machine.python("python3.13", venv=False)
    machine.python("python3.12")
    machine.make(".venv/lab.done")
    assert machine.made()[0] == "venv of python3.12"


def test_failed_installation_is_one_line(machine):
    machine.python(broken=True)
    why = refusal(machine.make(".venv/lab.done"))
    assert "installing failed" in why
    assert ".venv/install.log: ERROR: no such thing" in why
    assert "ERROR: no such thing" in (machine.checkout / ".venv" / "install.log").read_text()
    assert not (machine.checkout / ".venv" / "lab.done").exists()


def test_installs_once_from_the_constraints(machine):
    machine.python()
    assert machine.make("-j4", ".venv/test.done").returncode == 0
    _, lab, test = machine.made()
    assert lab.endswith("install -c constraints.txt -e .[lab]")
    assert test.endswith("install -c constraints.txt -e .[test]")
    machine.make(".venv/test.done")
    assert len(machine.made()) == 3


def test_installs_again_when_the_pins_change(machine):
    machine.python()
    machine.make(".venv/lab.done")
    done = (machine.checkout / ".venv" / "lab.done").stat().st_mtime
    os.utime(machine.checkout / "constraints.txt", (done + 10, done + 10))
    machine.make(".venv/lab.done")
    assert [line.split()[0] for line in machine.made()] == ["venv", "-m", "-m"]


def test_moved_checkout_gets_a_new_environment(machine):
    machine.python()
    machine.make(".venv/lab.done")
    machine.checkout = machine.checkout.rename(machine.checkout.with_name("moved"))
    machine.make(".venv/lab.done")
    assert [line.split()[0] for line in machine.made()] == ["venv", "-m"] * 2


def test_what_fails_keeps_nothing_else_from_running(machine):
    machine.python()
    assert machine.make(".venv/test.done").returncode == 0
    with (machine.checkout / ".venv" / "bin" / "python").open("a") as python:
        python.write('case "$*" in *pytest*) echo "$*" >>made; exit 1 ;; esac\n')
    result = machine.make("test", "ARGS=-k chain")  # there is no ruff
    assert result.returncode != 0
    assert "-m pytest --nbval" in machine.made()[-1]
    assert machine.made()[-1].endswith("tests lessons solutions -k chain")
    assert "make test: failed: ruff pytest" in result.stderr


@pytest.mark.parametrize(
    ("ruff", "mypy", "failed"),
    [(0, 0, ""), (1, 0, "ruff"), (0, 1, "mypy"), (1, 1, "ruff mypy")],
)
def test_lint_runs_both_to_the_end_and_says_which_failed(machine, ruff, mypy, failed):
    machine.python()
    assert machine.make(".venv/test.done").returncode == 0
    programs = machine.checkout / ".venv" / "bin"
    (programs / "ruff").write_text(f'#!/bin/sh\necho "ruff $*" >>made\nexit {ruff}\n')
    (programs / "ruff").chmod(0o755)
    with (programs / "python").open("a") as python:
        python.write(f'case "$*" in *mypy*) echo "$*" >>made; exit {mypy} ;; esac\n')
    result = machine.make("lint")
    assert machine.made()[-2] == "-m mypy"
    assert machine.made()[-1].startswith("-m mypy autograder/sandbox/inside/")
    assert "ruff check" in machine.made()
    assert (result.returncode == 0) == (not failed)
    assert (f"make lint: failed: {failed}\n" if failed else "") in result.stderr
    assert ("failed:" in result.stderr) == bool(failed)


def test_coverage_is_reported_though_a_test_failed(machine):
    machine.python()
    assert machine.make(".venv/dev.done").returncode == 0
    assert machine.made()[-1].endswith("install -c constraints.txt -e .[dev]")
    with (machine.checkout / ".venv" / "bin" / "python").open("a") as python:
        python.write('echo "$*" >>made; case "$*" in *pytest*) exit 1 ;; esac\n')
    result = machine.make("coverage")
    assert result.returncode != 0
    assert machine.made()[-1] == "-m coverage report"
    assert result.stderr.startswith("make coverage: failed: pytest\n")


def test_no_target_removes_anything():
    recipes = (ROOT / "Makefile").read_text()
    assert "clean:" not in recipes
    assert "rm " not in recipes
