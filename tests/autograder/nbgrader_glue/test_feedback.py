"""A feedback page is made without warnings that nobody can act on."""

import logging
from functools import partial
from pathlib import Path

import pytest
from bs4 import BeautifulSoup
from nbconvert.exporters import HTMLExporter
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output

from autograder.nbgrader_glue import feedback, pages
from autograder.nbgrader_glue.release import configuration

ROOT = Path(__file__).parents[3]
ALONE = {"index": 0, "total": 1}  # of the notebooks of a submission
PIXEL = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awA"
PIXEL += "AAABJRU5ErkJggg=="


@pytest.fixture
def exporter(monkeypatch):
    """nbgrader makes it for a converter with notebooks; here there is none."""
    monkeypatch.setattr(feedback, "leave_out_unfit", lambda converter: None)
    monkeypatch.setattr(feedback, "can_start", lambda converter: None)
    settings = {"config": configuration(ROOT), "template_name": "feedback"}
    return partial(feedback.FeedbackExporter, **settings)


def test_a_students_figure_has_an_alternative_text_and_there_is_no_warning(exporter, caplog):
    figures = [
        new_output("display_data", data={"image/png": PIXEL}, metadata=about)
        for about in ({}, {"image/png": {"alt": "the arm"}})
    ]
    notebook = new_notebook(cells=[new_code_cell("plot()", outputs=figures)])
    log = logging.getLogger("nbgrader.test")
    with caplog.at_level(logging.WARNING, log.name):
        page, _ = exporter(log=log).from_notebook_node(notebook, ALONE)
    said = [one["alt"] for one in BeautifulSoup(page, "html.parser").select("img")]
    assert said == ["a figure without a description", "the arm"]
    assert page.count(PIXEL) == 2
    assert caplog.records == []


def test_a_page_is_what_nbconvert_makes_of_our_templates(exporter, monkeypatch):
    """Ours leaves out nbconvert's last step alone, which a new nbconvert may change."""
    drawn = new_output("display_data", data={"text/html": "<b>M</b>", "text/plain": "M"})
    notebook = new_notebook(
        metadata={"language_info": {"name": "ipython", "pygments_lexer": "ipython3"}},
        cells=[new_code_cell("def M(q):\n    return 1", outputs=[drawn]), new_markdown_cell("$q$")],
    )
    ours, _ = exporter().from_notebook_node(notebook, ALONE)
    theirs = HTMLExporter.from_notebook_node
    monkeypatch.setattr(pages.PageExporter, "from_notebook_node", theirs)
    theirs, _ = exporter().from_notebook_node(notebook, ALONE)
    assert BeautifulSoup(ours, "html.parser") == BeautifulSoup(theirs, "html.parser")
