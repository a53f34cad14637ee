"""Makes a cell's outputs, and keeps of a student's as much as a page may show.

nbformat's own functions check each output against its schema, which takes longer than making it; the
notebook is checked once instead, as a whole.
"""

import json
import re

from nbformat import NotebookNode

from autograder.judging import card
from autograder.judging.verdict import Verdict
from autograder.proofs import card as proof_card
from autograder.proofs.marks import Marked
from autograder.protocol import shortened

PICTURES = ("image/png", "image/jpeg", "image/svg+xml")
SHOWN = ("text/plain", "text/latex", *PICTURES)
# The runner sends no more; a forged reply may.
MOST_TEXT = 200_000
MOST_PICTURE = 4 << 20
# For a whole notebook, in bytes as saved. Nobody reads 2 MB of text, but a browser still opens a page
# with it; the figures of the course's own problems come to less than 1 MB each.
NOTEBOOK_TEXT = 2 << 20
NOTEBOOK_PICTURES = 16 << 20
TOO_MUCH = (
    f"a notebook's outputs may take {NOTEBOOK_TEXT >> 20} MB of text and "
    f"{NOTEBOOK_PICTURES >> 20} MB of pictures in all"
)
# Under this key, the output that shows a verdict also holds it for programs.
VERDICT = "armdyn"
MARKS = "armdyn_derivation"


def stream(name: str, text: str) -> NotebookNode:
    return NotebookNode(output_type="stream", name=name, text=text)


def display(data: dict[str, str], metadata: dict | None = None) -> NotebookNode:
    shown = {"data": NotebookNode(data), "metadata": NotebookNode(metadata or {})}
    return NotebookNode(output_type="display_data", **shown)


def result(text: str) -> NotebookNode:
    """The value of a cell's last expression."""
    shown = {"data": NotebookNode({"text/plain": text}), "metadata": NotebookNode()}
    return NotebookNode(output_type="execute_result", execution_count=1, **shown)


def error(name: str, value: str, lines: list[str]) -> NotebookNode:
    return NotebookNode(output_type="error", ename=name, evalue=value, traceback=lines)


def of_verdict(verdict: Verdict) -> NotebookNode:
    """The card; its metadata hold what `read_verdict` gives."""
    said = {
        "check": verdict.check,
        "state": verdict.state.value,
        "credit": verdict.credit,
        "problem": verdict.problem,
        "diagnosis": list(verdict.diagnosis),
        "rows": [{"text": row.text, "met": row.met} for row in verdict.rows],
    }
    return display(card.mimebundle(verdict), {VERDICT: said})


def of_marks(marked: Marked) -> NotebookNode:
    """The card of a derivation, without what only its writer needs; its metadata hold what `read_marks`
    gives.
    """
    said = {
        "derivation": marked.derivation.id,
        "done": marked.done,
        "lines": len(marked.lines),
        "first_wrong": next((line.said for line in marked.lines if not line.holds), ""),
    }
    return display(proof_card.mimebundle(marked, with_names=False), {MARKS: said})


def read_verdict(output: dict) -> dict | None:
    """check, state, credit, problem, diagnosis and rows of an output's verdict; None for any other.

    One that an earlier version of the course wrote may have no rows and no problem.
    """
    return output.get("metadata", {}).get(VERDICT)


def read_marks(output: dict) -> dict | None:
    """derivation, done, how many lines and first_wrong, the sentence on the first line that does not
    hold, of the marked derivation that an output shows; None for any other.
    """
    return output.get("metadata", {}).get(MARKS)


def of_student(output: dict) -> NotebookNode | None:
    """An output from the sandbox, whatever it holds; None if nothing of it can be shown."""
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
    return stream("stderr", "(the grader could not read this output)")


class Allowance:
    """What a notebook's outputs may take together; a sentence in the cell replaces the rest."""

    def __init__(self):
        self._text, self._pictures = NOTEBOOK_TEXT, NOTEBOOK_PICTURES

    def shown(self, outputs: list[dict]) -> list[NotebookNode]:
        """The outputs of one cell, as many as there is room for."""
        written = [output for output in map(of_student, outputs) if output]
        kept = [output for output in written if self._has_room_for(output)]
        if len(kept) < len(written):
            left_out = len(written) - len(kept)
            kept.append(
                stream(
                    "stderr", f"(the grader left out {left_out} of this cell's outputs: {TOO_MUCH})"
                )
            )
        return kept

    def _has_room_for(self, output: NotebookNode) -> bool:
        size = len(json.dumps(output, ensure_ascii=False).encode(errors="replace"))
        data = output.get("data", {})
        pictures = sum(len(data.get(kind, "").encode(errors="replace")) for kind in PICTURES)
        if size - pictures > self._text or pictures > self._pictures:
            return False
        self._text -= size - pictures
        self._pictures -= pictures
        return True


def _is_shown(kind: str, data) -> bool:
    """Whether a feedback page may hold it: text that is not too long, or a picture."""
    if not isinstance(data, str):
        return False
    if kind not in PICTURES:
        return len(data) <= MOST_TEXT
    if len(data) > MOST_PICTURE:
        return False
    if kind == "image/svg+xml":
        return _is_drawing(data)
    return re.fullmatch(r"[A-Za-z0-9+/\s]*={0,2}\s*", data) is not None


def _is_drawing(text: str) -> bool:
    """Whether a browser can draw it; a page shows it as a picture, in which no script runs."""
    from defusedxml import ElementTree

    try:
        return str(ElementTree.fromstring(text.encode()).tag).endswith("svg")
    except Exception:  # no XML, or XML that unfolds itself without end
        return False
