"""An archive file: whole, private, read back, and checked by other programs than ours."""

import os
import shutil
import subprocess
import zipfile

import pytest

from autograder.lti import key, registration
from autograder.year import archive
from autograder.year.archive import DamagedError, read_back, write
from autograder.year.holdings import holdings

ODD = ("plain.txt", "a\\b.txt", "two\nlines.txt", "Übung 1 (2).ipynb", "  leading", "with  two")


@pytest.fixture
def contents(tmp_path):
    here = tmp_path / "here"
    here.mkdir()
    for name in ODD:
        (here / name).write_text(name * 1000, encoding="utf-8")
    os.utime(here / "plain.txt", (0, 0))  # before a zip archive's first year
    return {f"course/{name}": here / name for name in ODD} | {"ABOUT.txt": b"the course"}


def test_what_was_written_comes_back(contents, tmp_path):
    to = tmp_path / "year.zip"
    sums = write(to, "year", contents)
    assert read_back(to) == {f"year/{name}": found for name, found in sums.items()}
    assert sums["course/plain.txt"] == archive.sum_of(contents["course/plain.txt"])
    assert to.stat().st_mode & 0o777 == 0o600
    assert [path.name for path in tmp_path.iterdir() if path.is_file()] == ["year.zip"]


@pytest.mark.skipif(not shutil.which("sha256sum"), reason="needs sha256sum: apt install coreutils")
def test_its_sums_are_checked_without_the_kit(contents, tmp_path):
    write(tmp_path / "year.zip", "year", contents)
    zipfile.ZipFile(tmp_path / "year.zip").extractall(tmp_path)
    command = ["sha256sum", "--check", "--strict", "--quiet", "SHA256SUMS"]
    subprocess.run(command, cwd=tmp_path / "year", check=True, timeout=300)
    (tmp_path / "year" / "course" / "plain.txt").write_text("other")
    assert subprocess.run(command, cwd=tmp_path / "year", timeout=300).returncode == 1


def test_a_file_that_is_there_is_never_replaced(contents, tmp_path):
    to = tmp_path / "year.zip"
    to.write_bytes(b"last year's")
    with pytest.raises(FileExistsError):
        write(to, "year", contents)
    assert to.read_bytes() == b"last year's"


def test_a_damaged_archive_is_not_whole(contents, tmp_path):
    to = tmp_path / "year.zip"
    write(to, "year", contents)
    data = bytearray(to.read_bytes())
    data[data.index(b"year/course/plain.txt") + 50] ^= 0xFF
    to.write_bytes(data)
    with pytest.raises(DamagedError):
        read_back(to)
    with zipfile.ZipFile(to, "w") as other:
        other.writestr("year/SHA256SUMS", f"{'0' * 64}  marks.csv\n")
    with pytest.raises(DamagedError, match=r"marks\.csv"):
        read_back(to)
    with zipfile.ZipFile(to, "a") as other:
        other.writestr("year/marks.csv", "a;b")
    with pytest.raises(DamagedError, match="changed"):
        read_back(to)
    to.write_bytes(b"no archive")
    with pytest.raises(DamagedError):
        read_back(to)


def test_where_it_does_not_come_back_nothing_is_left(contents, tmp_path, monkeypatch):
    def damaged(path):
        raise DamagedError("a bad disk")

    monkeypatch.setattr(archive, "read_back", damaged)
    with pytest.raises(DamagedError):
        write(tmp_path / "year.zip", "year", contents)
    assert [path for path in tmp_path.iterdir() if path.is_file()] == []


def test_what_a_person_wrote_beside_the_course_is_kept_and_no_key_of_the_platform(tmp_path):
    for name in (
        "solutions/crane/crane.ipynb",
        "checks/crane.py",
        "course/seed",
        "nbgrader_config.py",
    ):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    kept = set(holdings(tmp_path).files)
    for one in (key.PRIVATE, key.PUBLIC, key.KEY_SET, registration.FILE):
        (tmp_path / one).touch()
    assert set(holdings(tmp_path).files) == kept
    assert kept == {
        "solutions/crane/crane.ipynb",
        "checks/crane.py",
        "course/seed",
        "nbgrader_config.py",
    }


def test_links_and_pipes_are_named_and_not_followed(tmp_path):
    work = tmp_path / "course" / "submitted" / "ada" / "p3-pendulum"
    work.mkdir(parents=True)
    (tmp_path / "solutions").mkdir()
    (tmp_path / "nbgrader_config.py").touch()
    outside = tmp_path / "outside"
    outside.mkdir()
    (outside / "secret.txt").write_text("a secret")
    (work / "p3-pendulum.ipynb").write_text("{}")
    (work / "folder").symlink_to(outside)
    (work / "file").symlink_to(outside / "secret.txt")
    if hasattr(os, "mkfifo"):
        os.mkfifo(work / "pipe")
    (tmp_path / "course" / "cache-of-results").mkdir()
    (tmp_path / "course" / "cache-of-results" / "kept").touch()
    (tmp_path / "course" / "gradebook.db-journal").touch()
    (tmp_path / "course" / "feedback").symlink_to(outside)  # another disk, as a lecturer may want
    found = holdings(tmp_path)
    assert set(found.files) == {
        "nbgrader_config.py",
        "course/submitted/ada/p3-pendulum/p3-pendulum.ipynb",
        "course/feedback/secret.txt",
    }
    place = "course/submitted/ada/p3-pendulum"
    assert f"{place}/folder is not kept: it is a link, to {outside}" in found.left
    assert any(line.startswith(f"{place}/file is not kept: it is a link") for line in found.left)
    if hasattr(os, "mkfifo"):
        assert f"{place}/pipe is not kept: it is no plain file" in found.left
