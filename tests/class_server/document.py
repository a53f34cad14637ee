"""The commands of docs/class-server.md and docs/workers.md, block by block; `python3 -m` prints those
that install.

`.ci/machine` reads this with the system's Python, so it needs nothing else.
"""

import re
import sys
from pathlib import Path
from typing import NamedTuple

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "class-server.md"
_SECTION = re.compile(r"^## (\d+)\. .*?$(.*?)(?=^## |\Z)", re.M | re.S)
_BLOCK = re.compile(r"^```sh\n# as (\S+)\n(.*?)^```$", re.M | re.S)


class Block(NamedTuple):
    """Commands, and the account that runs them."""

    account: str
    script: str


def sections() -> dict[int, list[Block]]:
    """The blocks of each section, by its number."""
    text = PAGE.read_text(encoding="utf-8")
    return {int(number): _blocks(body) for number, body in _SECTION.findall(text)}


def about_workers() -> list[Block]:
    """The blocks of docs/workers.md."""
    return _blocks((DOCS / "workers.md").read_text(encoding="utf-8"))


def _blocks(text: str) -> list[Block]:
    return [Block(*found) for found in _BLOCK.findall(text)]


if __name__ == "__main__":
    _, *install = sections()[1]
    print("".join(block.script for block in install).replace("/opt/armdyn", sys.argv[1]))
