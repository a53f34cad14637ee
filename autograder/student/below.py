"""What a card in a student's notebook ends with: where to go on."""

import re
from collections.abc import Iterable
from html import escape
from pathlib import Path

from autograder.judging.card import Line
from autograder.judging.section import Section
from autograder.judging.verdict import State, Verdict
from autograder.problems import known_check
from autograder.student import progress, solution

LESSONS = Path("../../lessons")  # from a problem's notebook


def lines(verdict: Verdict, pictures: Iterable[Line] = ()) -> list[Line]:
    """If the answer is not right: the hint to call, the pictures of it, the section to read."""
    if verdict.state in (State.CORRECT, State.CHECK_FAILED):
        return _worked_answer(verdict.check)
    check = known_check(verdict.check)
    found = [_hint(check.id)] if check.hints else []
    found += pictures
    return [*found, _section(check.section)] if check.section else found


def lines_of_derivation(id: str, is_complete: bool) -> list[Line]:
    """The hint to call, or where the derivation is complete, the worked lines if they are open."""
    return _worked_answer(id) if is_complete else [_hint(id)]


def _hint(id: str) -> Line:
    said = "Stuck? Run {} for a hint. Hints cost no points."
    return Line.with_code(said, f'hint("{id}")')


def _worked_answer(id: str) -> list[Line]:
    """That the worked answer is open, and the call that shows it; nothing while it is not."""
    if id not in solution.opened():
        return []
    call = f'from autograder import solution; solution("{id}")'
    return [Line.with_code("A worked answer is open: {}.", call)]


def points(verdict: Verdict) -> list[Line]:
    """How many of the notebook's points are checked, and folded below it which are not."""
    found = progress.of(verdict.check)
    if not found:
        return []
    text = str(found)
    if not found.rest:
        return [Line(text)]
    items = "".join(f"<li>{_unbroken(item)}</li>" for item in found.rest)
    summary = f'<summary style="cursor: pointer">{escape(text)}</summary>'
    return [Line(text, f'<details>{summary}<ul style="margin: 0.2em 0">{items}</ul></details>')]


def _section(section: Section) -> Line:
    """A link, where the lesson lies where a problem's notebook finds it."""
    end = "" if section.heading.endswith(("?", "!", ".")) else "."
    said = f"Lesson {section.number} prepares this: {{}}{end}"
    path = LESSONS / section.file
    if not path.is_file():
        return Line(said.format(section.heading))
    link = f"{path.as_posix()}#cell-id={section.cell}"
    shown = f'<a href="{escape(link)}">{escape(section.heading)}</a>'
    return Line(f"{said.format(section.heading)} ({path.as_posix()})", said.format(shown))


def _unbroken(said: str) -> str:
    """The text; no line ends within the name of a check, after a hyphen."""
    kept = r'<span style="white-space: nowrap">\1</span>'
    return re.sub(r"(\S+ \([\d.]+\))", kept, escape(said))
