"""Writes the feedback pages of `nbgrader generate_feedback`."""

import copy
import logging
import re
from pathlib import Path

from nbconvert.exporters import HTMLExporter

from autograder.nbgrader_glue.late import settle_before
from autograder.nbgrader_glue.names import leave_out_unfit
from autograder.nbgrader_glue.start import can_start
from autograder.nbgrader_glue.worked import with_answers

# Without, nbgrader's page is as wide on a phone as on a desk, and its prompts take a third of that.
HEAD = """<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
img, svg { max-width: 100%; height: auto; }
.MathJax_Display, .rendered_html table { display: block; max-width: 100%; overflow-x: auto; }
@media (max-width: 640px) {
  div.prompt { display: none; }
  .container, #notebook-container, .panel-body { padding: 4px; }
  div.inner_cell, div.output_subarea, div.text_cell_render { min-width: 0; max-width: 100%; }
  div.output_subarea { overflow-x: visible; }
  pre, code { white-space: pre-wrap; overflow-wrap: anywhere; word-break: normal; }
  h1, h2, h3, h4, p, li { overflow-wrap: anywhere; }
  div.nbgrader_cell .panel-heading { height: auto; overflow: hidden; }
}
</style>
</head>"""
MARKER = re.compile(r"^\s*### (BEGIN|END) HIDDEN TESTS[^\S\n]*\n?", re.MULTILINE)


class FeedbackExporter(HTMLExporter):
    """nbconvert's exporter, for the students whose names nbgrader can handle.

    nbgrader makes it when it has found the graded notebooks, and before it changes anything.
    """

    def __init__(self, config=None, **kw):
        super().__init__(config=config, **kw)
        leave_out_unfit(self.parent)
        can_start(self.parent)
        if self.parent is not None:
            settle_before(self.parent)

    def from_notebook_node(self, nb, resources=None, **kw):
        """nbconvert's page, with the worked answers that are open to the student, fit for a phone.

        It has no marker of a hidden test, and no warning that most students' figures have no alternative
        text.
        """
        names = (resources or {}).get("nbgrader", {})
        if self.parent is not None and "student" in names:
            root = Path(self.parent.coursedir.root)
            nb = with_answers(nb, root, names["assignment"], names["student"])
        nb = _without_markers(nb)
        log = getattr(self.log, "logger", self.log)
        log.addFilter(_is_worth_saying)
        try:
            page, resources = super().from_notebook_node(nb, resources, **kw)
        finally:
            log.removeFilter(_is_worth_saying)
        return page.replace("</head>", HEAD, 1), resources


def _without_markers(nb):
    """The notebook without the lines that tell nbgrader where a hidden test begins and ends."""
    nb = copy.deepcopy(nb)
    for cell in nb.cells:
        if cell.cell_type == "code":
            cell.source = MARKER.sub("", cell.source).rstrip("\n")
    return nb


def _is_worth_saying(record: logging.LogRecord) -> bool:
    return not str(record.msg).startswith("Alternative text is missing")
