"""A disk that is full takes nothing away: what was graded, reported or written before stays."""

import errno
import os
import re
import resource
import shutil
import subprocess
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest
from nbgrader.converters import Autograde, GenerateFeedback
from nbgrader.converters.base import NbGraderException
from nbgrader.coursedir import CourseDirectory

from autograder.cli import main
from autograder.files import put_in_place
from autograder.nbgrader_glue.release import configuration
from tests.autograder import courses
from tests.autograder.courses import P3, files, rows, submit
from tests.submissions import p3_pendulum

SIZE = 8 << 20
FULL = "|".join(map(os.strerror, (errno.ENOSPC, errno.EFBIG)))


class Tmpfs:
    """A small disk, which can be filled."""

    def __init__(self, folder):
        self.folder = folder

    @contextmanager
    def left(self, space: int):
        """Only so many bytes are free."""
        filler = self.folder / "filler"
        with filler.open("wb", buffering=0) as file:
            with suppress(OSError):
                while file.write(bytes(4096)):
                    pass
            file.truncate(max(0, file.tell() - space))
        try:
            yield
        finally:
            filler.unlink()


class SmallFiles:
    """For those who may mount nothing: no file of this process may grow beyond a size."""

    def __init__(self, folder):
        self.folder = folder

    @contextmanager
    def left(self, space: int):
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (space, before[1]))
        try:
            yield
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.fixture
def disk(tmp_path):
    folder = tmp_path / "disk"
    folder.mkdir()
    mount, unmount = shutil.which("mount"), shutil.which("umount")
    command = [mount, "-t", "tmpfs", "-o", f"size={SIZE}", "tmpfs", folder]
    mounted = mount and unmount and not subprocess.run(command, capture_output=True).returncode
    if not mounted:
        yield SmallFiles(folder)
        return
    try:
        yield Tmpfs(folder)
    finally:
        subprocess.run([unmount, "--lazy", folder], check=True)


def test_a_file_that_does_not_fit_leaves_the_earlier_one(disk):
    path = disk.folder / "page.html"
    put_in_place(path, "earlier")
    with disk.left(1024), pytest.raises(OSError, match=FULL):
        put_in_place(path, bytes(1 << 20))
    assert path.read_text() == "earlier"
    assert list(disk.folder.iterdir()) == [path]


def run_again(command, root: Path) -> None:
    """An nbgrader command with --force, which removes what is there first, in this process."""
    config = configuration(root)
    config.CourseDirectory.assignment_id = P3
    config.BaseConverter.force = True
    command(coursedir=CourseDirectory(config=config), config=config).start()


def test_without_a_sandbox_nbgrader_removes_nothing(tmp_path, monkeypatch):
    root = courses.new_course(tmp_path / "course")
    submit(root, "ada", p3_pendulum.right(courses.release(root)))
    graded = root / "course" / "autograded" / "ada" / P3 / courses.NOTEBOOK
    graded.parent.mkdir(parents=True)
    graded.write_text("earlier")

    def no_room():
        raise OSError("no sandbox starts")

    monkeypatch.setattr("autograder.nbgrader_glue.reading.Room", no_room)
    with pytest.raises(NbGraderException, match="no sandbox starts; the command did not start"):
        run_again(Autograde, root)
    assert graded.read_text() == "earlier"


def test_what_was_graded_and_reported_stays(disk, monkeypatch, capsys):
    root = courses.new_course(disk.folder / "course")
    folder = submit(root, "ada", p3_pendulum.right(courses.release(root))).parent
    (folder / "data.csv").write_text("earlier")
    monkeypatch.chdir(root)
    assert main(["grade", P3, "--jobs", "1"]) == 0
    assert main(["report", P3]) == 0
    (folder / "data.csv").write_text("later")

    def state():
        found = files(root / "course" / "autograded"), rows(courses.database(root))
        return (*found, (root / "course" / "report" / f"{P3}.html").read_bytes())

    before, failures = state(), 0
    for command in (Autograde, GenerateFeedback):
        with disk.left(0), pytest.raises(NbGraderException, match=f"({FULL}).*nothing has changed"):
            run_again(command, root)
        assert state() == before
    for space in (0, 12 << 10, 30 << 10, 60 << 10, SIZE):
        capsys.readouterr()
        with disk.left(space):
            status = main(["grade", P3, "--jobs", "1"])
            reported = main(["report", P3]) if space == 0 else 2
        assert reported == 2
        graded, again, page = state()
        assert (again, page) == before[1:]  # the same points either way
        said = capsys.readouterr()
        if status:
            failures += 1
            assert graded == before[0]
            begun = "could not be graded" in said.out and "the earlier result stays" in said.out
            assert begun or re.search(FULL, said.err)
    assert failures >= 2
    assert status == 0
    assert graded[f"ada/{P3}/data.csv"][1] == b"later"
    assert graded.keys() == before[0].keys()
    assert not list((root / "course").rglob("*.part"))
    assert not list((root / "course" / "autograded").rglob(".*-*"))
