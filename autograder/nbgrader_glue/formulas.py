"""Shows LaTeX as MathML, made when the page is made: no script draws it, and no other host is asked."""

import re
from functools import lru_cache
from html import escape, unescape
from xml.etree.ElementTree import Element

from latex2mathml.converter import convert_to_element

MOST_CHARACTERS = 4_000  # of one formula
DEEPEST = 60  # elements in each other: a browser lays out each level once more
SPACES = """
columnspacing depth height linethickness lspace maxsize minsize rowspacing rspace width
"""
SETTINGS = """
accent accentunder columnalign columnlines displaystyle fence form largeop mathvariant movablelimits
notation rowlines scriptlevel separator stretchy symmetric
"""
# MathML has elements that link, run or load; of these a formula needs none.
ELEMENTS = """
math menclose mfrac mi mmultiscripts mn mo mover mpadded mphantom mprescripts mroot mrow mspace msqrt
mstyle msub msubsup msup mtable mtd mtext mtr munder munderover none
"""
ACCENTS = set("˙¨^~¯→ˆ˜‾⃗´`˘ˇ⃛⃜")
VALUE = re.compile(r"[\w .%+-]*")
LENGTH = r"[+-]?\d{0,2}(\.\d{1,3})?(em|ex|pt|px|mu)?"
SPACE = re.compile(f"{LENGTH}( {LENGTH}){{0,3}}|thick|thin|medium")
# Of several, MathJax numbered each line; nothing in the course refers to such a number.
NUMBERED = re.compile(r"(\\(?:begin|end)\{(?:align|equation|gather|alignat|multline))\}")
LABEL = re.compile(r"\\(label|nonumber|notag)\b(\s*\{[^{}]*\})?")
# A browser sets one letter slanted, unless it is text.
UPRIGHT = re.compile(r"\\(?:mathrm|operatorname)\s*\{\s*(\w)\s*\}|\\mathrm\s+(\w)")
FORMULA = re.compile(
    r"(?<!\\)\$\$(?P<block>.+?)(?<!\\)\$\$"
    r"|(?<![\\$])\$(?P<inline>[^$]+?)(?<!\\)\$(?!\$)"
    r"|\\\[(?P<bracket>.+?)\\\]|\\\((?P<round>.+?)\\\)"
    r"|(?P<environment>\\begin\{(?P<name>[a-z]+\*?)\}.*?\\end\{(?P=name)\})",
    re.DOTALL,
)


def mathml(latex: str, is_display: bool, source: str) -> str:
    """The formula as MathML; where it cannot be converted, its source, as text.

    latex: what stands between the dollars. source: the same with them.
    """
    made = _converted(latex.strip(), is_display)
    if not made:
        return escape(source)
    return f'<span class="formula">{made}</span>' if is_display else made


def with_formulas(text: str) -> str:
    """Plain text as HTML, with MathML for the formulas in it."""
    done, at = [], 0
    for found in FORMULA.finditer(text):
        inner = next(filter(None, found.group("block", "inline", "bracket", "round")), found[0])
        is_display = found["inline"] is None and found["round"] is None
        done += [escape(text[at : found.start()]), mathml(inner, is_display, found[0])]
        at = found.end()
    return "".join([*done, escape(text[at:])])


@lru_cache(maxsize=8192)  # a whole class has the problem's own formulas on each page
def _converted(latex: str, is_display: bool) -> str:
    if not latex or len(latex) > MOST_CHARACTERS:
        return ""
    plain = LABEL.sub("", NUMBERED.sub(r"\1*}", latex))
    plain = UPRIGHT.sub(lambda found: rf"\text{{{found[1] or found[2]}}}", plain)
    try:
        formula = convert_to_element(plain, display="block" if is_display else "inline")
        shown = "".join(_written(child, plain, 0) for child in formula)
    except (ValueError, RecursionError):
        return ""
    except Exception:  # it raises whatever Python does where it meets what it does not know
        return ""
    display = ' display="block"' if is_display else ""
    note = f'<annotation encoding="application/x-tex">{escape(latex)}</annotation>'
    return f"<math{display}><semantics><mrow>{shown}</mrow>{note}</semantics></math>"


def _written(element: Element, latex: str, depth: int) -> str:
    """An element as text, with whatever a formula needs, and no more. ValueError if it is unfit."""
    if depth > DEEPEST or element.tag not in ELEMENTS.split():
        raise ValueError(element.tag)
    text = unescape(element.text or "")
    if "\\" in text and r"\backslash" not in latex and r"\setminus" not in latex:
        raise ValueError(f"{text} is no command that is known")
    kept = {name: value for name, value in element.attrib.items() if _is_kept(name, value)}
    if kept.get("mathvariant") in ("sans-serif", "monospace"):
        kept["class"], kept["mathvariant"] = kept["mathvariant"], "normal"
    if element.tag == "mover" and unescape(element[-1].text or "") in ACCENTS:
        kept["accent"] = "true"  # else a browser leaves room for a limit
    settings = "".join(f' {name}="{escape(value)}"' for name, value in kept.items())
    inside = "".join(_written(child, latex, depth + 1) for child in element)
    return f"<{element.tag}{settings}>{escape(text)}{inside}</{element.tag}>"


def _is_kept(name: str, value: str) -> bool:
    if name in SPACES.split():
        return SPACE.fullmatch(value) is not None
    return name in SETTINGS.split() and VALUE.fullmatch(value) is not None
