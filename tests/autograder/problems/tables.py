"""What the problems' tables hold: one folder a problem, one module a kind."""

from importlib import import_module

from autograder.problems import CHECKS, MODULES
from tests.autograder.problems.row import Row

FOLDERS = [module.__package__.rpartition(".")[2] for module in MODULES]
# The warm-up of lesson 00 is judged by a visible check alone.
PROBLEMS = [name for name in FOLDERS if name != "start_here"]
TABLES = {name: import_module(f"{__package__}.{name}.table").TABLE for name in FOLDERS}
ROWS = [
    Row(check_id, *row)
    for table in TABLES.values()
    for check_id, rows in table.items()
    for row in rows
]


def gathered(kind: str, table: str) -> dict:
    """One table of all problems, by the id of the check. kind: the module that it stands in."""
    found: dict = {}
    for name in PROBLEMS:
        found |= getattr(import_module(f"{__package__}.{name}.{kind}"), table)
    assert found.keys() <= CHECKS.keys()
    return found
