"""The text of a source's cells as students get it: stubs for solutions, and no hidden tests."""

import re

from nbformat import NotebookNode

# nbgrader_config.py tells nbgrader to put these in, so that an untouched answer is recognised.
CODE_STUB = "raise NotImplementedError  # your answer goes here"
TEXT_STUB = "*(your answer goes here)*"


def released(cell: NotebookNode) -> str:
    """A source cell's text in the student version."""
    stub = CODE_STUB if cell.cell_type == "code" else TEXT_STUB
    lines, part, solved = [], "", False
    for line in cell.source.split("\n"):
        mark = re.search("(BEGIN|END) (SOLUTION|HIDDEN TESTS|MARK SCHEME)", line)
        if mark:
            part = mark[2] if mark[1] == "BEGIN" else ""
            if part == "SOLUTION":
                solved = True
                lines.append(line[: len(line) - len(line.lstrip())] + stub)
        elif not part:
            lines.append(line)
    is_answer = cell.metadata.get("nbgrader", {}).get("solution")
    return stub if is_answer and not solved else "\n".join(lines)


def essence(text: str) -> str:
    """The text without white space, which editors change by themselves."""
    return "".join(text.split())


def is_as_released(cell: NotebookNode, source: NotebookNode | None) -> bool:
    """Whether an answer is empty or as it was handed out; source: its cell in the source."""
    given = {"", essence(released(source))} if source is not None else {""}
    return essence(cell.source) in given
