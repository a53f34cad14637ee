"""Shows one student's answer as the feedback page shows it, for the person who marks it."""

import re
import secrets
from functools import cached_property
from html import escape
from pathlib import Path

import nbformat
from nbformat import NotebookNode
from traitlets.config import Config

from autograder.digest import digest
from autograder.marking.book import Written
from autograder.nbgrader_glue.feedback import code_style
from autograder.nbgrader_glue.items import arranged
from autograder.nbgrader_glue.markdown import TAG, markdown2html
from autograder.nbgrader_glue.pages import PageExporter
from autograder.notebook.recognise import grade_id
from autograder.notebook.suggestion import suggestion_of
from autograder.protocol import one_line

TEMPLATES = Path(__file__).with_name("templates")
ALT = re.compile(r'(?<= alt=")[^"]*')
HIDDEN = "…"


class Answers:
    """Makes the pages of one course. config: its settings."""

    def __init__(self, config: Config):
        self._config = config

    @cached_property
    def _exporter(self) -> PageExporter:
        return PageExporter(config=self._config, template_name="answer")

    def written(
        self, notebook: Path, source: NotebookNode | None, cell: str, hidden: list[str]
    ) -> Written:
        """The answer in a graded notebook. hidden: texts that stand nowhere on the page."""
        try:
            graded = nbformat.read(notebook, as_version=4)
            found = _own_cell(graded, cell)
        except OSError:
            fault = "The graded notebook is not there: run `autograder grade` for this assignment."
            return Written(fault=fault)
        except Exception as error:  # the file may be JSON of any other kind
            return Written(fault=f"The graded notebook cannot be read: {one_line(str(error))}")
        suggestion = suggestion_of(found)
        page, items = arranged(graded, source)
        item = next((one for one in items if one.id == cell), None)
        own = item.cells if item else []
        mine = set(map(id, own))
        page.cells = [*(one for one in page.cells if id(one) not in mine), *own]
        for one in page.cells:
            one.metadata["page"].pop("part_begins", None)
        if own:
            own[0].metadata["page"]["part_begins"] = True
        between = f"<!--{secrets.token_hex(16)}-->"
        resources = {"between": between, "metadata": {"path": str(notebook.parent)}}
        made, _ = self._exporter.from_notebook_node(page, resources)
        rest, answer, beside = made.split(between)
        rest, answer, beside = (_without(part, hidden) for part in (rest, answer, beside))
        return Written(
            answer, rest, beside, content_of(found), suggestion.rows if suggestion else ()
        )


def content(notebook: Path, cell: str) -> str:
    """A name for what a student wrote in a cell of a graded notebook; "" where that cannot be read."""
    try:
        return content_of(_own_cell(nbformat.read(notebook, as_version=4), cell))
    except Exception:  # as above
        return ""


def content_of(cell: NotebookNode) -> str:
    """A name for what a student wrote in a cell."""
    return digest(cell.cell_type, cell.source, repr(sorted(cell.get("attachments", {}).items())))


def shown(markdown: str, folder: Path) -> str:
    """A text of the assignment as HTML, with the pictures of its folder."""
    return markdown2html({"resources": {"metadata": {"path": str(folder)}}}, markdown)


def style() -> str:
    """The look of cells, formulas and code, as on the feedback page."""
    parts = TEMPLATES / "feedback" / "page.css", TEMPLATES / "formgrade" / "formulas.css"
    return "\n".join([code_style(), *(part.read_text(encoding="utf-8") for part in parts)])


def _own_cell(notebook: NotebookNode, cell: str) -> NotebookNode:
    return next(one for one in notebook.cells if grade_id(one) == cell)


def _without(page: str, hidden: list[str]) -> str:
    """The page with … in the place of names, in text and in what stands for a picture."""
    names = sorted({name for name in hidden if len(name) > 2}, key=len, reverse=True)
    if not names:
        return page
    any_name = "|".join(re.escape(escape(name)) for name in names)
    named = re.compile(rf"(?i)(?<!\w)(?:{any_name})(?!\w)")
    done, at = [], 0
    for tag in TAG.finditer(page):
        done += [named.sub(HIDDEN, page[at : tag.start()])]
        done += [ALT.sub(lambda alt: named.sub(HIDDEN, alt[0]), tag[0])]
        at = tag.end()
    return "".join([*done, named.sub(HIDDEN, page[at:])])
