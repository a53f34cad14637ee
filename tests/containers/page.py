"""The commands of docs/class-server.md about containers, as a reader types them."""

import re

from tests.class_server.document import PAGE

_SECTION = re.compile(r"^## \d+\. Containers$(.*?)(?=^## )", re.M | re.S)
_BLOCK = re.compile(r"^```sh\n(.*?)^```$", re.M | re.S)


def blocks() -> list[str]:
    """Each block of the section, without the line that says where it is run."""
    found = _SECTION.search(PAGE.read_text(encoding="utf-8"))
    assert found is not None
    return [block.partition("\n")[2] for block in _BLOCK.findall(found[1])]


def commands(verb: str, image: str) -> list[str]:
    """Those that build or run an image, each on one line."""
    lines = "".join(blocks()).replace("\\\n ", "").splitlines()
    return [
        re.sub(" +", " ", line) for line in lines if f" {verb} " in line and image in line.split()
    ]
