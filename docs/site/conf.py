"""Sphinx's settings for the course's pages."""

from importlib.metadata import version as version_of
from pathlib import Path

from pygments.lexers.special import TextLexer
from sphinx.highlighting import lexers

lexers["csv"] = TextLexer()  # which Pygments does not know

project = "armdyn"
author = "The armdyn developers"
copyright = "The armdyn developers: code under MIT, text and figures under CC BY 4.0"
version = release = version_of("armdyn")
language = "en"

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.mathjax",
    "sphinx-mathjax-offline",  # MathJax in the site itself
    "docs.site.reading",
]
html_theme = "sphinx_book_theme"
html_title = "armdyn"
html_static_path = [str(Path(__file__).with_name("static"))]
html_css_files = ["course.css"]
html_js_files = [("controls.js", {"defer": "defer"}), ("paper.js", {"defer": "defer"})]
html_sourcelink_suffix = ""
html_theme_options = {
    "use_download_button": True,
    "show_toc_level": 2,
    "navigation_depth": 1,
    "navbar_persistent": [],  # the search field is beside the pages' list
    "search_bar_text": "Search the course",
}

nb_execution_mode = "off"  # what is stored is shown (`make lessons` stores it), and controls.py's
nb_ipywidgets_js = {}  # without a kernel a widget does nothing, and its scripts lie on another host
nb_merge_streams = True
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_fence_as_directive = ["mermaid"]
myst_heading_anchors = 4
myst_dmath_double_inline = True

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_inherit_docstrings = False  # Matplotlib's are not ours
suppress_warnings = [
    "misc.highlighting_failure"
]  # Pygments does not know all of Wolfram's language
