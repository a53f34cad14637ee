"""Writes the feedback pages of `nbgrader generate_feedback`."""

import copy
import re
from pathlib import Path
from types import SimpleNamespace

import nbformat
from nbformat import NotebookNode
from pygments.formatters import HtmlFormatter

from autograder.nbgrader_glue.in_words import stopping
from autograder.nbgrader_glue.items import arranged, number, title_of
from autograder.nbgrader_glue.kept_editions import kept
from autograder.nbgrader_glue.late import settle_before
from autograder.nbgrader_glue.names import leave_out_unfit
from autograder.nbgrader_glue.pages import PageExporter
from autograder.nbgrader_glue.renewal import Renewal
from autograder.nbgrader_glue.start import can_start
from autograder.nbgrader_glue.worked import with_answers
from autograder.notebook.editions import Edition, of_release

MARKER = re.compile(r"^\s*### (BEGIN|END) HIDDEN TESTS[^\S\n]*\n?", re.MULTILINE)
HEADING = re.compile(r"<(/?)h([1-6])\b([^>]*)>")
OURS = ' class="page"'


class FeedbackExporter(PageExporter):
    """Our exporter, for the students whose names nbgrader can handle.

    nbgrader makes it when it has found the graded notebooks, and before it changes anything.
    """

    def __init__(self, config=None, **kw):
        super().__init__(config=config, **kw)
        self._renewal = None
        if self.parent is not None:
            leave_out_unfit(self.parent)
            can_start(self.parent)
            with stopping(self.parent):
                settle_before(self.parent)
            self._renewal = Renewal(self.parent)

    def from_notebook_node(self, nb, resources=None, **kw):
        """The page, as one file that asks for no other: each graded answer with what is said of it, and
        with the worked answers that are open to the student.

        It has no marker of a hidden test.
        """
        names = (resources or {}).get("nbgrader", {})
        if self.parent is not None and "student" in names:
            root = Path(self.parent.coursedir.root)
            nb = with_answers(nb, root, names["assignment"], names["student"])
        page, resources = super().from_notebook_node(_without_markers(nb), resources, **kw)
        return _with_headings_in_order(page), resources

    def _preprocess(self, nb, resources):
        """The cells in the order of the page, once they hold their grades."""
        nb, resources = super()._preprocess(nb, resources)
        names = resources.get("nbgrader", {})
        source = self._source(names)
        late = names.get("late_penalty")
        title = title_of(source or nb) or names.get("notebook", "")
        nb, items = arranged(nb, source, self._earlier(names))
        resources["page"] = SimpleNamespace(
            title=title,
            items=items,
            score=number(float(names.get("score") or 0)),
            max_score=number(float(names.get("max_score") or 0)),
            penalty=number(float(late)) if late else "",
            unread=sum(item.kind == "open" for item in items),
            made_of=self._made_of(names),
            code_style=code_style(),
        )
        return nb, resources

    def _made_of(self, names) -> str:
        if self._renewal is None or "student" not in names:
            return ""
        return self._renewal.made_of(names["assignment"], names["student"])

    def _earlier(self, names) -> list[Edition]:
        if self.parent is None or "assignment" not in names:
            return []
        root = Path(self.parent.coursedir.root)
        return [of_release(text) for text in kept(root, names["assignment"])]

    def _source(self, names) -> NotebookNode | None:
        """The assignment's own notebook, if it is still there."""
        if self.parent is None or "assignment" not in names:
            return None
        course = self.parent.coursedir
        folder = Path(course.format_path(course.source_directory, ".", names["assignment"]))
        path = folder / f"{names['notebook']}.ipynb"
        return nbformat.read(path, as_version=4) if path.is_file() else None


def code_style() -> str:
    """Colours of code, by day and by night."""
    light, dark = (HtmlFormatter(style=name).get_style_defs(".highlight")
                   for name in ("default", "github-dark"))  # fmt: skip
    plain = ".highlight { background: var(--faint) !important; }"
    return f"{light}\n@media screen and (prefers-color-scheme: dark) {{\n{dark}\n}}\n{plain}"


def _with_headings_in_order(page: str) -> str:
    """The page with its notebook's headings below its own, and none that skips a level, so that a screen
    reader can go from one to the next.
    """
    own = level = written = 1

    def placed(found: re.Match) -> str:
        nonlocal own, level, written
        closes, given, settings = found[1], int(found[2]), found[3]
        if settings == OURS:
            own = level = written = given
            return found[0]
        if not closes:
            level = written = min(max(given + 2, own + 1), level + 1, 6)
            return f"<h{written}{settings}>"
        return f"</h{written}>"

    return HEADING.sub(placed, page)


def _without_markers(nb):
    """The notebook without the lines that tell nbgrader where a hidden test begins and ends."""
    nb = copy.deepcopy(nb)
    for cell in nb.cells:
        if cell.cell_type == "code":
            cell.source = MARKER.sub("", cell.source).rstrip("\n")
    return nb
