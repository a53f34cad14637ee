"""Shows Markdown cells in the formgrader and on feedback pages so that nothing in them runs, and so
that nothing is asked of another host.

A student writes them, and the instructor is logged in when reading them. nbconvert's own `sanitize_html`
does not replace this: it also cleans the verdicts' cards, and it does not clean the formgrader's pages.
"""

import html
import re
import secrets
from collections.abc import Callable
from html.parser import HTMLParser
from pathlib import Path

import bleach
from jinja2 import pass_context
from jinja2.utils import LRUCache
from nbconvert.filters.markdown_mistune import IPythonRenderer, MarkdownWithMath

from autograder.nbgrader_glue.formulas import FORMULA, mathml
from autograder.nbgrader_glue.pictures import Pictures
from autograder.protocol import shortened

TAGS = """
a abbr b blockquote br caption center code dd del details div dl dt em h1 h2 h3 h4 h5 h6 hr i
input ins kbd li mark ol p pre q s samp small span strong sub summary sup table tbody td tfoot th
thead tr u ul var
"""
PLAIN = "align alt checked colspan disabled height rowspan start title width"
# Classes that highlight code and draw diagrams. Others could look like parts of the page.
CLASSES = re.compile(r"highlight|mermaid|jp-Mermaid|language-[\w+#-]+|[a-z][a-z0-9]{0,2}")
LINK = re.compile(r"https?://|mailto:", re.IGNORECASE)
MOST_TEXT = 200_000  # characters of one cell, but for the pictures in it
IN_TEXT = re.compile(r"data:image/[\w.+-]+;base64,[A-Za-z0-9+/=%]{100,}")
# A picture whose name has a space or a bracket, for which Markdown has other ways to write it.
LOOSE = (
    r"!\[(?P<loose_alt>[^\]\n]{0,200})\]"
    r"\((?P<loose_url>[^<>\n\"\s()]{0,200}(?:[^\S\n]|\()[^<>\n\"]{0,200}?\.\w{3,4})[ \t]*\)"
)
IMG = re.compile(r"<img\b(?:\"[^\"]*\"|'[^']*'|[^'\">])*>", re.IGNORECASE)
TAG = re.compile(r"<(?:\"[^\"]*\"|'[^']*'|[^'\">])*>")
# A class's pages repeat the problem's text. What has pictures differs with the folder beside it.
SHOWN = LRUCache(200)
PICTURES = "armdyn_pictures"  # where a page's resources keep them


@pass_context
def markdown2html(context, source: str) -> str:
    """A cell's Markdown as HTML, with MathML for its formulas and with its pictures in it; what could
    run is shown as text.
    """
    if source in SHOWN:
        return SHOWN[source]
    if len(IN_TEXT.sub("", source)) > MOST_TEXT:
        return f"<pre>{html.escape(shortened(source, MOST_TEXT))}</pre>"
    cell = context.get("cell") or {}
    page = _Page(pictures_of(context.get("resources")), cell.get("attachments"))
    markdown = MarkdownWithMath(renderer=page)
    markdown.inline.register("loose_picture", LOOSE, _loose_picture, before="link")
    try:
        shown = markdown.render(IN_TEXT.sub(page.set_aside, source))
        # Each page gets its own cleaner, which is not made for threads.
        clean = bleach.clean(shown, set(TAGS.split()), _is_kept, {"http", "https", "mailto"})
        shown = page.filled(clean)
    except Exception:  # quotes nested too deep would stop the page
        return f"<pre>{html.escape(source)}</pre>"
    if not page.has_pictures:
        SHOWN[source] = shown
    return shown


def pictures_of(resources) -> Pictures:
    """The pictures of the page that is being made."""
    if resources is None:
        return Pictures(None)
    if PICTURES not in resources:
        folder = (resources.get("metadata") or {}).get("path")
        resources[PICTURES] = Pictures(Path(folder) if folder else None)
    return resources[PICTURES]


def pictures_beside(resources) -> list[str]:
    """For a page's template, after all cells: the pictures of the folder that no cell shows."""
    return pictures_of(resources).beside()


class _Page(IPythonRenderer):
    """Sets formulas and pictures aside, under a name that nobody can guess, until all else is clean."""

    def __init__(self, pictures: Pictures, attachments: object):
        super().__init__(escape=False, exclude_anchor_links=True)
        self._pictures, self._own = pictures, attachments
        self._name = secrets.token_hex(8)
        self.has_pictures = False
        self._kept: list[tuple[Callable[[], str], str]] = []  # how it is shown, and as plain text
        self._data: dict[str, str] = {}
        self._place = re.compile(rf"p{self._name}(\d+)p")

    def set_aside(self, found: re.Match) -> str:
        """A short name for a picture that stands in the text, which may have megabytes."""
        self.has_pictures = True
        name = f"d{self._name}{len(self._data)}d"
        self._data[name] = found[0]
        return name

    def filled(self, clean: str) -> str:
        """Clean HTML, with what was set aside; in an attribute it is plain text."""
        done, at = [], 0
        for tag in TAG.finditer(clean):
            done += [self._place.sub(self._shown, clean[at : tag.start()])]
            done += [self._place.sub(lambda found: html.escape(self._text(found)), tag[0])]
            at = tag.end()
        page = "".join([*done, self._place.sub(self._shown, clean[at:])])
        for name, data in self._data.items():  # what was no picture, such as a line of code
            page = page.replace(name, html.escape(shortened(data, 100)))
        return page

    def block_math(self, body: str) -> str:
        return self._formula(body, True, f"$${body}$$")

    def inline_math(self, body: str) -> str:
        return self._formula(body, False, f"${body}$")

    def latex_environment(self, name: str, body: str) -> str:
        source = f"\\begin{{{name}}}{body}\\end{{{name}}}"
        return self._formula(source, True, source)

    def image(self, text: str, url: str, title: str | None = None) -> str:
        return self._picture(url, html.unescape(text), {})

    def block_html(self, html: str) -> str:
        return super().block_html(self._with_formulas(IMG.sub(self._tag, html)))

    def inline_html(self, html: str) -> str:
        return super().inline_html(IMG.sub(self._tag, html))

    def _with_formulas(self, source: str) -> str:
        """HTML with its formulas set aside; Markdown does not look into it."""

        def formula(found: re.Match) -> str:
            inner = next(filter(None, found.group("block", "inline", "bracket", "round")), found[0])
            is_display = found["inline"] is None and found["round"] is None
            return self._formula(html.unescape(inner), is_display, html.unescape(found[0]))

        if re.search(r"<(pre|code|script|style|textarea)\b", source, re.IGNORECASE):
            return source
        done, at = [], 0
        for tag in TAG.finditer(source):
            done += [FORMULA.sub(formula, source[at : tag.start()]), tag[0]]
            at = tag.end()
        return "".join([*done, FORMULA.sub(formula, source[at:])])

    def _tag(self, found: re.Match) -> str:
        own = _attributes(found[0])
        size = {name: own[name] for name in ("width", "height") if own.get(name)}
        return self._picture(own.get("src", ""), own.get("alt", ""), size)

    def _formula(self, latex: str, is_display: bool, source: str) -> str:
        return self._keep(lambda: mathml(latex, is_display, source), source)

    def _picture(self, url: str, alt: str, size: dict[str, str]) -> str:
        self.has_pictures = True
        alt = self._place.sub(self._text, alt)
        url = self._data.get(url, url)
        return self._keep(lambda: self._pictures.img(url, alt, self._own, size), alt)

    def _keep(self, shown: Callable[[], str], text: str) -> str:
        self._kept.append((shown, text))
        return f"p{self._name}{len(self._kept) - 1}p"

    def _shown(self, found: re.Match) -> str:
        return self._kept[int(found[1])][0]()

    def _text(self, found: re.Match) -> str:
        return self._kept[int(found[1])][1]


def _loose_picture(inline, found: re.Match, state) -> int:
    alt = {"type": "text", "raw": found["loose_alt"]}
    state.append_token(
        {"type": "image", "children": [alt], "attrs": {"url": found["loose_url"].strip()}}
    )
    return found.end()


def _attributes(tag: str) -> dict[str, str]:
    """The attributes of the tag, with its characters as they are meant."""
    found: dict[str, str] = {}

    class Reader(HTMLParser):
        def handle_starttag(self, tag, attributes):
            found.update((name, value or "") for name, value in attributes)

    Reader().feed(tag)
    return found


def _is_kept(tag: str, name: str, value: str) -> bool:
    match tag, name:
        case _, "class":
            return all(map(CLASSES.fullmatch, value.split()))
        case "a", "href":
            return LINK.match(value) is not None
        case "input", "type":
            return value == "checkbox"
    return name in PLAIN.split()
