"""In which order the lessons are read: the table of lesson 00 has it; the numbers are only names."""

import json
import re
from pathlib import Path

TABLE = "00-lessons"  # the id of its cell
ROW = re.compile(r"^\| \[[^]]+\]\(([^)]+\.ipynb)\) \|", re.MULTILINE)


def lessons(folder: Path) -> list[Path]:
    """The notebooks of `folder` in the order of the table.

    ValueError names those that it does not list.
    """
    first, *_ = sorted(folder.glob("*.ipynb"))
    cells = json.loads(first.read_text(encoding="utf-8"))["cells"]
    table = next("".join(cell["source"]) for cell in cells if cell["id"] == TABLE)
    order = [folder / name for name in ROW.findall(table)]
    if left_out := set(folder.glob("*.ipynb")) - set(order):
        names = ", ".join(sorted(path.name for path in left_out))
        raise ValueError(f"The table of {first.name} (cell {TABLE}) does not list {names}.")
    return order
