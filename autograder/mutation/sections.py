"""The section of a lesson that prepares each answer, whatever the mechanism."""

from autograder.judging.section import Section
from autograder.mechanisms import Mechanism

_WEIGHT = Section("05-gravity", "05-potential", "1 · From the work of a weight to g(q)")
OF_ALL = {
    "M": Section("03-inertia-matrix", "03-arm", "2 · From the bodies to the arm"),
    "M_dot": Section("04-coriolis-and-skew-symmetry", "04-energy", "2 · What the energy proves"),
    "C": Section(
        "02-from-lagrangian-to-matrices",
        "02-regroup",
        "2 · Regrouping: why the Christoffel symbols look as they do",
    ),
    "g_vec": _WEIGHT,
    "potential_energy": _WEIGHT,
    "lagrangian": Section(
        "01-canonical-form", "01-euler-lagrange", "1 · The Euler–Lagrange equation"
    ),
    "f": Section("10-state-space-and-simulation", "10-state", "1 · The state form"),
    "energy_drift": Section(
        "10-state-space-and-simulation", "10-energy", "3 · The energy as an instrument"
    ),
    "regressor": Section(
        "06-linearity-in-parameters", "06-regressor-hand", "2 · From the energies to the regressor"
    ),
}


def section(mechanism: Mechanism, answer: str) -> Section:
    """The mechanism's own, if it has one for this answer."""
    own = mechanism.sections.get(answer)
    return Section(*own) if own else OF_ALL[answer]
