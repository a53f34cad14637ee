"""What a card in a student's notebook ends with: where to go on."""

import re
from html import escape
from pathlib import Path

from autograder.judging.card import Line
from autograder.judging.section import Section
from autograder.judging.verdict import State, Verdict
from autograder.problems import known_check
from autograder.student import progress, solution

LESSONS = Path("../../lessons")  # from a problem's notebook


def lines(verdict: Verdict) -> list[Line]:
    """The hint to call and the section to read, if the answer is not right; the notebook's points."""
    found = []
    if verdict.state not in (State.CORRECT, State.CHECK_FAILED):
        check = known_check(verdict.check)
        if check.hints:
            found.append(_hint(check.id))
        if check.section:
            found.append(_section(check.section))
    elif verdict.check in solution.opened():
        found.append(_worked_answer(verdict.check))
    if points := progress.of(verdict.check):
        found.append(_points(str(points)))
    return found


def lines_of_derivation(id: str, is_complete: bool) -> list[Line]:
    """The hint to call, or where the derivation is complete, the worked lines if they are open."""
    if not is_complete:
        return [_hint(id)]
    return [_worked_answer(id)] if id in solution.opened() else []


def _hint(id: str) -> Line:
    return _call("Stuck? Run {} for a hint. Hints cost no points.", f'hint("{id}")')


def _worked_answer(id: str) -> Line:
    call = f'from autograder import solution; solution("{id}")'
    return _call("A worked answer is open: {}.", call)


def _call(said: str, call: str) -> Line:
    """A sentence with a call in it, which is shown as code."""
    return Line(said.format(call), said.format(f"<code>{escape(call)}</code>"))


def _section(section: Section) -> Line:
    """A link, where the lesson lies where a problem's notebook finds it."""
    said = f"Lesson {section.number} prepares this: {{}}."
    path = LESSONS / section.file
    if not path.is_file():
        return Line(said.format(section.heading))
    link = f"{path.as_posix()}#cell-id={section.cell}"
    shown = f'<a href="{escape(link)}">{escape(section.heading)}</a>'
    return Line(f"{said.format(section.heading)} ({path.as_posix()})", said.format(shown))


def _points(said: str) -> Line:
    """The sentence; no line ends within the name of a check, after a hyphen."""
    kept = r'<span style="white-space: nowrap">\1</span>'
    return Line(said, re.sub(r"(\S+ \([\d.]+\))", kept, escape(said)))
