"""The commands of docs/containers.md, as a reader types them."""

import re

from tests.class_server.document import DOCS

_BLOCK = re.compile(r"^```sh\n(.*?)^```$", re.M | re.S)


def blocks() -> list[str]:
    """Each block, without the line that says where it is run."""
    page = (DOCS / "containers.md").read_text(encoding="utf-8")
    return [block.partition("\n")[2] for block in _BLOCK.findall(page)]


def commands(verb: str, image: str) -> list[str]:
    """Those that build or run an image, each on one line."""
    lines = "".join(blocks()).replace("\\\n ", "").splitlines()
    return [
        re.sub(" +", " ", line) for line in lines if f" {verb} " in line and image in line.split()
    ]
