"""Names as the lessons write them: q̇1 for qd1, θ for theta, ℓc1 for lc1."""

import re
import unicodedata

from autograder.mechanisms.outline import Outline
from autograder.mutation.in_pi import in_pi

GREEK = {"theta": "θ", "phi": "φ"}
DOT = "\N{COMBINING DOT ABOVE}"


def written(text: str, mechanism: Outline) -> str:
    """The text with each name of a coordinate, velocity or length as the lessons write it."""
    symbols = {}
    for c in mechanism.coordinates:
        symbols[c.name] = GREEK.get(c.name, c.name)
        head, number = symbols[c.name][0], symbols[c.name][1:]
        symbols[c.rate] = unicodedata.normalize("NFC", f"{head}{DOT}{number}")
    for parameter in mechanism.parameters:
        if parameter.unit == "m" and parameter.name.startswith("l"):
            symbols[parameter.name] = f"ℓ{parameter.name[1:]}"
    names = "|".join(sorted(map(re.escape, symbols), key=len, reverse=True))
    return re.sub(rf"(?<![\w.])(?:{names})(?![a-zA-Z0-9_])", lambda name: symbols[name[0]], text)


def entry_of_pi(name: str, mechanism: Outline) -> str:
    """The combination that pi4 stands for; other names as they are."""
    if not is_entry_of_pi(name):
        return name
    found = [p for p in in_pi(mechanism).parameters if p.name == name]
    return found[0].doc


def is_entry_of_pi(name: str) -> bool:
    return bool(re.fullmatch(r"pi\d+", name))
