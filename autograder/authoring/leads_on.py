"""Looks where a mechanism's own sections and sentences lead a student: is there such an answer, such a
lesson, such a cell?
"""

import difflib
import json
import re
from collections.abc import Iterator
from pathlib import Path

from autograder.mechanisms import Mechanism
from autograder.mutation.answers import ANSWERS
from autograder.mutation.trial import Line


def led_on(root: Path, mechanism: Mechanism) -> Iterator[Line]:
    """A line for each that leads nowhere; none of the lessons where the folder has no lessons/."""
    for field in ("further", "sections"):
        for answer in getattr(mechanism, field):
            if answer not in ANSWERS:
                yield Line(f"{field} has {answer!r}, which is none of {', '.join(ANSWERS)}", False)
    lessons = root / "lessons"
    if not lessons.is_dir():
        return
    for answer, (lesson, cell, heading) in mechanism.sections.items():
        if why := _missing(lessons, lesson, cell, heading):
            yield Line(f"sections, {answer}: {why}", False)


def _missing(lessons: Path, lesson: str, cell: str, heading: str) -> str:
    """Why there is no such section; "" where there is."""
    path = lessons / f"{lesson}.ipynb"
    if not path.is_file():
        known = sorted(at.stem for at in lessons.glob("*.ipynb"))
        return f"there is no lesson {lesson!r}{_meant(lesson, known)}"
    try:
        headings = _headings(path)
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return f"{path.name} is no notebook that can be read"
    if cell not in headings:
        known = [f"{id!r} ({said[0]})" for id, said in headings.items() if said]
        return f"{lesson} has no cell {cell!r}; its sections begin at {', '.join(known)}"
    said = [one for of_cell in headings.values() for one in of_cell]
    if _plain(heading) not in map(_plain, said):
        return f"{lesson} has no heading {heading!r}{_meant(heading, said)}"
    return ""


def _headings(path: Path) -> dict[str, list[str]]:
    """The headings in each cell of a notebook, by the cell's id."""
    found = {}
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        text = "".join(cell["source"]) if cell["cell_type"] == "markdown" else ""
        found[str(cell.get("id", ""))] = re.findall(r"^#{1,6} +(.+?) *$", text, re.MULTILINE)
    return found


def _plain(heading: str) -> str:
    """Without the signs of a formula, which a card does not show."""
    return re.sub(r"[${}\\]", "", heading)


def _meant(name: str, known: list[str]) -> str:
    near = difflib.get_close_matches(name, known, 1)
    return f"; did you mean {near[0]!r}?" if near else f"; there are {', '.join(known)}"
