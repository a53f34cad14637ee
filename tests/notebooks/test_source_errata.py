"""docs/source-errata.md: each row leads to a section of a lesson, with code that asserts it."""

import re
from functools import cache
from pathlib import Path

import nbformat
import pytest

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "source-errata.md"
LINK = re.compile(r"\[(\d\d) · ([^\]]+)\]\(\.\./lessons/([\w-]+\.ipynb)#cell-id=([\w-]+)\)")
HEADING = re.compile(r"^#{2,4} +(.+?) *$", re.MULTILINE)
HEAD = "| often read | right | taught and asserted |"


@cache
def cells(name: str) -> list:
    path = ROOT / "lessons" / name
    return nbformat.read(path, as_version=nbformat.NO_CONVERT).cells if path.is_file() else []


def rows(page: str) -> list[list[str]]:
    lines = [line for line in page.splitlines() if line.startswith("|")]
    return [
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in lines
        if line != HEAD and not set(line) <= set("|-")
    ]


ROWS = rows(PAGE.read_text(encoding="utf-8"))


def wrong_with(number: str, heading: str, name: str, id: str) -> str:
    """What is wrong with a link of the page; "" where nothing is."""
    if not name.startswith(number) or not cells(name):
        return f"{name}: no lesson {number}"
    places = [k for k, cell in enumerate(cells(name)) if cell.id == id]
    if not places or cells(name)[places[0]].cell_type != "markdown":
        return f"{id}: no text there has this id"
    if heading not in HEADING.findall(cells(name)[places[0]].source):
        return f"{id}: no heading {heading!r}"
    for cell in cells(name)[places[0] + 1 :]:
        if cell.cell_type == "markdown" and HEADING.search(cell.source):
            break
        if cell.cell_type == "code" and "assert " in cell.source:
            return ""
    return f"{id}: no code asserts it"


@pytest.mark.parametrize("row", ROWS, ids=[row[0][:40] for row in ROWS])
def test_each_row_leads_to_a_section_that_asserts_it(row):
    assert len(row) == 3, row
    assert all(row)
    links = LINK.findall(row[2])
    assert links, row[2]
    assert LINK.sub("", row[2]).strip(" ,") == ""
    assert not list(filter(None, (wrong_with(*link) for link in links)))


def test_every_statement_that_a_lesson_quotes_as_a_trap_is_there():
    linked = {id for row in ROWS for *_, id in LINK.findall(row[2])}
    quoted = {
        cell.id
        for path in sorted((ROOT / "lessons").glob("*.ipynb"))
        for cell in cells(path.name)
        if cell.cell_type == "markdown" and re.search(r'^#+ Trap: "', cell.source, re.MULTILINE)
    }
    assert len(quoted) >= 8
    assert quoted <= linked


@pytest.mark.parametrize(
    ("link", "wrong"),
    [
        (("03", "Trap: two sets of axes", "03-inertia-matrix.ipynb", "03-trap-axes"), ""),
        (("04", "Trap: two sets of axes", "03-inertia-matrix.ipynb", "03-trap-axes"), "no lesson"),
        (("03", "Trap: two sets", "03-inertia-matrix.ipynb", "03-trap-axes"), "no heading"),
        (("03", "Trap: two sets of axes", "03-inertia-matrix.ipynb", "03-axes"), "has this id"),
        (("03", "Summary", "03-inertia-matrix.ipynb", "03-summary"), "no code"),
    ],
)
def test_a_row_that_leads_nowhere_is_noticed(link, wrong):
    said = wrong_with(*link)
    assert wrong in said
    assert bool(said) == bool(wrong)
