"""The answers that are asked for, a file each: how it follows from the energies, and how it is judged.

Those that are linear in the energies are sums of what the terms contribute. So a wrong term changes
one by the difference of two contributions, and nothing else has to be derived again. The others are
made of these (`composition.py`).
"""

from autograder.mutation.answers.answer import Answer
from autograder.mutation.answers.coriolis import CORIOLIS
from autograder.mutation.answers.energy_drift import ENERGY, ENERGY_DRIFT
from autograder.mutation.answers.first_order import FIRST_ORDER
from autograder.mutation.answers.gravity import GRAVITY
from autograder.mutation.answers.inertia_matrix import INERTIA_MATRIX
from autograder.mutation.answers.inertia_rate import INERTIA_RATE
from autograder.mutation.answers.lagrangian import LAGRANGIAN
from autograder.mutation.answers.potential_energy import POTENTIAL_ENERGY

__all__ = ["ANSWERS", "PARTS", "Answer"]

ANSWERS = {
    answer.name: answer
    for answer in (
        INERTIA_MATRIX,
        CORIOLIS,
        INERTIA_RATE,
        GRAVITY,
        POTENTIAL_ENERGY,
        FIRST_ORDER,
        LAGRANGIAN,
        ENERGY_DRIFT,
    )
}
# What others are made of, and no student is asked for.
PARTS = {ENERGY.name: ENERGY}
