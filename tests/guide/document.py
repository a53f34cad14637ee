"""What a page tells its reader to type, and what it says that is printed then."""

import re
import shlex
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
_FENCED = re.compile(r"^( *)```(\S*)\n(.*?)^\1```$", re.M | re.S)
_STATUS = re.compile(r"exit status (\d+)")
# Of these, tests/class_server runs the commands, as their accounts, test_tls.py and tests/containers.
RUN_ELSEWHERE = {"docs/class-server.md", "docs/workers.md", "docs/containers.md"}
# What a block that is not typed into a terminal holds.
LANGUAGES = ("sh", "python", "text", "csv", "toml", "ini", "mermaid", "{eval-rst}", "{toctree}")


@dataclass(frozen=True)
class Command:
    """What is to be typed, without its comment, which may name the exit `status`.

    place: file and line.
    """

    text: str
    status: int
    place: str

    @property
    def words(self) -> list[str]:
        return shlex.split(self.text)


@dataclass(frozen=True)
class Block:
    language: str
    text: str
    line: int


class Page:
    """A Markdown page, by its path in the repository."""

    def __init__(self, name: str):
        self.name = name
        text = (ROOT / name).read_text(encoding="utf-8")
        self.blocks = [
            Block(
                found[2],
                re.sub(rf"^{found[1]}", "", found[3], flags=re.M),
                text.count("\n", 0, found.start()) + 2,
            )
            for found in _FENCED.finditer(text)
        ]
        self.inline = re.findall(r"`([^`]+)`", _FENCED.sub("", text))

    def texts(self, language: str) -> list[str]:
        return [block.text for block in self.blocks if block.language == language]

    @property
    def commands(self) -> list[Command]:
        return [one for block in self.blocks for one in self.of(block)]

    def of(self, block: Block) -> list[Command]:
        """The commands of a block; what a backslash continues is one."""
        if block.language != "sh" or self.name in RUN_ELSEWHERE:
            return []
        found, number = [], block.line
        for text in re.split(r"(?<!\\)\n", block.text.rstrip("\n")):
            place, number = f"{self.name}:{number}", number + text.count("\n") + 1
            typed, comment = _without_comment(text)
            if typed:
                status = _STATUS.search(comment)
                found.append(Command(typed, int(status[1]) if status else 0, place))
        return found


def _without_comment(text: str) -> tuple[str, str]:
    typed, _, comment = re.sub(r"\\\n\s*", "", text).partition(" # ")
    return ("", text) if typed.startswith("#") else (" ".join(typed.split()), comment)


def pages() -> list[Page]:
    """All that people read who use the kit or work on it."""
    named = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "SECURITY.md")]
    found = [*named, *sorted((ROOT / "docs").glob("*.md"))]
    return [Page(path.relative_to(ROOT).as_posix()) for path in found]
