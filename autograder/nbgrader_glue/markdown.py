"""Shows Markdown cells in the formgrader and on feedback pages so that nothing in them runs.

A student writes them, and the instructor is logged in when reading them. nbconvert's own `sanitize_html`
does not replace this: it also cleans the verdicts' cards, and it does not clean the formgrader's pages.
"""

import html
import re
from urllib.parse import unquote

import bleach
from jinja2 import pass_context
from nbconvert.filters.markdown_mistune import IPythonRenderer, MarkdownWithMath

TAGS = """
a abbr b blockquote br caption center code dd del details div dl dt em h1 h2 h3 h4 h5 h6 hr i img
input ins kbd li mark ol p pre q s samp small span strong sub summary sup table tbody td tfoot th
thead tr u ul var
"""
PLAIN = "align alt checked colspan disabled height rowspan start title width"
# Classes that highlight code and draw diagrams. Others could look like parts of the page.
CLASSES = re.compile(r"highlight|mermaid|jp-Mermaid|language-[\w+#-]+|[a-z][a-z0-9]{0,2}")
LINK = re.compile(r"https?://|mailto:", re.IGNORECASE)
PICTURE = re.compile(r"https?://|data:image/(png|jpeg|gif|webp|svg\+xml);base64,", re.IGNORECASE)
BESIDE = re.compile(r"\w[\w ./()+-]*")  # a file that was handed in with the notebook


@pass_context
def markdown2html(context, source: str) -> str:
    """A cell's Markdown as HTML, with its formulas as they are; what could run is shown as text."""
    cell = context.get("cell", {})
    renderer = IPythonRenderer(
        escape=False, attachments=cell.get("attachments", {}), exclude_anchor_links=True
    )
    try:
        shown = MarkdownWithMath(renderer=renderer).render(source)
        # Each page gets its own cleaner, which is not made for threads.
        return bleach.clean(shown, set(TAGS.split()), _is_kept, {"http", "https", "mailto", "data"})
    except Exception:  # a missing picture, or quotes nested too deep, would stop the page
        return f"<pre>{html.escape(source)}</pre>"


def _is_kept(tag: str, name: str, value: str) -> bool:
    match tag, name:
        case _, "class":
            return all(map(CLASSES.fullmatch, value.split()))
        case "a", "href":
            return LINK.match(value) is not None
        case "img", "src":
            path = unquote(value)
            beside = BESIDE.fullmatch(path) is not None and ".." not in path
            return beside or PICTURE.match(value) is not None
        case "input", "type":
            return value == "checkbox"
    return name in PLAIN.split()
