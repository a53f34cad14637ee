"""Changes a page's text, or a docstring, as Sphinx reads it.

The files that a reader can fetch stay as they are.
"""

import json
import re
from functools import cache
from pathlib import Path

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from docs import diagrams

CELL_LINK = re.compile(r"\]\([^)\s]*#cell-id=([\w-]+)\)")
SOLUTIONS = re.compile(r"(\]\((?:\.\./)*)solutions/")
# The tests of the autograder hold right answers, so no page leads to them.
NOT_SERVED = re.compile(
    r"\[([^\[\]]+)\]\((?:\.\./)*(?:tests/(?:autograder|submissions)|autograder)/[^)]*\)"
)
# What JupyterLab folds, as myst-nb calls it.
FOLDED = {
    ("source_hidden",): "hide-input",
    ("outputs_hidden",): "hide-output",
    ("outputs_hidden", "source_hidden"): "hide-cell",
}
CODE = re.compile(r"(`+)(.+?)\1", re.DOTALL)


class Mermaid(SphinxDirective):
    """A fence of Mermaid, as an SVG in the page, which takes the page's colours."""

    has_content = True

    def run(self) -> list[nodes.Node]:
        drawing = diagrams.svg("\n".join(self.content))
        return [nodes.raw("", f'<div class="diagram">{drawing}</div>', format="html")]


def page_text(name: str, text: str, controls: dict[str, str] | None = None) -> str:
    """What Sphinx reads as the page `name` (without its extension), where the file holds `text`.

    controls: by the id of its cell, the HTML that a control is on the page.
    """
    if not name.startswith(("lessons/", "problems/")):
        return links(text)
    notebook = json.loads(text)
    story_only = name.startswith("problems/")
    notebook["cells"] = [cell for cell in notebook["cells"] if not story_only or is_told(cell)]
    for cell in notebook["cells"]:
        if cell["cell_type"] == "markdown":
            cell["source"] = f"({cell['id']})=\n{links(''.join(cell['source']))}"
        folded = tuple(sorted(k for k, v in cell["metadata"].get("jupyter", {}).items() if v))
        if folded in FOLDED:
            tags = cell["metadata"].get("tags", [])
            cell["metadata"]["tags"] = [*tags, FOLDED[folded]]
        if controls and cell["id"] in controls:
            output = {"output_type": "display_data", "metadata": {}}
            cell["outputs"] = [output | {"data": {"text/html": controls[cell["id"]]}}]
    return json.dumps(notebook)


def links(text: str) -> str:
    """The text with each link to a cell as a link to its label, and problems for solutions."""
    text = NOT_SERVED.sub(r"\1", CELL_LINK.sub(r"](#\1)", text))
    return SOLUTIONS.sub(r"\1problems/", text)


def docstring(text: str) -> str:
    """A docstring, which has code between backticks and no other markup, as reStructuredText."""
    parts = CODE.split(text)  # text, backticks, code, text, …
    for i in range(2, len(parts), 3):
        before = r"\ " if parts[i - 2][-1:].isalnum() else ""
        after = r"\ " if parts[i + 1][:1].isalnum() else ""
        parts[i] = f"{before}``{parts[i].strip()}``{after}"
    parts[0::3] = map(_plain, parts[0::3])
    del parts[1::3]
    return "".join(parts)


def _plain(text: str) -> str:
    """Its letters that are markup, but for the star of a list, as letters."""
    return re.sub(r"([\\|_]|\*(?! ))", r"\\\1", text)


def is_told(cell: dict) -> bool:
    """Whether a cell is text of the course's, and no place for an answer."""
    place = cell["metadata"].get("nbgrader", {}).get("solution")
    return cell["cell_type"] == "markdown" and not place


def _read(app: Sphinx, name: str, source: list[str]) -> None:
    source[0] = page_text(name, source[0], _controls(app.config.controls_folder))


@cache
def _controls(folder: str) -> dict[str, str]:
    return {path.stem: path.read_text(encoding="utf-8") for path in Path(folder).glob("*.html")}


def _read_docstring(app: Sphinx, what, name, obj, options, lines: list[str]) -> None:
    lines[:] = docstring("\n".join(lines)).split("\n")


def _skip(app: Sphinx, what, name, obj, skip: bool, options) -> bool | None:
    """Leaves out what a module of armdyn has from another library."""
    of = getattr(obj, "__module__", None) or "armdyn"
    return None if of.startswith("armdyn") else True


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_config_value("controls_folder", "", "env", str)
    app.add_directive("mermaid", Mermaid)
    app.connect("source-read", _read)
    app.connect("autodoc-skip-member", _skip)
    app.connect("autodoc-process-docstring", _read_docstring)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
