"""The rubric of an answer that a person reads: the rows of the table of points in the problem's text."""

import re
from dataclasses import dataclass

from nbformat import NotebookNode

from autograder.notebook.answers import model_answers
from autograder.notebook.grade import is_judged
from autograder.notebook.recognise import grade_id

HEAD = re.compile(r"^[ \t]*\|[ \t]*points?[ \t]*\|[ \t]*for[ \t]*\|[ \t]*$", re.MULTILINE | re.I)
RULE = re.compile(r"[ \t]*\|[ \t:|-]+\|[ \t]*")
LINE = re.compile(r"[ \t]*\|(?P<points>(?:\\.|[^|\\])*)\|(?P<text>.*)\|[ \t]*")
NUMBER = re.compile(r"\d+(?:[.,]\d+)?")


@dataclass(frozen=True)
class Row:
    """points: what it gives when it is met. text: what for, in Markdown."""

    points: float
    text: str


@dataclass(frozen=True)
class Rubric:
    """cell: the answer's grade_id. points: of the whole answer. task, model: what is asked, and the
    model answer, in Markdown. rows: none where the text has no table. fault: what is wrong with the
    table; "" if nothing is.
    """

    cell: str
    points: float
    task: str
    model: str
    rows: tuple[Row, ...]
    fault: str = ""


def rubrics(source: NotebookNode) -> list[Rubric]:
    """Of each answer in an assignment's source that a person reads, in order."""
    models = model_answers(source)
    found, texts = [], list[str]()
    for cell in source.cells:
        claims = cell.metadata.get("nbgrader") or {}
        by_person = claims.get("task") or (claims.get("grade") and claims.get("solution"))
        if cell.cell_type == "markdown" and not grade_id(cell):
            texts.append(cell.source)
        if claims.get("task"):
            texts.append(cell.source)
        if by_person and not is_judged(cell):
            name, points = grade_id(cell) or "", float(claims.get("points") or 0)
            task = _last_section(texts)
            rows, fault = _rows(task, points)
            model = "" if claims.get("task") else models.get(name, "")
            found.append(Rubric(name, points, task, model, tuple(rows), fault))
        if by_person or is_judged(cell):
            texts = []
    return found


def _last_section(texts: list[str]) -> str:
    """What stands above the answer, from the last heading on."""
    heads = [at for at, text in enumerate(texts) if re.match(r"#{1,6}[ \t]", text)]
    return "\n\n".join(texts[heads[-1] if heads else 0 :])


def _rows(task: str, points: float) -> tuple[list[Row], str]:
    """The rows of the last table of points, and what is wrong with them."""
    heads = list(HEAD.finditer(task))
    if not heads:
        return [], ""
    rows, fault = [], ""
    for line in task[heads[-1].end() :].strip("\n").split("\n"):
        if RULE.fullmatch(line):
            continue
        if not (found := LINE.fullmatch(line)):
            break
        given, text = found["points"].strip(), found["text"].strip().replace("\\|", "|")
        if NUMBER.fullmatch(given):
            rows.append(Row(float(given.replace(",", ".")), text))
        else:
            fault = f"A row of the table has no number of points, but {given!r}: {text}"
    total = sum(row.points for row in rows)
    if not fault and abs(total - points) > 1e-9:
        fault = f"The rows of the table give {total:g} points in all, and the answer {points:g}."
    return rows, fault
