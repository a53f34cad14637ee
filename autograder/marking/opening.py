"""Leads a browser to an address with a token in it, which other accounts could read in a list of
processes.
"""

import html
import secrets
from pathlib import Path
from typing import Self

from autograder.files import put_in_place


class Opening:
    """A file that only its owner reads, in `folder`; it goes when the context ends."""

    def __init__(self, folder: Path):
        self._file = folder / f"open-{secrets.token_hex(4)}.html"

    def leading_to(self, address: str) -> str:
        """The address of the file, which leads to this one."""
        shown = html.escape(address)
        put_in_place(
            self._file,
            f'<!DOCTYPE html><meta charset="utf-8"><meta http-equiv="refresh" content="0; url={shown}">'
            f'<title>Marking</title><a href="{shown}">Marking</a>\n',
            0o600,
        )
        return self._file.resolve().as_uri()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error) -> None:
        self._file.unlink(missing_ok=True)
