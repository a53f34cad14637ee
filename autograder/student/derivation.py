"""`derivation`, which a student's cell calls with the lines of a proof, and which marks them."""

from difflib import get_close_matches
from pathlib import Path

import numpy as np

from autograder.problems import UnknownCheckError
from autograder.proofs import DERIVATIONS, card, derivation_of, mark
from autograder.proofs.derivation import Derivation
from autograder.proofs.of_mechanisms import ids_of
from autograder.protocol import handed_in, one_line
from autograder.student import below
from autograder.student.cell import VISIBLE_SEED
from autograder.student.display import show


def derivation(id: str | None = None, lines: object = ()) -> None:
    """Mark the lines of the derivation `id`, and show the card. Nothing is raised for a wrong line.

    lines: a list, or a function that gives one, of ("formula", "reason") or ("formula", "reason",
    "reason"). A formula is text, or an expression of SymPy's. Without lines, the card says where the
    derivation starts, and which names and reasons it has. UnknownCheckError where no derivation has
    this id.
    """
    known = known_derivation(id)
    marked = mark(known, handed_in(lines), np.random.default_rng(VISIBLE_SEED))
    shown = card.mimebundle(marked)
    for line in below.lines_of_derivation(known.id, marked.done):
        shown["text/plain"] += f"\n  {line.text}"
        shown["text/html"] += f'<p style="margin: 0.3em 0.9em">{line.html}</p>'
    show(shown)


def known_derivation(id: object) -> Derivation:
    """The derivation of this id; where there is none, UnknownCheckError, with the nearest."""
    name = id if isinstance(id, str) else ""
    if known := derivation_of(name):
        return known
    known_here = [*DERIVATIONS, *ids_of(Path.cwd().name)]  # a mechanism's folder has its name
    near = get_close_matches(name[:60], known_here, 1)
    meant = f"; did you mean {near[0]!r}?" if near else f"; they are {', '.join(DERIVATIONS)}"
    raise UnknownCheckError(f"there is no derivation {one_line(name, 60)!r}{meant}")
