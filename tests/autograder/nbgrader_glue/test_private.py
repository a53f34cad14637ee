"""course/ is closed to the machine's other accounts, or the instructor is told."""

import os
import stat

import pytest

from autograder.nbgrader_glue import make_private
from tests.autograder import courses
from tests.autograder.courses import P3

pytestmark = pytest.mark.skipif(os.name == "nt", reason="Windows has no such permissions")


def test_a_new_folder_is_the_owners_alone(tmp_path, capsys):
    make_private(tmp_path / "course")
    assert stat.S_IMODE((tmp_path / "course").stat().st_mode) == 0o700
    assert capsys.readouterr().err == ""


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
def test_the_instructor_is_told_where_others_can_enter(mode, above, told, tmp_path, capsys):
    for path in (tmp_path, *tmp_path.parents):
        if path.stat().st_uid == os.geteuid() and path.name.startswith(("pytest", "test")):
            path.chmod(path.stat().st_mode | 0o011)
    folder = tmp_path / "in" / "course"
    folder.mkdir(parents=True)
    folder.chmod(mode)
    folder.parent.chmod(above)
    make_private(folder)
    assert stat.S_IMODE(folder.stat().st_mode) == mode
    assert (f"chmod o-rwx {folder}" in capsys.readouterr().err) == told


def test_nbgrader_makes_the_course_closed(tmp_path):
    root = courses.new_course(tmp_path / "there")
    modes = {
        path.relative_to(root).as_posix(): stat.S_IMODE(path.stat().st_mode)
        for path in (root / "course", root / "course" / "seed")
    }
    assert modes["course"] == 0o700
    (root / "course").chmod(0o755)
    said = courses.run(root, "nbgrader", "release_assignment", P3)
    assert "chmod o-rwx" not in said  # the folder above, pytest's own, is closed
