"""Writes a file so that it appears whole or not at all."""

import os
import secrets
from pathlib import Path

PART = ".part"  # a killed run may leave a file whose name ends so


def put_in_place(path: Path, content: str | bytes, mode: int = 0o666) -> None:
    """Write a file, text as UTF-8; if that fails, what was there before stays.

    mode: the permissions of a new file, before the umask. OSError if it cannot be written.
    """
    data = content.encode("utf-8") if isinstance(content, str) else content
    if path.exists() and not path.is_file():  # a pipe or a terminal, which nothing can replace
        path.write_bytes(data)
        return
    path = path.resolve()  # a link stays one
    part = path.parent / f".{secrets.token_hex(8)}{PART}"
    try:
        with open(os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL, mode), "wb") as file:
            file.write(data)
        part.replace(path)
    except BaseException:
        part.unlink(missing_ok=True)
        raise
