"""Writes files into a zip archive with their SHA-256 sums, and reads it back."""

import hashlib
import os
import re
import time
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import IO

SUMS = "SHA256SUMS"
PIECE = 1 << 20  # bytes
_ESCAPED = {"\\": "\\\\", "\n": "\\n", "\r": "\\r"}  # as `sha256sum` writes such a name


class DamagedError(ValueError):
    """An archive does not hold what was written into it; the message says what differs."""


def write(to: Path, top: str, contents: Mapping[str, Path | bytes]) -> dict[str, str]:
    """Write an archive that only its owner can read, read it back, and only then give it its name.

    contents: what goes into the folder `top` of the archive, by names with "/". Returns the SHA-256 sum
    of each. FileExistsError if there is a file `to`, OSError or DamagedError if it cannot be written.
    """
    if os.path.lexists(to):
        raise FileExistsError(f"there is already a file {to}")
    part = to.with_name(f".{to.name}.part")
    part.unlink(missing_ok=True)
    try:
        with open(os.open(part, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o600), "w+b") as file:
            with zipfile.ZipFile(
                file, "w", zipfile.ZIP_DEFLATED, strict_timestamps=False
            ) as archive:
                _add_private(archive, top, contents)
                sums = {name: _add(archive, f"{top}/{name}", content)
                        for name, content in contents.items()}  # fmt: skip
                archive.writestr(_info(f"{top}/{SUMS}"), _as_text(sums))
            file.flush()
            os.fsync(file.fileno())
        if read_back(part) != {f"{top}/{name}": found for name, found in sums.items()}:
            raise DamagedError(f"{to}: its list of sums came back changed")
        part.rename(to)
    except BaseException:
        part.unlink(missing_ok=True)
        raise
    return sums


def read_back(path: Path) -> dict[str, str]:
    """The sums of an archive's files, by their names in it, each compared with what is there.

    DamagedError if a file is missing, too many or changed.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            names = [name for name in archive.namelist() if not name.endswith("/")]
            (listed,) = (name for name in names if re.fullmatch(rf"[^/]+/{SUMS}", name))
            top = listed.removesuffix(SUMS)
            sums = {top + name: found for name, found in _from_text(archive.read(listed).decode())}
            if sorted(names) != sorted([*sums, listed]):
                odd = sorted({*names} ^ {*sums, listed}) or sorted(names)
                raise DamagedError(f"{path}: {odd[0]} is missing, or there unasked or twice")
            for name, expected in sums.items():
                with archive.open(name) as file:
                    if _digest(_pieces(file)) != expected:
                        raise DamagedError(f"{path}: {name} came back changed")
    except (zipfile.BadZipFile, EOFError, KeyError, zlib.error) as error:
        raise DamagedError(f"{path}: {error}") from None
    return sums


def sum_of(path: Path) -> str:
    """The SHA-256 sum of a file, in hexadecimal digits."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _add_private(archive: zipfile.ZipFile, top: str, contents: Mapping[str, Path | bytes]) -> None:
    """The folders at the top, which `unzip` makes so that nobody else can enter them."""
    for name in sorted({top, *(f"{top}/{name.split('/')[0]}" for name in contents if "/" in name)}):
        info = _info(f"{name}/")
        info.external_attr = (0o40700 << 16) | 0x10
        archive.writestr(info, b"")


def _add(archive: zipfile.ZipFile, name: str, content: Path | bytes) -> str:
    if isinstance(content, bytes):
        archive.writestr(_info(name), content)
        return hashlib.sha256(content).hexdigest()
    info = zipfile.ZipInfo.from_file(content, name, strict_timestamps=False)
    info.compress_type = zipfile.ZIP_DEFLATED
    with content.open("rb") as file, archive.open(info, "w", force_zip64=True) as to:
        return _digest(_copied(_pieces(file), to))


def _pieces(file: IO[bytes]) -> Iterator[bytes]:
    while piece := file.read(PIECE):
        yield piece


def _copied(pieces: Iterator[bytes], to) -> Iterator[bytes]:
    for piece in pieces:
        to.write(piece)
        yield piece


def _digest(pieces: Iterator[bytes]) -> str:
    found = hashlib.sha256()
    for piece in pieces:
        found.update(piece)
    return found.hexdigest()


def _info(name: str) -> zipfile.ZipInfo:
    info = zipfile.ZipInfo(name, time.localtime()[:6])
    info.compress_type = zipfile.ZIP_DEFLATED
    info.external_attr = 0o100600 << 16
    return info


def _as_text(sums: Mapping[str, str]) -> str:
    lines = []
    for name, found in sums.items():
        shown = re.sub(r"[\\\n\r]", lambda match: _ESCAPED[match[0]], name)
        lines.append(f"{'' if shown == name else chr(92)}{found}  {shown}\n")
    return "".join(lines)


def _from_text(text: str) -> Iterator[tuple[str, str]]:
    plain = {shown: sign for sign, shown in _ESCAPED.items()}
    for line in text.split("\n")[:-1]:
        found, name = line.removeprefix("\\").split("  ", 1)
        if line.startswith("\\"):
            name = re.sub(r"\\[\\nr]", lambda match: plain[match[0]], name)
        yield name, found
