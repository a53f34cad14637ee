"""Markdown cells as the formgrader and the feedback page show them: nothing in them runs.

A student writes them, and the instructor reads them logged in. nbconvert's own `sanitize_html` is no
substitute: it cleans the verdicts' cards as well, and not the formgrader's pages.
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
# What highlights code and draws diagrams. Others would look, or be taken, for parts of the page.
CLASSES = re.compile(r"highlight|mermaid|jp-Mermaid|language-[\w+#-]+|[a-z][a-z0-9]{0,2}")
LINK = re.compile(r"https?://|mailto:", re.IGNORECASE)
PICTURE = re.compile(r"https?://|data:image/(png|jpeg|gif|webp|svg\+xml);base64,", re.IGNORECASE)
BESIDE = re.compile(r"\w[\w ./()+-]*")  # a file that was handed in with the notebook


@pass_context
def markdown2html(context, source: str) -> str:
    """HTML of a cell's Markdown, formulas left as they are; what could run is shown as text."""
    cell = context.get("cell", {})
    renderer = IPythonRenderer(
        escape=False, attachments=cell.get("attachments", {}), exclude_anchor_links=True
    )
    try:
        shown = MarkdownWithMath(renderer=renderer).render(source)
        # Not shared between pages: a cleaner is not made for threads.
        return bleach.clean(shown, set(TAGS.split()), _is_kept, {"http", "https", "mailto", "data"})
    except Exception:  # a picture that is not there, or quotes nested without end: no page at all
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
