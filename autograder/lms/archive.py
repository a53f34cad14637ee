"""Reads what a platform's archive holds, within limits, and says what it leaves out."""

import os
import stat
import zipfile
import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from autograder.protocol import one_line

MOST_FILES = 50_000
MOST_BYTES_OF_A_FILE = 64 << 20
MOST_BYTES = 4 << 30  # in all, unpacked
NOT_HANDED_IN = {"__MACOSX", ".DS_Store", "Thumbs.db", "desktop.ini", ".ipynb_checkpoints"}
UTF_8 = 0x800  # a flag of zip's: the name is UTF-8
ENCRYPTED = 0x1


class ArchiveError(ValueError):
    """An archive, or a file in it, cannot be read; the message says which and why."""


@dataclass(frozen=True)
class Entry:
    """A file in an archive: the parts of its path, and how to read it (ArchiveError if that fails)."""

    parts: tuple[str, ...]
    read: Callable[[], bytes]

    @property
    def shown(self) -> str:
        return one_line("/".join(self.parts), 120)


def entries(path: Path) -> tuple[list[Entry], list[str]]:
    """The files in an archive, or in a folder that it was unpacked to, and why others are left out.

    ArchiveError if it cannot be read at all, or is too large to be what students handed in.
    """
    found: list[Entry] = []
    left_out: list[str] = []
    total = 0
    for entry, size, fault in _of_folder(path) if path.is_dir() else _of_zip(path):
        if NOT_HANDED_IN & set(entry.parts):
            continue
        if len(found) == MOST_FILES:
            raise ArchiveError(f"{path.name}: it holds more than {MOST_FILES} files")
        if not fault and size > MOST_BYTES_OF_A_FILE:
            fault = f"it has {size >> 20} MB unpacked, and at most {MOST_BYTES_OF_A_FILE >> 20} are read"
        if fault:
            left_out.append(f"{path.name}: {entry.shown}: {fault}")
            continue
        total += size
        if total > MOST_BYTES:
            raise ArchiveError(
                f"{path.name}: its files have more than {MOST_BYTES >> 30} GB unpacked"
            )
        found.append(entry)
    return found, left_out


def _of_zip(path: Path) -> Iterator[tuple[Entry, int, str]]:
    try:
        with zipfile.ZipFile(path) as archive:
            infos = archive.infolist()
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError) as error:
        said = "it is damaged, or no zip archive"
        why = error.strerror if isinstance(error, OSError) and error.strerror else said
        raise ArchiveError(f"{path.name}: {why}: download it again") from None
    for info in infos:
        if info.is_dir():
            continue
        name = _name(info)
        entry = Entry(tuple(filter(None, name.split("/"))), partial(_read, path, info))
        yield entry, info.file_size, _fault(name, info)


def _name(info: zipfile.ZipInfo) -> str:
    """The name as it was meant: many programs write UTF-8 without saying so."""
    if not info.flag_bits & UTF_8:
        try:
            return info.orig_filename.encode("cp437").decode("utf-8")
        except UnicodeError:
            pass
    return info.orig_filename


def _fault(name: str, info: zipfile.ZipInfo) -> str:
    parts = name.split("/")
    if (
        ".." in parts
        or name.startswith("/")
        or "\\" in name
        or parts[0][1:2] == ":"
        or "\0" in name
    ):
        return "its path leads out of the archive"
    if stat.S_ISLNK(info.external_attr >> 16):
        return "it is a link"
    if info.flag_bits & ENCRYPTED:
        return "it is encrypted"
    return ""


def _read(path: Path, info: zipfile.ZipInfo) -> bytes:
    try:
        with zipfile.ZipFile(path) as archive, archive.open(info) as file:
            return file.read(MOST_BYTES_OF_A_FILE)
    except (zipfile.BadZipFile, zlib.error, EOFError, OSError, NotImplementedError, ValueError):
        raise ArchiveError("it is damaged") from None
    except Exception as error:  # whatever an unusual way to compress ends in
        raise ArchiveError(f"it cannot be unpacked ({type(error).__name__})") from None


def _of_folder(folder: Path) -> Iterator[tuple[Entry, int, str]]:
    for at, folders, files in os.walk(folder):
        folders.sort()
        for name in sorted(files):
            path = Path(at, name)
            entry = Entry(path.relative_to(folder).parts, partial(_of_disk, path))
            plain = path.is_file() and not path.is_symlink()
            yield entry, path.stat().st_size if plain else 0, "" if plain else "it is no plain file"


def _of_disk(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        raise ArchiveError(error.strerror or "it cannot be read") from None
