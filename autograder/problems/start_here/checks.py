"""The warm-up of lesson 00."""

from autograder.judging.check import Check, Criterion
from autograder.problems.start_here import mistakes
from autograder.protocol import Call


def _calls(rng, count):
    return [
        Call("kinetic_energy", (rng.uniform(0.1, 2.0), rng.uniform(-4.0, 4.0)))
        for _ in range(count)
    ]


CHECKS = (
    Check(
        id="start-kinetic-energy",
        signature="kinetic_energy(I, qd)",
        reference=lambda I, qd: 0.5 * I * qd**2,
        calls=_calls,
        criteria=(Criterion("kinetic energy of a body that turns", "J"),),
        mistakes=mistakes.KINETIC_ENERGY,
        further=("Twice the velocity means four times the energy, whichever way the body turns."),
    ),
)
