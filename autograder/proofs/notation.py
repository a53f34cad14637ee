r"""Brings the ways in which people type a formula to one: `\dot q^{\mathsf T} M \dot q`, q̇ᵀMq̇, qd' M qd.

What comes out has ASCII names and operators alone; `'` is the transpose, `^` a power.
"""

import re
import unicodedata

from autograder.proofs.indices import without_indices

# In this order. What is set apart or named for the eye alone.
_TYPESETTING = (
    (r"\\q?quad\s*\\text\s*\{[^{}]*\}.*", ""),
    (r"\\\\(?:\[[^\]]*\])?\s*$", ""),
    (r"\\(?:mathrm|mathsf|mathcal|text|mathit|operatorname)\s*\{\s*([A-Za-z]+)\s*\}", r"\1"),
    (r"\\(?:mathrm|mathsf|mathcal)\s*([A-Za-z])", r"\1"),
    (r"\\(?:bigl|bigr|Bigl|Bigr|left|right|big|Big)(?![A-Za-z])", ""),
    (r"\\[,;:! ]|\\q?quad", " "),
    (r"\\boxed\s*\{(.*)\}", r"\1"),
    (r"\^\s*(?:\{\s*(?:T|\\top|\\intercal)\s*\}|\\top|\\intercal|T(?![A-Za-z0-9]))", "'"),
    (r"\\vec\s*(?:\{\s*g\s*\}|g)(?:\s*_\{?0\}?)?", " g0 "),
    (r"\\vec(?![A-Za-z])", ""),
    (r"[.,;]\s*$", ""),
)
# LaTeX's fractions are unfolded from the inside, so their braces hold no others.
_LATEX = (
    (r"\\[dt]?frac\s*(\d)\s*(\d)", r"((\1)/(\2))"),
    (r"\\(d?dot)\s*\{\s*([A-Za-z])\s*\}", r"\\\1 \2"),
    (r"\\ddot\s*q", " qdd "),
    (r"\\dot\s*q", " qd "),
    (r"\\dot\s*(p)_?\{?([12])\}?", r" d/dt(\1\2) "),
    (r"\\dot\s*([A-Z])", r" \1dot "),
    (r"\\ell", " l"),
    (r"\\(cos|sin)", r" \1 "),
    (r"\\cdot|\\times", "*"),
    (r"\\geq?(?![A-Za-z])", ">="),
    (r"\\partial\s*", "d"),
    (r"([A-Za-z])_(?:\{(?:v,)?([A-Za-z0-9]+)\}|(\d+|[A-Za-z]))", r"\1\2\3 "),
    (r"\^\{\s*(-?\d)\s*\}", r"^\1"),
    # A fraction that is a derivative: of what follows, or of what stands in it.
    (r"\\[dt]?frac\s*\{\s*d\s*\}\s*\{\s*d\s*(t|qd|q)\s*\}", r" d/d\1 "),
    (r"\\[dt]?frac\s*\{\s*d\s*([A-Z])\s*\}\s*\{\s*d\s*(t|qd|q)\s*\}", r" d/d\2(\1) "),
)
# As SymPy prints functions of time and their derivatives.
_SYMPY = (
    (r"\b([A-Za-z]\w*)\(t\)", r"\1"),
    (r"\bDerivative\(q, \(t, 2\)\)", " qdd "),
    (r"\bDerivative\(q, t\)", " qd "),
    (r"\bDerivative\((\w+), (t|qd|q)\)", r" d/d\2(\1) "),
)
# What Python makes of LaTeX in a text without r"…".
_ESCAPED = (
    (r"\t(?=frac|ext|imes|op)", r"\\t"),
    (r"\f(?=rac)", r"\\f"),
    (r"\x08(?=ig|oxed)", r"\\b"),
    (r"\r(?=ight)", r"\\r"),
    (r"\v(?=ec)", r"\\v"),
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
    for pattern, written in _ESCAPED:
        text = re.sub(pattern, written, text)
    for mark in (r"\bigl", r"\bigr", r"\Bigl", r"\Bigr"):
        text = text.replace(mark, "")
    text = unicodedata.normalize("NFD", text)
    for dotted, name in _DOTTED:
        text = text.replace(dotted, name)
    for sign, written in _SIGNS.items():
        text = text.replace(sign, written)
    for pattern, written in (*_TYPESETTING, *_SYMPY):
        text = re.sub(pattern, written, text)
    text = without_indices(text)
    for pattern, written in _LATEX:
        text = re.sub(pattern, written, text)
    for _ in range(8):
        unfolded = re.sub(r"\\[dt]?frac\s*\{([^{}]*)\}\s*\{([^{}]*)\}", r"((\1)/(\2))", text)
        if unfolded == text:
            break
        text = unfolded
    # As people write derivatives: d/dt (…), dP/dt is a name's alone.
    text = re.sub(r"\bd([KPELM])\s*/\s*dt\b", r" \1dot ", text)
    text = re.sub(r"\bd([KPL])\s*/\s*d\s*(qd|q)\b", r" d/d\2(\1) ", text)
    # Of what a name depends on, nothing is said.
    text = re.sub(
        r"(?<![A-Za-z])(Mdot|[MCPKELg]|[Jp][12])\s*\(\s*q\s*(?:,\s*qd\s*)?\)", r"\1", text
    )
    text = re.sub(r"\bf\s*\(\s*qd\s*\)", "f", text)
    return text.replace("\\", " \\ ").strip()
