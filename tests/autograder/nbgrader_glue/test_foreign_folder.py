"""What a folder's owner changes while it is copied leads nobody out of it."""

import os
from contextlib import suppress

import pytest

from autograder.nbgrader_glue import foreign_folder
from autograder.nbgrader_glue.foreign_folder import ForeignFolderError, copy_foreign

pytestmark = pytest.mark.skipif(os.name == "nt", reason="nbgrader has no exchange on Windows")


@pytest.fixture
def folders(tmp_path):
    """The folder to copy, and one beside it with a secret."""
    source, secret = tmp_path / "source", tmp_path / "secret"
    (source / "data").mkdir(parents=True)
    (source / "data" / "a.csv").write_text("1")
    (source / "b.txt").write_text("2")
    secret.mkdir()
    (secret / "a.csv").write_text("secret")
    return source, secret


def nothing(folder, names):
    return []


def test_plain_files_are_copied_with_their_times(folders, tmp_path):
    source, _ = folders
    os.utime(source / "b.txt", (1e9, 1e9))
    changed = copy_foreign(source, tmp_path / "to", nothing, 100)
    assert (tmp_path / "to" / "data" / "a.csv").read_text() == "1"
    assert (tmp_path / "to" / "b.txt").stat().st_mtime == 1e9
    assert changed == max(p.stat().st_ctime for p in source.rglob("*") if p.is_file())


@pytest.mark.parametrize("when", ["looked at", "read"])
def test_a_folder_that_becomes_a_link_is_not_followed(folders, tmp_path, when, monkeypatch):
    source, secret = folders

    def swap():
        (source / "data").rename(source.parent / "away")
        (source / "data").symlink_to(secret)

    def ignored(folder, names):
        if when == "looked at" and "data" in names:
            swap()
        return []

    if when == "read":
        copy = foreign_folder._copy_bytes
        monkeypatch.setattr(
            foreign_folder, "_copy_bytes", lambda *given: (swap(), copy(*given))
        )  # b.txt, before data/ is entered
    with suppress(ForeignFolderError):
        copy_foreign(source, tmp_path / "to", ignored, 100)
    copied = [path.read_text() for path in (tmp_path / "to").rglob("*") if path.is_file()]
    assert "secret" not in copied


def test_a_file_that_becomes_a_link_is_refused(folders, tmp_path):
    source, secret = folders

    def ignored(folder, names):
        if "b.txt" in names:
            (source / "b.txt").unlink()
            (source / "b.txt").symlink_to(secret / "a.csv")
        return []

    with pytest.raises(ForeignFolderError, match=r"b\.txt is a link"):
        copy_foreign(source, tmp_path / "to", ignored, 100)
    assert not (tmp_path / "to").exists()


def test_no_more_than_the_limit_is_copied(folders, tmp_path):
    with pytest.raises(ForeignFolderError, match="there is more than 1e-06 MB"):
        copy_foreign(folders[0], tmp_path / "to", nothing, 1)


def test_no_more_files_than_the_limit(folders, tmp_path, monkeypatch):
    monkeypatch.setattr(foreign_folder, "MOST_FILES", 2)
    with pytest.raises(ForeignFolderError, match="there are more than 2 files"):
        copy_foreign(folders[0], tmp_path / "to", nothing, 100)


def test_what_is_to_be_left_out_is_left_out(folders, tmp_path):
    source, secret = folders
    (source / "link").symlink_to(secret)
    copy_foreign(source, tmp_path / "to", lambda folder, names: ["data", "link"], 100)
    assert [path.name for path in (tmp_path / "to").iterdir()] == ["b.txt"]
