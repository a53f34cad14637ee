"""course/ is closed to the machine's other accounts, or the instructor is told."""

import os
import shutil
import stat
import subprocess
import tempfile
from contextlib import suppress
from pathlib import Path

import pytest

from autograder.cli import main
from autograder.nbgrader_glue import make_private
from tests.autograder import courses
from tests.autograder.courses import P3
from tests.autograder.nbgrader_glue.accounts import acting_as, needs_root

pytestmark = pytest.mark.skipif(os.name == "nt", reason="Windows has no such permissions")


def test_a_new_folder_is_the_owners_alone(tmp_path, capsys):
    make_private(tmp_path / "course")
    assert stat.S_IMODE((tmp_path / "course").stat().st_mode) == 0o700
    assert capsys.readouterr().err == ""


@pytest.fixture
def open_folder():
    """A folder that everybody can enter; those of pytest are closed."""
    with tempfile.TemporaryDirectory(prefix="open-") as folder:
        os.chmod(folder, 0o755)
        yield Path(folder)


@pytest.mark.parametrize(
    ("mode", "above", "told"),
    [
        (0o755, 0o755, True),
        (0o701, 0o711, True),
        (0o750, 0o755, False),
        (0o2770, 0o755, False),
        (0o755, 0o700, False),
    ],
)
def test_the_instructor_is_told_where_others_can_enter(mode, above, told, open_folder, capsys):
    folder = open_folder / "in" / "course"
    folder.mkdir(parents=True)
    folder.chmod(mode)
    folder.parent.chmod(above)
    make_private(folder)
    assert stat.S_IMODE(folder.stat().st_mode) == mode
    assert (f"chmod o-rwx {folder}" in capsys.readouterr().err) == told


def test_the_command_to_close_it_can_be_pasted(open_folder, capsys):
    folder = open_folder / "Übung Robotik #1" / "course"
    folder.mkdir(parents=True)
    folder.chmod(0o755)
    make_private(folder)
    command = capsys.readouterr().err.partition("To close it: ")[2]
    subprocess.run(["sh", "-c", command], check=True)
    assert stat.S_IMODE(folder.stat().st_mode) == 0o750


@needs_root
@pytest.mark.parametrize("command", ["grade p3-pendulum", "problems", "export", "mark"])
def test_another_account_is_told_whose_the_course_is(command, open_folder, capsys, monkeypatch):
    (open_folder / "nbgrader_config.py").write_text(
        (courses.ROOT / "nbgrader_config.py").read_text()
    )
    (open_folder / "course").mkdir(mode=0o700)
    shutil.chown(open_folder / "course", "games")
    monkeypatch.chdir(open_folder)
    with acting_as("mail"):
        assert main(command.split()) == 2
        with suppress(PermissionError):
            make_private(open_folder / "course")
    said = capsys.readouterr().err.splitlines()
    whose = f"{open_folder / 'course'}, which belongs to the account games"
    assert [whose in line for line in said] == [True, True], said


def test_nbgrader_makes_the_course_closed_and_warns_where_it_is_open(open_folder):
    root = courses.new_course(open_folder / "there")
    assert stat.S_IMODE((root / "course").stat().st_mode) == 0o700
    for path in (root, root / "course"):
        path.chmod(0o755)
    said = courses.run(root, "nbgrader", "release_assignment", P3)
    assert said.count(f"chmod o-rwx {root / 'course'}") == 1
