"""A cell's outputs as a notebook stores them, and as much of a student's as a page may show.

nbformat's own makers check each output against its schema, which takes longer than to make it; here the
notebook is checked once, as a whole.
"""

import re

from nbformat import NotebookNode

from autograder import card
from autograder.verdict import Verdict
from autograder.wall import shortened

SHOWN = ("text/plain", "text/latex", "image/png")
# The runner sends no more; a forged reply may.
MOST_TEXT = 200_000
MOST_PICTURE = 4 << 20
# Under this key the output that shows a verdict carries it for programs, too.
VERDICT = "armdyn"


def stream(name: str, text: str) -> NotebookNode:
    return NotebookNode(output_type="stream", name=name, text=text)


def display(data: dict[str, str], metadata: dict | None = None) -> NotebookNode:
    shown = {"data": NotebookNode(data), "metadata": NotebookNode(metadata or {})}
    return NotebookNode(output_type="display_data", **shown)


def result(text: str) -> NotebookNode:
    """What the last expression of a cell gave."""
    shown = {"data": NotebookNode({"text/plain": text}), "metadata": NotebookNode()}
    return NotebookNode(output_type="execute_result", execution_count=1, **shown)


def error(name: str, value: str, lines: list[str]) -> NotebookNode:
    return NotebookNode(output_type="error", ename=name, evalue=value, traceback=lines)


def of_verdict(verdict: Verdict) -> NotebookNode:
    """The card, which also carries what `read_verdict` gives."""
    said = {
        "check": verdict.check,
        "state": verdict.state.value,
        "credit": verdict.credit,
        "diagnosis": list(verdict.diagnosis),
    }
    return display(card.mimebundle(verdict), {VERDICT: said})


def read_verdict(output: dict) -> dict | None:
    """check, state, credit and diagnosis of the verdict that an output shows; None for any other."""
    return output.get("metadata", {}).get(VERDICT)


def of_student(output: dict) -> NotebookNode | None:
    """An output that came through the wall, whatever it holds; None where nothing of it can be shown."""
    match output:
        case {"output_type": "stream", "name": "stdout" | "stderr" as name, "text": str(text)}:
            return stream(name, shortened(text, MOST_TEXT))
        case {"output_type": "display_data", "data": dict(data)}:
            shown = {kind: data[kind] for kind in SHOWN if _is_shown(kind, data.get(kind))}
            return display(shown) if shown else None
        case {"output_type": "error", "ename": str(name), "evalue": str(value)}:
            lines = output.get("traceback")
            text = "\n".join(map(str, lines)) if isinstance(lines, list) else ""
            lines = shortened(text, MOST_TEXT).split("\n") if text else []
            return error(shortened(name), shortened(value), lines)
    return stream("stderr", "(an output that could not be read)")


def _is_shown(kind: str, data) -> bool:
    """Whether a feedback page may hold it: text of a decent length, and pictures that are no markup."""
    if not isinstance(data, str):
        return False
    if kind != "image/png":
        return len(data) <= MOST_TEXT
    return (
        len(data) <= MOST_PICTURE and re.fullmatch(r"[A-Za-z0-9+/\s]*={0,2}\s*", data) is not None
    )
