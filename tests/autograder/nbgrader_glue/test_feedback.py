"""A feedback page is made without warnings that nobody can act on."""

import logging

import pytest
from nbconvert.exporters import HTMLExporter
from nbformat.v4 import new_code_cell, new_notebook, new_output

from autograder.nbgrader_glue import feedback

PIXEL = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awA"
PIXEL += "AAABJRU5ErkJggg=="


@pytest.fixture
def exporter(monkeypatch):
    """nbgrader makes it for a converter with notebooks; here there is none."""
    monkeypatch.setattr(feedback, "leave_out_unfit", lambda converter: None)
    monkeypatch.setattr(feedback, "can_start", lambda converter: None)
    return feedback.FeedbackExporter


@pytest.mark.parametrize("ours", [True, False])
def test_a_students_figure_without_alternative_text_is_no_warning(exporter, caplog, ours):
    figure = new_output("display_data", data={"image/png": PIXEL})
    notebook = new_notebook(cells=[new_code_cell("plot()", outputs=[figure])])
    log = logging.getLogger("nbgrader.test")
    made = exporter(log=log) if ours else HTMLExporter(log=log)
    with caplog.at_level(logging.WARNING, log.name):
        page, _ = made.from_notebook_node(notebook)
        log.warning("another one")
    assert PIXEL in page
    warned = [record.getMessage() for record in caplog.records]
    assert warned == [
        *([] if ours else ["Alternative text is missing on 1 image(s)."]),
        "another one",
    ]
    assert log.filters == []
