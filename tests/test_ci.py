"""What `.ci/run` leaves out on the plain machine; and `.ci/nightly`, in a repository whose Makefile only
says what it was asked for.
"""

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
MAKEFILE = """\
test-all rehearse:
\t@echo "$@ in $(CURDIR), CI=$$CI"; touch "$$TMPDIR/course-of-$@"; test ! -e {failing}-$@
"""
SECONDS = 60.0


class Host:
    """A machine with all packages: its checkout, and its folder for temporary files."""

    def __init__(self, root: Path):
        self.checkout, self.temporary = root / "armdyn", root / "tmp"
        self.temporary.mkdir()
        shutil.copytree(ROOT / ".ci", self.checkout / ".ci")
        (self.checkout / "Makefile").write_text(MAKEFILE.format(failing=root / "failing"))
        # Root installs the class server by what this prints.
        installer = self.checkout / "tests" / "class_server" / "document.py"
        installer.parent.mkdir(parents=True)
        installer.write_text("print('true')\n")
        self.git("init", "--quiet")
        self.git("add", ".")
        self.git("-c", "user.name=x", "-c", "user.email=x", "commit", "--quiet", "-m", "All")
        programs = root / "bin"
        programs.mkdir()
        for name, does in {"dpkg-query": "echo install ok installed", "npm": ":"}.items():
            (programs / name).write_text(f"#!/bin/sh\n{does}\n")
            (programs / name).chmod(0o755)
        self.environment = os.environ | {
            "PATH": f"{programs}{os.pathsep}{os.environ['PATH']}",
            "TMPDIR": str(self.temporary),
        }

    def git(self, *arguments: str) -> None:
        subprocess.run(["git", *arguments], cwd=self.checkout, check=True, timeout=SECONDS)

    def night(self) -> tuple[int, list[str]]:
        """The exit status, and the lines that were printed."""
        ran = subprocess.run(
            [self.checkout / ".ci" / "nightly"],
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=SECONDS,
        )
        return ran.returncode, ran.stdout.splitlines()


@pytest.fixture
def host(needs, tmp_path):
    needs("make")
    if not shutil.which("git"):
        pytest.skip("needs git: apt install git")
    return Host(tmp_path)


def test_a_night_runs_all_tests_and_the_rehearsal_in_a_fresh_clone_and_leaves_nothing(host):
    (host.checkout / "Makefile").write_text("test-all rehearse:\n\t@echo not committed; exit 1\n")
    status, printed = host.night()
    ran = [line for line in printed if " in /" in line]
    assert [line.split()[0] for line in ran] == ["test-all", "rehearse"]
    assert all("CI=true" in line and str(host.checkout) not in line for line in ran)
    assert printed[-1] == "make test-all: passed, 0 min; make rehearse: passed, 0 min"
    assert status == 0
    assert [path.name for path in host.temporary.iterdir()] == ["course-of-test-all"]


@pytest.mark.parametrize(
    ("failing", "last"),
    [
        ("test-all", "make test-all: failed (exit status 2), 0 min; make rehearse: passed, 0 min"),
        ("rehearse", "make test-all: passed, 0 min; make rehearse: failed (exit status 2), 0 min"),
    ],
)
def test_whichever_fails_both_run_and_the_last_line_says_so(host, failing, last):
    (host.temporary.parent / f"failing-{failing}").touch()
    status, printed = host.night()
    assert printed[-1] == last
    assert status == 1
    kept = list(host.temporary.glob("nightly-*/course-of-rehearse"))
    assert len(kept) == (failing == "rehearse")  # to look into


def test_the_makefile_has_what_the_night_asks_for():
    targets = (ROOT / "Makefile").read_text(encoding="utf-8")
    assert "\ntest-all:" in targets
    assert "\nrehearse:" in targets


@pytest.mark.skipif(not shutil.which("bash"), reason="needs bash: apt install bash")
def test_the_plain_machine_runs_all_that_may_end_otherwise_there():
    text = (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    lists = re.findall(r"^\w+=\(\n.*?^\)$", text, re.M | re.S)
    assert len(lists) == 2
    script = "\n".join(["shopt -s extglob", *lists, "printf '%s\\n' ${computed[@]} ${started[@]}"])
    listed = subprocess.run(
        ["bash", "-euc", script],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
        timeout=SECONDS,
    ).stdout.split()
    missing = [path for path in listed if not (ROOT / path).exists()]
    assert missing == [], "these have another name now, and would be run twice"
    tests = ROOT / "tests"
    left_out = {(ROOT / path).relative_to(tests).as_posix() for path in listed}
    for kept in ("guide", "autograder/sandbox", "autograder/notebook", "autograder/pipeline",
                 "autograder/protocol", "autograder/student", "autograder/bundle/test_student.py",
                 "autograder/nbgrader_glue/test_nbgrader.py", "armdyn/test_codegen_numpy.py",
                 "test_readme.py"):  # fmt: skip
        assert (tests / kept).exists()
        assert not left_out & {kept, *(str(parent) for parent in Path(kept).parents)}, kept
