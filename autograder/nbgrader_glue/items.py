"""Puts a graded notebook's cells in the order of the feedback page: each graded answer with its title,
what went wrong before what is right, and the problem's own text at the end.
"""

import copy
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from nbformat import NotebookNode

from autograder.notebook.editions import Edition, texts_of
from autograder.notebook.grade import is_judged
from autograder.notebook.letter import HEAD, is_letter
from autograder.notebook.outputs import read_verdict
from autograder.notebook.recognise import grade_id
from autograder.notebook.released import essence
from autograder.notebook.scores import could_not_be_judged
from autograder.problems import check_here

UNREAD = "unread"  # in a graded cell's settings: a person has not decided on it yet
ROWS = "rows"  # there: the rows of the rubric, with the points that a person gave for each
NO_RESPONSE = "No response."  # as nbgrader says it
HEADING = re.compile(r"^#{1,6}[ \t]+(.+?)[ \t#]*$", re.MULTILINE)
# "A. The matrix of the arm (4 points)": only the words are the title.
NUMBER = re.compile(r"^[A-Z0-9]{1,2}[.)] +")
POINTS = re.compile(r" *\([^()]*\bpoints?\b[^()]*\)$")
FIRST, WRONG, RIGHT, REST, TEXT = (
    "From the grader, about this notebook",
    "What to look at",
    "What is right",
    "What else your notebook shows",
    "The text of the problem, and cells that show nothing",
)


@dataclass
class Item:
    """A graded answer: the cells from the answer to the cell that has its points.

    kind: "wrong", "open" (a person still has to read it) or "right". rows: of the rubric, each with its
    text, points and what was given.
    """

    id: str
    title: str
    kind: str
    state: str
    score: str
    points: str
    cells: list[NotebookNode] = field(default_factory=list)
    comments: list[str] = field(default_factory=list)
    rows: list[dict] = field(default_factory=list)


def arranged(
    notebook: NotebookNode, source: NotebookNode | None, earlier: Sequence[Edition] = ()
) -> tuple[NotebookNode, list[Item]]:
    """A copy of a notebook that holds its grades, its cells in the order of the page, and the items.

    source: the assignment's own notebook; without it, each text counts as a student's, but for those of
    the editions that students may have. Each cell's metadata say, under "page", what begins and ends
    with it.
    """
    notebook = copy.deepcopy(notebook)
    for cell in notebook.cells:
        cell.metadata["page"] = NotebookNode()
    given, headings = _given(source) | texts_of(earlier), titles_above(source or notebook)
    items, taken = _items(notebook.cells, given, headings)
    others = [cell for cell in notebook.cells if id(cell) not in taken]
    letters = [cell for cell in others if is_letter(cell)]
    shown = [cell for cell in others if not is_letter(cell) and _shows(cell, given)]
    rest = {id(cell) for cell in (*letters, *shown)}
    _name_places(shown, notebook.cells, headings)
    items = [one for kinds in (("wrong", "open"), ("right",)) for one in items if one.kind in kinds]
    cells = [
        *_section(FIRST, letters),
        *_section(WRONG, _cells_of(item for item in items if item.kind != "right")),
        *_section(RIGHT, _cells_of(item for item in items if item.kind == "right")),
        *_section(REST, shown),
        *_section(TEXT, [cell for cell in others if id(cell) not in rest], folded=True),
    ]
    for cell in cells:
        _tidy(cell)
    notebook.cells = cells
    return notebook, items


def title_of(notebook: NotebookNode) -> str:
    """The first heading; "" if there is none."""
    texts = (cell.source for cell in notebook.cells if cell.cell_type == "markdown")
    return next((found[1] for found in map(HEADING.search, texts) if found), "")


def _items(
    cells: list[NotebookNode], given: set[str], headings: dict[str, str]
) -> tuple[list[Item], set[int]]:
    """The items in order, and the ids of the cells that they have."""
    items: list[Item] = []
    taken: set[int] = set()
    begun: list[NotebookNode] = []
    for position, cell in enumerate(cells):
        claims = cell.metadata.get("nbgrader") or {}
        has_points = bool(claims.get("grade") or claims.get("task"))
        if not has_points:
            # An answer, and what stands between it and its points, but for the problem's own text.
            if claims.get("solution") or (begun and not _is_given(cell, given)):
                begun.append(cell)
            continue
        own = [*begun, cell]
        if not is_judged(cell):
            # A text may begin above its cell, or go on below it.
            above = _beside(reversed(cells[: position - len(begun)]), given)
            own = [*reversed(above), *own, *_beside(cells[position + 1 :], given)]
            own = [one for one in own if id(one) not in taken]
        items.append(_item(cell, own, headings))
        taken |= set(map(id, own))
        begun = []
    return items, taken


def _item(cell: NotebookNode, cells: list[NotebookNode], headings: dict[str, str]) -> Item:
    claims, name = cell.metadata["nbgrader"], grade_id(cell) or ""
    score, points = float(claims.get("score") or 0), float(claims.get("points") or 0)
    found = next(filter(None, map(read_verdict, cell.get("outputs", []))), None)
    state, kind = "marked", "right" if score >= points else "wrong"
    if found:
        state = str(found["state"])
        kind = "open" if could_not_be_judged(cell) else kind
    elif claims.get(UNREAD):
        state, kind = "not yet read", "open"
    elif score >= points:
        state = "full marks"
    # Of lines that were left empty, their card speaks already.
    comments = [
        said
        for one in cells
        if (said := (one.metadata.get("nbgrader") or {}).get("comment"))
        and (one is cell or said != NO_RESPONSE)
    ]
    return Item(
        name,
        _title(cell, headings.get(name, "")),
        kind,
        state,
        number(score),
        number(points),
        cells,
        comments,
        list(claims.get(ROWS) or []),
    )


def _title(cell: NotebookNode, heading: str) -> str:
    """The function's name, and what is asked of it; for a text, the heading above it."""
    name = grade_id(cell) or ""
    if not is_judged(cell):
        return heading or name
    check = check_here(name)
    function = check.name if check else name.rpartition("-")[2]
    asked = check.criteria[0].text if check and len(check.criteria) == 1 else heading
    return f"{function}: {asked}" if asked else function


def number(points: float) -> str:
    """Points as people write them: "2", "1.5"."""
    return f"{round(points, 2):g}"


def _cells_of(items: Iterable[Item]) -> list[NotebookNode]:
    cells = []
    for item in items:
        shown = {name: value for name, value in vars(item).items() if name != "cells"}
        item.cells[0].metadata["page"]["item"] = NotebookNode(shown)
        item.cells[-1].metadata["page"]["ends_item"] = True
        cells += item.cells
    return cells


def _section(title: str, cells: list[NotebookNode], folded: bool = False) -> list[NotebookNode]:
    if cells:
        cells[0].metadata["page"]["section"] = NotebookNode(title=title, folded=folded)
        cells[-1].metadata["page"]["ends_section"] = "details" if folded else "section"
    return cells


def _given(source: NotebookNode | None) -> set[str]:
    return {essence(cell.source) for cell in source.cells} if source else set()


def titles_above(notebook: NotebookNode) -> dict[str, str]:
    """grade_id → the heading above the cell, without its letter and its points."""
    found: dict[str, str] = {}
    heading = ""
    for cell in notebook.cells:
        if name := grade_id(cell):
            found[name] = heading
        elif cell.cell_type == "markdown" and (last := HEADING.findall(cell.source)):
            heading = POINTS.sub("", NUMBER.sub("", last[-1]))
    return found


def _name_places(
    shown: list[NotebookNode], cells: list[NotebookNode], headings: dict[str, str]
) -> None:
    """Give each first cell of a part of the notebook the part's heading."""
    wanted, last = set(map(id, shown)), ""
    for position, cell in enumerate(cells):
        if id(cell) in wanted:
            named = (
                headings.get(grade_id(one) or "", "") for one in reversed(cells[: position + 1])
            )
            heading = next(filter(None, named), "")
            if heading and heading != last:
                cell.metadata["page"]["heading"] = last = heading


def _is_given(cell: NotebookNode, given: set[str]) -> bool:
    return not grade_id(cell) and essence(cell.source) in given


def _shows(cell: NotebookNode, given: set[str]) -> bool:
    """Whether a cell that belongs to no answer is the student's own, or has outputs."""
    if cell.get("outputs"):
        return True
    return not grade_id(cell) and bool(cell.source.strip()) and not _is_given(cell, given)


def _is_own(cell: NotebookNode, given: set[str]) -> bool:
    return not grade_id(cell) and not _is_given(cell, given) and not is_letter(cell)


def _beside(cells: Iterable[NotebookNode], given: set[str]) -> list[NotebookNode]:
    """A student's own cells, up to the next cell that belongs to the assignment's answers."""
    found = []
    for cell in cells:
        if grade_id(cell):
            break
        if _is_own(cell, given):
            found.append(cell)
    return found


def _tidy(cell: NotebookNode) -> None:
    """Fold a locked cell's code, and leave out what the page says in another way."""
    claims = cell.metadata.get("nbgrader") or {}
    if is_letter(cell):
        cell.source = cell.source.removeprefix(HEAD).strip()
    if cell.cell_type != "code":
        return
    if claims and not claims.get("solution"):
        cell.metadata["page"]["input"] = "folded"
    if any(map(read_verdict, cell.outputs)):
        cell.outputs = [one for one in cell.outputs if one.output_type != "execute_result"]
