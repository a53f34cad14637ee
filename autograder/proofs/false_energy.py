"""The usual false proofs about the energy and the matrix Ṁ − 2C, which several derivations share."""

from autograder.proofs import energy
from autograder.proofs.derivation import FalseStep

ENERGY_IS_NOT_ENOUGH = (
    "Energy does not give this. It says that Ṁ − 2C gives zero between q̇ᵀ and q̇, with the same "
    "q̇ that stands in C. What is claimed here is about every entry of the matrix: which other "
    "fact does that need?"
)
OF_C = (
    FalseStep(
        "C is skew",
        "This step takes C itself to be skew-symmetric. Is it C that has this property, or "
        "another matrix?",
        property=energy.C_IS_SKEW,
    ),
    FalseStep(
        "Ṁ = 2C",
        "This step puts 2C for Ṁ, as if they were equal. A matrix that gives zero between q̇ᵀ "
        "and q̇ need not be zero.",
        (("Mdot", "2 C"),),
    ),
    FalseStep(
        "Ṁ = C",
        "This step puts C for Ṁ, as if they were equal. How much of Ṁ does C hold?",
        (("Mdot", "C"),),
    ),
    FalseStep(
        "M constant",
        "This step loses the change of M. M depends on q, and q moves.",
        (("Mdot", "0 M"),),
        gone="Mdot",
    ),
)
K_WITHOUT_HALF = FalseStep(
    "K without its half",
    "Look at the factor of the kinetic energy in this step.",
    (("K", "qd' M qd"),),
)


def of_energy(friction: str = "") -> tuple[FalseStep, ...]:
    """Of a rate of the energy. friction: what else is in the equation of motion, as " + f"."""
    return (
        FalseStep(
            "gravity reversed",
            "In this step gravity has the wrong sign. On which side of the equation of motion "
            "does it stand?",
            (("u", f"M qdd + C qd - g{friction}"),),
        ),
        FalseStep(
            "C reversed",
            "In this step C q̇ has the wrong sign. On which side of the equation of motion does "
            "it stand?",
            (("u", f"M qdd - C qd + g{friction}"),),
        ),
        *OF_C,
        FalseStep(
            "no gravity",
            "This step loses gravity, or counts it once too often. Look for it in each term.",
            (("g", "0 qd"),),
        ),
        FalseStep(
            "no torque",
            "This step takes the motors to give no torque. Who has switched them off?",
            (("qdd", f"-M^-1 (C qd + g{friction})"),),
            gone="u",
        ),
        K_WITHOUT_HALF,
    )
