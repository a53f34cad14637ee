"""The zoo of hostile submissions to p3-pendulum, by name.

What the fallback without bubblewrap does not stop is each attack's `fallback`; `unstopped()` lists it.
"""

from tests.submissions import (
    hostile_answers,  # noqa: F401
    hostile_hooks,  # noqa: F401
    hostile_judge,  # noqa: F401
    hostile_notebooks,  # noqa: F401
    hostile_pages,  # noqa: F401
    hostile_processes,  # noqa: F401
)
from tests.submissions.attack import ATTACKS

# Of those that the fallback does not stop, nobody should try the others: the harm is real.
SAFE_WITHOUT_WALLS = (
    "reads_the_solution",
    "writes_the_gradebook",
    "writes_outside",
    "hunts_modules",
    "follows_symlinks",
    "reads_proc",
    "reaches_the_network",
)
# Some that it stops, one of each kind.
STOPPED_WITHOUT_WALLS = (
    "forged_replies",
    "searches_memory",
    "replaced_builtins",
    "outlives_all",
    "spins_after_its_cell",
)


def unstopped() -> dict[str, str]:
    """Where bubblewrap is missing: the attacks that get through, and how far."""
    return {name: attack.fallback for name, attack in ATTACKS.items() if attack.fallback}
