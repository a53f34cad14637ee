"""Gravity from the weights: P, its rate, and the Jacobians of the centres of mass of two links."""

import numpy as np

from autograder.proofs.subject import WORLDS, Reason, Subject

N, SPACE = 2, 3
MEANINGS = {
    "qd": "q̇, the two velocities",
    "g": "the gravity vector, a column of 2",
    "dPdq": "the column of the slopes of P along the coordinates",
    "P": "the potential energy",
    "Pdot": "the rate of P",
    "m1": "the mass of link 1",
    "m2": "the mass of link 2",
    "g0": "the gravitational acceleration as a vector, a column of 3 that points down",
    "p1": "the place of the centre of mass of link 1, a column of 3",
    "p2": "the place of the centre of mass of link 2, a column of 3",
    "v1": "its velocity, of link 1",
    "v2": "its velocity, of link 2",
    "J1": "the Jacobian of the centre of mass of link 1, 3×2",
    "J2": "the Jacobian of the centre of mass of link 2, 3×2",
}
RATES = {"P": "Pdot", "p1": "v1", "p2": "v2"}
POTENTIAL = ("P", "-m1 g0' p1 - m2 g0' p2")
VELOCITIES = (("v1", "J1 qd"), ("v2", "J2 qd"))
REASONS = (
    Reason("gradient of P", "what g has to do with P", "a definition", (("g", "dPdq"),)),
    Reason(
        "chain rule", "P changes with time because q does", "a rule of calculus",
        (("Pdot", "dPdq' qd"),),
    ),
    Reason("potential energy", "what P is, from masses and places", "a definition", (POTENTIAL,)),
    Reason(
        "product rule",
        "the derivative of a product; m1, m2 and g0 are constant",
        "a rule of calculus",
        rules=("t",),
    ),
    Reason(
        "Jacobians", "the velocities of the centres of mass, from q̇", "a definition", VELOCITIES
    ),
)  # fmt: skip


def draw(rng: np.random.Generator, given: frozenset[str]) -> dict[str, np.ndarray]:
    """(WORLDS, rows, columns) for each name."""

    def random(rows: int = 1, columns: int = 1) -> np.ndarray:
        return rng.normal(size=(WORLDS, rows, columns))

    numbers = {name: random(N) for name in ("qd", "g", "dPdq")}
    numbers |= {name: random(SPACE) for name in ("g0", "p1", "p2", "v1", "v2")}
    numbers |= {name: random(SPACE, N) for name in ("J1", "J2")}
    numbers |= {name: rng.uniform(0.5, 3.0, size=(WORLDS, 1, 1)) for name in ("m1", "m2")}
    if "potential energy" not in given:
        numbers["Pdot"] = random()
    return numbers | {"P": random()}


WEIGHTS = Subject(
    MEANINGS,
    RATES,
    constants={name: frozenset({"t"}) for name in ("m1", "m2", "g0")},
    variables=frozenset(),
    reasons=REASONS,
    draw=draw,
    truth=frozenset({"potential energy"}),
    true_definitions=(
        POTENTIAL,
        *VELOCITIES,
        ("dPdq", "-m1 J1' g0 - m2 J2' g0"),
        ("g", "-m1 J1' g0 - m2 J2' g0"),
    ),
)
