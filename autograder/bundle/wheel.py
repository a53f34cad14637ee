"""Writes a wheel, as the binary distribution format of Python packages (version 1.0) lays down."""

import base64
import hashlib
import io
import zipfile
from collections.abc import Mapping
from pathlib import Path

WHEEL = "Wheel-Version: 1.0\nGenerator: armdyn\nRoot-Is-Purelib: true\nTag: py3-none-any\n"
# The date of every file, so that the same files make the same wheel: that of the kit's release.
RELEASED = (2026, 11, 29, 0, 0, 0)


def write_wheel(
    folder: Path, name: str, version: str, metadata: str, commands: str, files: Mapping[str, bytes]
) -> Path:
    """Write the wheel of these files, by their paths, into the folder; its path.

    metadata: the text of METADATA. commands: that of entry_points.txt. OSError if it can't be written.
    """
    info = f"{name}-{version}.dist-info"
    every = {
        **files,
        f"{info}/METADATA": metadata.encode(),
        f"{info}/WHEEL": WHEEL.encode(),
        f"{info}/entry_points.txt": commands.encode(),
    }
    record = "".join(f"{path},{_hash(data)},{len(data)}\n" for path, data in every.items())
    every[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    path = folder / f"{name}-{version}-py3-none-any.whl"
    path.write_bytes(zipped(every))
    return path


def zipped(files: Mapping[str, bytes]) -> bytes:
    """These files by their paths, as a zip archive that is the same whenever it is made."""
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as written:
        for path, data in files.items():
            entry = zipfile.ZipInfo(path, RELEASED)
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            written.writestr(entry, data)
    return archive.getvalue()


def _hash(data: bytes) -> str:
    found = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=")
    return f"sha256={found.decode()}"
