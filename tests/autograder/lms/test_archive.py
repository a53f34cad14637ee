"""Archives as they may come: what is unsafe or damaged is named, and the rest is read."""

import stat
import struct
import zipfile

import pytest

from autograder.lms import archive
from autograder.lms.archive import ArchiveError, entries
from tests.autograder.lms.platforms import zipped


def read(path) -> dict[str, bytes]:
    return {"/".join(one.parts): one.read() for one in entries(path)[0]}


def test_what_is_in_it_is_read_and_what_a_desktop_adds_is_not(tmp_path):
    path = zipped(
        tmp_path / "a.zip",
        {"a/b.txt": "1", "__MACOSX/a/._b.txt": "x", "a/.DS_Store": "x", "a/.hints-seen.json": "{}",
         "a/.ipynb_checkpoints/b-checkpoint.ipynb": "x", "a/": ""},
    )  # fmt: skip
    assert read(path) == {"a/b.txt": b"1", "a/.hints-seen.json": b"{}"}
    with zipfile.ZipFile(path) as packed:
        packed.extractall(tmp_path / "unpacked")
    assert read(tmp_path / "unpacked") == read(path)


@pytest.mark.parametrize(
    "name", ["../evil", "a/../../evil", "/etc/passwd", "C:/evil", "a\\..\\evil", "..", "a/.."]
)
def test_a_path_that_leads_out_is_left_out_and_named(tmp_path, name):
    path = zipped(tmp_path / "a.zip", {"good": "1", name: "2"})
    found, left_out = entries(path)
    assert [one.parts for one in found] == [("good",)]
    assert len(left_out) == 1
    assert left_out[0].endswith("its path leads out of the archive")


def test_links_and_encrypted_files_are_left_out(tmp_path):
    path = tmp_path / "a.zip"
    with zipfile.ZipFile(path, "w") as packed:
        link = zipfile.ZipInfo("link")
        link.external_attr = (stat.S_IFLNK | 0o777) << 16
        packed.writestr(link, "/etc/passwd")
        packed.writestr("secret", "x")
    data = bytearray(path.read_bytes())
    at = data.index(b"PK\x01\x02", data.index(b"PK\x01\x02") + 1)  # the second file's entry
    data[at + 8] |= 1
    path.write_bytes(data)
    assert entries(path) == ([], ["a.zip: link: it is a link", "a.zip: secret: it is encrypted"])
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "link").symlink_to("/etc/passwd")
    assert entries(tmp_path / "folder") == ([], ["folder: link: it is no plain file"])


def test_a_bomb_is_left_out_before_it_is_unpacked(tmp_path):
    big = bytes(archive.MOST_BYTES_OF_A_FILE + (1 << 20))
    path = zipped(tmp_path / "a.zip", {"bomb.ipynb": big, "good": "1"})
    assert path.stat().st_size < 100_000
    found, left_out = entries(path)
    assert [one.parts for one in found] == [("good",)]
    assert left_out == ["a.zip: bomb.ipynb: it has 65 MB unpacked, and at most 64 are read"]


def test_a_bomb_that_hides_its_size_gives_no_more_than_it_says(tmp_path):
    path = zipped(tmp_path / "a.zip", {"bomb.ipynb": bytes(1 << 22)})
    data = bytearray(path.read_bytes())
    struct.pack_into("<I", data, data.index(b"PK\x01\x02") + 24, 100)
    path.write_bytes(data)
    with pytest.raises(ArchiveError, match="it is damaged"):
        entries(path)[0][0].read()


def test_many_small_ones_are_a_bomb_too(tmp_path, monkeypatch):
    path = zipped(tmp_path / "a.zip", {f"{number}": bytes(1000) for number in range(10)})
    monkeypatch.setattr(archive, "MOST_BYTES", 9_999)
    with pytest.raises(ArchiveError, match=r"a\.zip: its files have more than"):
        entries(path)
    monkeypatch.setattr(archive, "MOST_BYTES", 10_000)
    assert len(entries(path)[0]) == 10
    monkeypatch.setattr(archive, "MOST_FILES", 9)
    with pytest.raises(ArchiveError, match=r"a\.zip: it holds more than 9 files"):
        entries(path)


def test_what_is_damaged_is_no_archive_or_no_file(tmp_path):
    whole = zipped(tmp_path / "a.zip", {"a": "text " * 500, "b": "1"}).read_bytes()
    for name, data in (("cut.zip", whole[:-30]), ("page.zip", b"<!DOCTYPE html>"), ("no.zip", b"")):
        (tmp_path / name).write_bytes(data)
        with pytest.raises(ArchiveError, match=f"{name}: it is damaged, or no zip archive"):
            entries(tmp_path / name)
    flipped = bytearray(whole)
    flipped[40] ^= 0xFF
    (tmp_path / "flipped.zip").write_bytes(flipped)
    found, _ = entries(tmp_path / "flipped.zip")
    with pytest.raises(ArchiveError, match=r"damaged|cannot be unpacked"):
        found[0].read()
    assert found[1].read() == b"1"


def test_names_in_utf_8_are_read_whether_or_not_the_archive_says_so(tmp_path):
    path = zipped(tmp_path / "a.zip", {"Ève.txt": "1"})
    data = path.read_bytes()
    for at in (data.index(b"PK\x03\x04") + 6, data.index(b"PK\x01\x02") + 8):
        data = data[: at + 1] + bytes([data[at + 1] & ~0x08]) + data[at + 2 :]
    (tmp_path / "b.zip").write_bytes(data)
    assert [one.parts for one in entries(path)[0]] == [("Ève.txt",)]
    assert [one.parts for one in entries(tmp_path / "b.zip")[0]] == [("Ève.txt",)]
    assert entries(tmp_path / "b.zip")[0][0].read() == b"1"
