r"""Brings the ways in which people type a formula to one: `\dot q^{\mathsf T} M \dot q`, q̇ᵀMq̇, qd' M qd.

What comes out has ASCII names and operators alone; `'` is the transpose, `^` a power.
"""

import re
import unicodedata

# In this order. LaTeX's fractions are unfolded from the inside, so their braces hold no others.
_LATEX = (
    (r"\\(?:mathrm|mathsf|text|mathit|operatorname)\s*\{\s*([A-Za-z]+)\s*\}", r"\1"),
    (r"\\(?:mathrm|mathsf)\s*([A-Za-z])", r"\1"),
    (r"\\(?:bigl|bigr|Bigl|Bigr|left|right|big|Big)(?![A-Za-z])", ""),
    (r"\\[,;:! ]|\\quad", " "),
    (r"\^\s*(?:\{\s*(?:T|\\top|\\intercal)\s*\}|\\top|\\intercal|T(?![A-Za-z0-9]))", "'"),
    (r"\\[dt]?frac\s*(\d)\s*(\d)", r"((\1)/(\2))"),
    (r"\\(d?dot)\s*\{\s*([A-Za-z])\s*\}", r"\\\1 \2"),
    (r"\\ddot\s*q", " qdd "),
    (r"\\dot\s*q", " qd "),
    (r"\\dot\s*([A-Z])", r" \1dot "),
    (r"\\ell", " l"),
    (r"\\(cos|sin)", r" \1 "),
    (r"\\cdot|\\times", "*"),
    (r"\\geq?(?![A-Za-z])", ">="),
    (r"\\partial\s*", "d"),
    (r"([A-Za-z])_\{?([A-Za-z0-9]+)\}?", r"\1\2"),
    (r"\^\{\s*(-?\d)\s*\}", r"^\1"),
)
_SIGNS = {
    "½": "(1/2)", "²": "^2", "³": "^3", "⁻¹": "^-1", "ᵀ": "'", "−": "-", "–": "-", "·": "*",
    "×": "*", "≥": ">=", "∂": "d", "ℓ": " l", "₁": "1", "₂": "2", "′": "'", "’": "'", "⊤": "'",
    "**": "^", "@": "*", "$": " ", "&": " ",
}  # fmt: skip
_DOTTED = (
    ("q\u0308", " qdd "),
    ("q\u0307", " qd "),
    *((f"{c}\u0307", f" {c}dot ") for c in "MEKP"),
)


def plain(text: str) -> str:
    """The formula in one notation. What is no formula stays as it is, for the parser to refuse."""
    for mark in (r"\bigl", r"\bigr", r"\Bigl", r"\Bigr"):
        text = text.replace(mark, "")
    text = unicodedata.normalize("NFD", text)
    for dotted, name in _DOTTED:
        text = text.replace(dotted, name)
    for sign, written in _SIGNS.items():
        text = text.replace(sign, written)
    for pattern, written in _LATEX:
        text = re.sub(pattern, written, text)
    for _ in range(8):
        unfolded = re.sub(r"\\[dt]?frac\s*\{([^{}]*)\}\s*\{([^{}]*)\}", r"((\1)/(\2))", text)
        if unfolded == text:
            break
        text = unfolded
    # As people write derivatives: d/dt (…), dP/dt is a name's alone.
    text = re.sub(r"\bd([KPELM])\s*/\s*dt\b", r" \1dot ", text)
    text = re.sub(r"\bd([KPL])\s*/\s*d(qd|q)\b", r" d/d\2(\1) ", text)
    return text.replace("\\", " \\ ").strip()
