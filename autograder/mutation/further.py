"""What a right answer leads to, true of every mechanism of which it is said."""

from autograder.mechanisms import Mechanism
from autograder.mutation.sentences.notation import written

OF_ALL = {
    "M": "½ q̇ᵀ M q̇ is more than 0 as soon as anything moves, so M always has an inverse, and the "
    "equation of motion always gives q̈.",
    "M_dot": "The power of Ṁ, ½ q̇ᵀ Ṁ q̇, is that of C q̇. This is why both cancel in the rate of the "
    "energy.",
    "C": "With this C, Ṁ − 2C is skew-symmetric. This is why C does not appear in the rate of the "
    "energy.",
    "g_vec": "Where all entries of g are 0, the mechanism can rest without its motors.",
    "potential_energy": "A constant added to P changes no torque: only differences of P count.",
    "lagrangian": "A constant added to P changes L, but no equation of motion.",
    "f": "Without motors and friction, the energy keeps its value along every motion. So it tests your "
    "f even where nobody knows the right motion.",
    "energy_drift": "In a free run without friction, a drift that shrinks with the time step comes from "
    "the integrator, and one that stays comes from the equations.",
    "regressor": "Two of these mechanisms with the same π, and the same of what is known, need the same "
    "torques in every motion. So no measured torque tells them apart.",
}


def further(mechanism: Mechanism, answer: str) -> str:
    """One sentence: the mechanism's own, or of a coordinate on which M or g does not depend."""
    if own := mechanism.further.get(answer):
        return own
    energies = {"M": mechanism.K, "g_vec": mechanism.P}
    if answer in energies:
        stands = energies[answer].free_symbols
        absent = [c.name for c in mechanism.coordinates if c.symbol not in stands]
        if absent and len(absent) < mechanism.n:
            said = {
                "M": f"K is the same at every {absent[0]}, so M does not change with {absent[0]}.",
                "g_vec": f"P is the same at every {absent[0]}, so neither weight nor a spring pulls "
                "along it, wherever the mechanism stands.",
            }[answer]
            return written(said, mechanism)
        if answer == "M" and absent:
            return "K is the same at every position, so M never changes, and C q̇ is 0."
    return OF_ALL[answer]
