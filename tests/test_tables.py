"""Each row of a table in Markdown has as many cells as its head: readers drop what is too much."""

import re
import subprocess
from pathlib import Path

import nbformat
import pytest

ROOT = Path(__file__).parents[1]
TRACKED = subprocess.run(
    ["git", "ls-files", "*.md", "*.ipynb"], cwd=ROOT, capture_output=True, text=True, check=True
).stdout.split()
BAR = re.compile(r"(?<!\\)\|")
RULE = re.compile(r" *\|?( *:?-+:? *\|)+( *:?-+:? *)?")
FENCE = re.compile(r" *(```|~~~)")


def texts(file: str) -> list[str]:
    """The Markdown of a file: all of a page, the text cells of a notebook."""
    if file.endswith(".md"):
        return [(ROOT / file).read_text(encoding="utf-8")]
    cells = nbformat.read(ROOT / file, as_version=4).cells
    return [cell.source for cell in cells if cell.cell_type == "markdown"]


def cells(line: str) -> int:
    return len(BAR.split(line.strip().removeprefix("|").removesuffix("|")))


def uneven_rows(text: str) -> list[str]:
    """The lines of its tables that have more or fewer cells than the head."""
    found, before, width, fenced = [], "", 0, False
    for line in text.splitlines():
        fenced ^= bool(FENCE.match(line))
        if fenced or not line.strip():
            width = 0
        elif RULE.fullmatch(line.rstrip()) and "|" in before:
            width = cells(before)
        if width and cells(line) != width:
            found.append(line)
        before = line
    return found


@pytest.mark.parametrize("file", TRACKED)
def test_rows_have_as_many_cells_as_the_head(file):
    assert [row for text in texts(file) for row in uneven_rows(text)] == []


HEAD = "| word | meaning |\n|---|---|\n"


@pytest.mark.parametrize(
    ("text", "uneven"),
    [
        (HEAD + "| slip | one sign |\n| loop | a run |\n", 0),
        (HEAD + "| slip | one sign loop | a run |\n", 1),
        (HEAD + "| slip |\n", 1),
        (HEAD + "| slip | one\nsign |\n", 1),
        (HEAD + "| a \\| b | one sign |\n", 0),
        (HEAD + "| a | b |\n\nA text with | a | bar | in it.\n", 0),
        ("```\n" + HEAD + "| a |\n```\n", 0),
        ("one | two\n--- | ---\na | b\na | b | c\n", 1),
        ("A rule is no table.\n\n---\n\na | b\n", 0),
    ],
)
def test_an_uneven_row_is_noticed(text, uneven):
    assert len(uneven_rows(text)) == uneven
