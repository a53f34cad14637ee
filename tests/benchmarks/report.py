"""docs/benchmarks.md, of which each benchmark writes one section."""

import platform
import re
from datetime import date
from pathlib import Path

import numpy as np

from tests.benchmarks.last_run import beside_last

HEAD = """\
# Speed

Written by `make bench`. In each table, "ratio" is our time over the other's: "1/30" means 30 times
faster. "goal" is the largest ratio that was aimed for. "last" is what the run before measured for the
figure to its left.
"""


def machine() -> str:
    return f"Python {platform.python_version()}, NumPy {np.__version__}, {platform.machine()}"


def put(file: Path, title: str, text: str, measured: tuple[str, ...]) -> None:
    """Write the section of this title; the other sections stay.

    measured: the columns of its table that keep their last figures beside the new ones.
    """
    old = file.read_text(encoding="utf-8") if file.exists() else ""
    parts = re.split(r"^## (.+)\n", old, flags=re.MULTILINE)
    sections = dict(zip(parts[1::2], parts[2::2], strict=True))
    sections[title] = beside_last(text, sections.get(title, ""), measured, date.today())
    body = "\n".join(f"## {name}\n\n{section.strip()}\n" for name, section in sections.items())
    file.write_text(f"{HEAD}\n{body}", encoding="utf-8")
