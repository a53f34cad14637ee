"""What a problem's notebook must agree with."""

from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec

from tests.autograder.problems.tables import PROBLEMS


@dataclass(frozen=True)
class Own:
    """The grade_id and points of the answer that a person reads, the points of all cells, all grade_ids,
    and phrases of the answers that no student may be given.
    """

    read: str
    points: int
    total: int
    ids: str
    phrases: tuple[str, ...] = ()


def expected(table: str) -> dict:
    """One table of the problems that have a file `expected.py`; OWN by their names."""
    found: dict = {}
    for folder in PROBLEMS:
        module = f"{__package__}.{folder}.expected"
        if find_spec(module):
            own = getattr(import_module(module), table)
            found |= {folder.replace("_", "-"): own} if table == "OWN" else own
    return found
