"""Finds the row of the table for an error, and makes its sentence on the judge's side."""

from dataclasses import dataclass

from ..words import one_line
from . import of_arrays, of_changing, of_missing, of_names
from .row import Row
from .scene import Scene

MOST_WORD = 120
PRINTED = Row(
    "printed", (), "", "{0} calls print, which only shows a value; return gives it to the caller."
)
OWN_SYMBOL = Row(
    "own symbol",
    (),
    "",
    "{0} takes only numbers, and this is a SymPy expression. The arguments are numbers: where does the "
    "symbol come from?",
)
TABLE = {
    row.kind: row for row in (*of_names.ROWS, *of_missing.ROWS, *of_arrays.ROWS, *of_changing.ROWS)
}
KNOWN = TABLE | {row.kind: row for row in (PRINTED, OWN_SYMBOL)}


@dataclass(frozen=True)
class Riddle:
    """A row of the table by its kind, and the words that its sentence takes."""

    kind: str
    words: tuple[str, ...] = ()


def of_error(error: BaseException, message: str) -> Riddle | None:
    """What an error in a student's code means; None where no row of the table reads it."""
    scene = None
    for kind, row in TABLE.items():
        try:
            scene = scene or Scene(error)
            words = row.read(error, message, scene)
        except Exception:  # an error of the student's own class, perhaps
            continue
        if words is not None:
            return Riddle(kind, tuple(one_line(word, MOST_WORD) for word in words))
    return None


def of_nothing(function) -> Riddle | None:
    """What to say of a Python function that returned None; None where nothing is known."""
    names = getattr(getattr(function, "__code__", None), "co_names", ())
    name = getattr(function, "__name__", "")
    if isinstance(names, tuple) and "print" in names and isinstance(name, str):
        return Riddle(PRINTED.kind, (one_line(name, MOST_WORD),))
    return None


def sentence(riddle: Riddle | None, symbolic: bool = True) -> str:
    """The sentence for a student; "" for none, and for what is no riddle of this table.

    symbolic: whether the function is asked for SymPy's expressions.
    """
    if riddle and riddle.kind == "symbols" and not symbolic:
        riddle = Riddle(OWN_SYMBOL.kind, riddle.words[:1])
    row = KNOWN.get(riddle.kind) if riddle else None
    if riddle is None or row is None or len(riddle.words) != row.places:
        return ""
    return row.says.format(*riddle.words)


def encode_riddle(riddle: Riddle | None) -> list | None:
    """In JSON's terms."""
    return [riddle.kind, list(riddle.words)] if riddle else None


def decode_riddle(message) -> Riddle | None:
    """What `encode_riddle` wrote; None for anything else, as the sandbox may send it."""
    match message:
        case [str(kind), list(words)] if kind in KNOWN and len(words) == KNOWN[kind].places:
            if all(isinstance(word, str) for word in words):
                return Riddle(kind, tuple(one_line(word, MOST_WORD) for word in words))
    return None
