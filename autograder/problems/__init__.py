"""The checks of every problem, by the grade_id of the cell they judge."""

import difflib

from autograder.problems import (
    c6_regressor,
    p1_inertia,
    p2_energy_skew,
    p3_pendulum,
    p4_gravity,
    p5_state_space,
    start_here,
)

MODULES = (
    start_here,
    p1_inertia,
    p2_energy_skew,
    p3_pendulum,
    p4_gravity,
    p5_state_space,
    c6_regressor,
)
CHECKS = {check.id: check for module in MODULES for check in module.CHECKS}


def known_check(id: str) -> str:
    """The id, where a check has it; else ValueError, with the one that is nearest."""
    if id not in CHECKS:
        close = difflib.get_close_matches(id, CHECKS, n=1)
        meant = f"; did you mean {close[0]!r}?" if close else f"; known are {', '.join(CHECKS)}"
        raise ValueError(f"there is no check {id!r}{meant}")
    return id
