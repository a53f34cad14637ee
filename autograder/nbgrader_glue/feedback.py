"""Writes the feedback pages of `nbgrader generate_feedback`."""

from nbconvert.exporters import HTMLExporter

from autograder.nbgrader_glue.names import leave_out_unfit
from autograder.nbgrader_glue.start import can_start


class FeedbackExporter(HTMLExporter):
    """nbconvert's exporter, for the students whose names nbgrader can handle.

    nbgrader makes it when it has found the graded notebooks, and before it changes anything.
    """

    def __init__(self, config=None, **kw):
        super().__init__(config=config, **kw)
        leave_out_unfit(self.parent)
        can_start(self.parent)
