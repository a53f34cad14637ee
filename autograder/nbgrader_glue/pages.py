"""Makes a page of a notebook by our templates: what students get back, and what a person marks."""

import re

from nbconvert.exporters import HTMLExporter, TemplateExporter
from nbconvert.filters import Highlight2HTML
from nbconvert.filters.widgetsdatatypefilter import WidgetsDataTypeFilter

from autograder.nbgrader_glue.markdown import IMG

ALT = re.compile(r"\balt\s*=", re.IGNORECASE)


class PageExporter(HTMLExporter):
    """nbconvert's exporter, but for its last step: that parses and writes each page again, which takes
    as long as all the rest, for settings of JupyterLab's cells, which our pages do not have.
    """

    def from_notebook_node(self, nb, resources=None, **kw):
        resources = self._init_resources(resources)
        language = nb.metadata.get("language_info", {})
        lexer = language.get("pygments_lexer", language.get("name"))
        self.register_filter("highlight_code", Highlight2HTML(pygments_lexer=lexer, parent=self))
        chosen = WidgetsDataTypeFilter(self._nb_metadata, parent=self, resources=resources)
        self.register_filter("filter_data_type", chosen)
        page, resources = TemplateExporter.from_notebook_node(self, nb, resources, **kw)
        return IMG.sub(_with_alternative_text, page), resources


def _with_alternative_text(found: re.Match) -> str:
    """A picture's tag; where it does not say what the picture shows, it says so."""
    tag = found[0]
    return tag if ALT.search(tag) else f'<img alt="a figure without a description"{tag[4:]}'
