"""Puts values and texts of a student's into words that a card can show."""

import numpy as np

MOST_CHARACTERS = 300
MOST_SHOWN = 60  # of a value
KINDS = (
    (str, "the text"),
    (bytes, "the bytes"),
    (complex, "the complex number"),
    (int, "the number"),
    (list, "the list"),
    (tuple, "the tuple"),
    (set, "the set"),
    (dict, "the dict"),
)
# By NumPy's letter for the type of an array's entries.
ENTRIES = {
    "b": "True and False",
    "c": "complex numbers",
    "M": "dates",
    "S": "bytes",
    "U": "texts",
    "m": "time spans",
}


def described(value) -> str:
    """What a value is, in words for a student who should have returned something else."""
    if callable(value) and hasattr(value, "__name__"):
        kind = "class" if isinstance(value, type) else "function"
        return f"the {kind} {shortened(str(value.__name__), MOST_SHOWN)} itself"
    if isinstance(value, np.ndarray) and value.ndim and value.dtype.kind in ENTRIES:
        return f"an array of {ENTRIES[value.dtype.kind]}"
    if isinstance(value, np.ndarray | np.generic):
        value = value.item()
    shown = shortened(repr(value), MOST_SHOWN)
    if shown.startswith("<"):  # as Python shows an object that has no text of its own
        return f"an object of the type {shortened(type(value).__name__, MOST_SHOWN)}"
    if getattr(value, "is_Relational", False):
        return f"the {'equation' if value.is_Equality else 'inequality'} {shown}"
    if value is None or isinstance(value, bool) or getattr(value, "is_Boolean", False):
        return shown
    kind = next((noun for kind, noun in KINDS if isinstance(value, kind)), "")
    kind = kind or ("the expression" if hasattr(value, "free_symbols") else "the object")
    return f"{kind} {shown}"


def shortened(text: str, most: int = MOST_CHARACTERS) -> str:
    return text if len(text) <= most else text[: most - 1] + "…"


def one_line(text: str, most: int = MOST_CHARACTERS) -> str:
    """The text, printable and shortened, so that a student's text cannot pass for lines of ours."""
    if not text.isprintable():
        text = repr(text[:most])[1:-1]
    return shortened(text, most)


def other_cell(function: str) -> str:
    """How a card names the cell that defines a function, as a graded notebook numbers no cells."""
    named = function.isidentifier()  # unlike a lambda
    return f"the cell of {shortened(function, MOST_SHOWN)}" if named else "another cell"
