"""The links between lessons and problems: each leads to a file, and to a cell of it.

Problems are read where students have them, in problems/, beside lessons/.
"""

import itertools
import re
from functools import cache
from pathlib import Path
from urllib.parse import unquote

import nbformat
import pytest

from docs import reading_order

ROOT = Path(__file__).parents[2]
IN_ORDER = reading_order.lessons(ROOT / "lessons")
LESSONS = sorted((ROOT / "lessons").glob("*.ipynb"))
PROBLEMS = sorted((ROOT / "solutions").glob("*/*.ipynb"))
LINK = re.compile(r"(?<!!)\[(?:[^\[\]]|\[[^\]]*\])*\]\(([^()\s]+)\)")
HEADING = re.compile(r"^#{1,6} +(.+?) *$", re.MULTILINE)
# JupyterLab scrolls to a cell; to a heading of a notebook that is not open yet, it does not.
CELL = "cell-id="


@cache
def cells(path: Path) -> dict[str, str]:
    """The Markdown of a notebook by the id of its cell."""
    notebook = nbformat.read(path, as_version=nbformat.NO_CONVERT)
    return {cell.id: cell.source for cell in notebook.cells if cell.cell_type == "markdown"}


def links(path: Path) -> list[tuple[str, str]]:
    """(text of its line, target) of the links to files of the course."""
    lines = [line for source in cells(path).values() for line in source.splitlines()]
    found = [(line, target) for line in lines for target in LINK.findall(line)]
    return [(line, target) for line, target in found if not re.match(r"[a-z]+:", target)]


def source_of(path: Path) -> Path:
    """The file in the repository that stands there in a student's course."""
    inside = path.relative_to(ROOT)
    return ROOT / "solutions" / Path(*inside.parts[1:]) if inside.parts[0] == "problems" else path


def page_of(path: Path) -> Path:
    """Where a student opens it."""
    return ROOT / "problems" / path.relative_to(ROOT / "solutions") if path in PROBLEMS else path


def target_of(page: Path, target: str) -> Path:
    file = target.partition("#")[0]
    return source_of((page.parent / unquote(file)).resolve()) if file else source_of(page)


def leads_nowhere(page: Path, target: str) -> str:
    """What is wrong with a link on a page that a student opens; "" where nothing is."""
    to, anchor = target_of(page, target), target.partition("#")[2]
    if not to.is_file():
        return f"{target}: there is no such file"
    if anchor and not anchor.startswith(CELL):
        return f"{target}: JupyterLab does not go there"
    if anchor and anchor.removeprefix(CELL) not in cells(to):
        return f"{target}: no cell there has this id"
    return ""


@pytest.mark.parametrize("path", [*LESSONS, *PROBLEMS], ids=lambda path: path.stem)
def test_every_link_leads_somewhere(path):
    wrong = [leads_nowhere(page_of(path), target) for _, target in links(path)]
    assert not list(filter(None, wrong))
    assert wrong, "a notebook without a single link to another"


@pytest.mark.parametrize("path", PROBLEMS, ids=lambda path: path.stem)
def test_each_part_links_to_the_section_that_prepares_it_and_that_links_back(path):
    parts = [source for source in cells(path).values() if re.match(r"## [A-E]\. ", source)]
    assert len(parts) >= 4, "a problem has four parts or more, ## A. to ## E."
    for part in parts:
        prepared = re.findall(r"\*Lesson \d\d prepares this: \[(.+)\]\((.+)\)\.\*", part)
        assert len(prepared) == 1, (
            f"write below this heading: *Lesson NN prepares this: [heading](../../lessons/NN-….ipynb"
            f"#cell-id=…).*\n{part.splitlines()[0]}"
        )
        ((text, target),) = prepared
        lesson = target_of(page_of(path), target)
        section = cells(lesson)[target.partition(f"#{CELL}")[2]]
        assert text in HEADING.findall(section)
        letter = part.removeprefix("## ")[0]
        # One line for each problem that the section prepares.
        lines = re.search(
            rf"^#+ {re.escape(text)}\n\n((?:\*Parts? .*\*\n)+)", section, re.MULTILINE
        )
        back = re.findall(
            rf"^\*Parts? .*\b{letter}\b.* of \[..\]\((.*)\) asks? for this\.\*$",
            lines[1] if lines else "",
            re.MULTILINE,
        )
        assert path in [target_of(lesson, target) for target in back], (
            f"lessons/{lesson.name}: write below the heading {text!r}: *Part {letter} of "
            f"[{path.stem[:2]}](../problems/{path.stem}/{path.name}) asks for this.*"
        )


def test_the_order_is_told_once_and_every_lesson_is_in_it():
    assert sorted(IN_ORDER) == LESSONS
    assert [path.name[:2] for path in IN_ORDER][:4] == ["00", "01", "07", "02"]


@pytest.mark.parametrize(
    ("path", "after"), list(itertools.pairwise(IN_ORDER)), ids=lambda path: path.stem
)
def test_each_lesson_leads_to_the_next(path, after):
    text = "\n".join(cells(path).values())
    (target,) = re.findall(r"\*\*Next:\*\* \[.+?\]\((.+?)\)", text)
    assert target_of(path, target) == after


@pytest.mark.parametrize("path", LESSONS, ids=lambda path: path.stem)
def test_a_lesson_needs_only_lessons_before_it(path):
    """What it says under "You need", in its first cell."""
    needed = re.search(r"You need: (.+)", next(iter(cells(path).values())))
    named = re.findall(r"\]\((\d\d-[\w-]+\.ipynb)", needed[1] if needed else "")
    for name in named:
        assert IN_ORDER.index(path.parent / name) < IN_ORDER.index(path) or name.startswith("00"), (
            name
        )


@pytest.mark.parametrize(
    ("target", "wrong"),
    [
        ("../../lessons/03-inertia-matrix.ipynb#cell-id=03-arm", ""),
        ("../../lessons/03-inertia-matrix.ipynb#cell-id=03-legs", "no cell"),
        ("../../lessons/03-inertia-matrix.ipynb#2-·-From-the-bodies-to-the-arm", "does not go"),
        ("../../lessons/03-inertia.ipynb", "no such file"),
        ("../lessons/03-inertia-matrix.ipynb", "no such file"),
        ("../p3-pendulum/p3-pendulum.ipynb", ""),
        ("#cell-id=p1-c", ""),
    ],
)
def test_a_link_to_nothing_is_noticed(target, wrong):
    page = ROOT / "problems" / "p1-inertia" / "p1-inertia.ipynb"
    said = leads_nowhere(page, target)
    assert wrong in said
    assert bool(said) == bool(wrong)
