"""Writes the feedback pages of `nbgrader generate_feedback`."""

import logging
from pathlib import Path

from nbconvert.exporters import HTMLExporter

from autograder.nbgrader_glue.names import leave_out_unfit
from autograder.nbgrader_glue.start import can_start
from autograder.nbgrader_glue.worked import with_answers


class FeedbackExporter(HTMLExporter):
    """nbconvert's exporter, for the students whose names nbgrader can handle.

    nbgrader makes it when it has found the graded notebooks, and before it changes anything.
    """

    def __init__(self, config=None, **kw):
        super().__init__(config=config, **kw)
        leave_out_unfit(self.parent)
        can_start(self.parent)

    def from_notebook_node(self, nb, resources=None, **kw):
        """nbconvert's page, with the worked answers that are open to the student.

        It has no warning that most students' figures have no alternative text.
        """
        names = (resources or {}).get("nbgrader", {})
        if self.parent is not None and "student" in names:
            root = Path(self.parent.coursedir.root)
            nb = with_answers(nb, root, names["assignment"], names["student"])
        log = getattr(self.log, "logger", self.log)
        log.addFilter(_is_worth_saying)
        try:
            return super().from_notebook_node(nb, resources, **kw)
        finally:
            log.removeFilter(_is_worth_saying)


def _is_worth_saying(record: logging.LogRecord) -> bool:
    return not str(record.msg).startswith("Alternative text is missing")
