"""Mermaid diagrams as SVG, drawn when the site or the book is made: no page runs a script for them."""

import hashlib
import re

import mermaidx

# As text and not as HTML inside the SVG, which Typst would leave out.
SETTINGS = """---
config:
  theme: neutral
  htmlLabels: false
  flowchart:
    htmlLabels: false
---
"""


def svg(source: str) -> str:
    """The diagram as one SVG element; its ids are its own, so that a page can have several.

    Raises what mermaidx raises if Mermaid cannot read the source.
    """
    drawn = mermaidx.render(SETTINGS + source).svg()
    name = f"diagram-{hashlib.sha256(source.encode()).hexdigest()[:8]}"
    return re.sub(r"my-svg", name, drawn)
