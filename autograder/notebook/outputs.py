"""A cell's outputs as a notebook stores them, and as much of a student's as a page may show.

nbformat's own makers check each output against its schema, which takes longer than to make it; here the
notebook is checked once, as a whole.
"""

import json
import re

from nbformat import NotebookNode

from autograder.judging import card
from autograder.judging.verdict import Verdict
from autograder.protocol import shortened

SHOWN = ("text/plain", "text/latex", "image/png")
# The runner sends no more; a forged reply may.
MOST_TEXT = 200_000
MOST_PICTURE = 4 << 20
# Of a whole notebook, in bytes as it is saved. A page of 2 MB of text is more than anybody reads, and
# a browser still opens it; the figures of the course's own problems come to less than 1 MB each.
NOTEBOOK_TEXT = 2 << 20
NOTEBOOK_PICTURES = 16 << 20
TOO_MUCH = (
    f"a notebook's outputs may take {NOTEBOOK_TEXT >> 20} MB of text and "
    f"{NOTEBOOK_PICTURES >> 20} MB of pictures in all"
)
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


class Allowance:
    """What the outputs of a notebook may take together; in each cell a sentence stands for the rest."""

    def __init__(self):
        self._text, self._pictures = NOTEBOOK_TEXT, NOTEBOOK_PICTURES

    def shown(self, outputs: list[dict]) -> list[NotebookNode]:
        """The outputs of one cell, as many as there is room for."""
        written = [output for output in map(of_student, outputs) if output]
        kept = [output for output in written if self._has_room_for(output)]
        if len(kept) < len(written):
            left_out = len(written) - len(kept)
            kept.append(
                stream("stderr", f"({left_out} of this cell's outputs left out: {TOO_MUCH})")
            )
        return kept

    def _has_room_for(self, output: NotebookNode) -> bool:
        size = len(json.dumps(output, ensure_ascii=False).encode(errors="replace"))
        pictures = len(output.get("data", {}).get("image/png", ""))
        if size - pictures > self._text or pictures > self._pictures:
            return False
        self._text -= size - pictures
        self._pictures -= pictures
        return True


def _is_shown(kind: str, data) -> bool:
    """Whether a feedback page may hold it: text of a decent length, and pictures that are no markup."""
    if not isinstance(data, str):
        return False
    if kind != "image/png":
        return len(data) <= MOST_TEXT
    return (
        len(data) <= MOST_PICTURE and re.fullmatch(r"[A-Za-z0-9+/\s]*={0,2}\s*", data) is not None
    )
