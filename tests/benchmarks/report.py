"""docs/benchmarks.md, of which each benchmark writes one section."""

import platform
import re
from pathlib import Path

import numpy as np

HEAD = """\
# Speed

Written by `make bench`. In each table, "ratio" is our time over the other's: "1/30" means 30 times
faster. "goal" is the largest ratio that was aimed for.
"""


def machine() -> str:
    return f"Python {platform.python_version()}, NumPy {np.__version__}, {platform.machine()}"


def put(file: Path, title: str, text: str) -> None:
    """Write the section of this title; the other sections stay."""
    old = file.read_text(encoding="utf-8") if file.exists() else ""
    parts = re.split(r"^## (.+)\n", old, flags=re.MULTILINE)
    sections = dict(zip(parts[1::2], parts[2::2], strict=True))
    sections[title] = f"\n{text.strip()}\n\n"
    body = "".join(f"## {name}\n{section}" for name, section in sections.items())
    file.write_text(f"{HEAD}\n{body.rstrip()}\n", encoding="utf-8")
