"""The pendulum: numbers alone, with partial derivatives by q and q̇."""

import numpy as np

from autograder.proofs.subject import WORLDS, Reason, Subject

MEANINGS = {
    "q": "the angle from hanging straight down",
    "qd": "q̇",
    "qdd": "q̈",
    "u": "the torque at the pivot",
    "m": "the mass",
    "g": "the gravitational acceleration",
    "lc": "the distance from the pivot to the centre of mass",
    "I": "the inertia about the pivot",
    "K": "the kinetic energy",
    "P": "the potential energy",
    "L": "the Lagrangian",
}
RATES = {"q": "qd", "qd": "qdd"}
KINETIC, POTENTIAL = ("K", "1/2 I qd^2"), ("P", "m g lc (1 - cos(q))")
LAGRANGIAN = ("L", "K - P")
MOTION = ("u", "d/dt(d/dqd(L)) - d/dq(L)")
REASONS = (
    Reason("definition of L", "what L is, in terms of K and P", "a definition", (LAGRANGIAN,)),
    Reason(
        "kinetic energy",
        "what K is, for a body that turns about a pivot",
        "a definition",
        (KINETIC,),
    ),
    Reason(
        "potential energy",
        "what P is, from the height of the centre of mass, zero at the lowest place",
        "a definition",
        (POTENTIAL,),
    ),
    Reason("Euler-Lagrange", "what u is, in terms of L", "the law of motion", (MOTION,)),
    Reason(
        "partial derivatives",
        "of products, powers, sine and cosine, by q with q̇ held or by q̇ with q held; P holds no q̇",
        "a rule of calculus",
        rules=("q", "qd"),
    ),
    Reason(
        "time derivative",
        "of products, powers, sine and cosine; m, g, lc and I are constant",
        "a rule of calculus",
        rules=("t",),
    ),
)


def draw(rng: np.random.Generator, given: frozenset[str]) -> dict[str, np.ndarray]:
    """(WORLDS, 1, 1) for each name."""
    numbers = {name: rng.normal(size=(WORLDS, 1, 1)) for name in MEANINGS}
    for name in ("m", "g", "lc", "I"):
        numbers[name] = rng.uniform(0.3, 3.0, size=(WORLDS, 1, 1))
    return numbers


PENDULUM = Subject(
    MEANINGS,
    RATES,
    constants={
        **{name: frozenset({"t", "q", "qd"}) for name in ("m", "g", "lc", "I")},
        "P": frozenset({"qd"}),
        "q": frozenset({"qd"}),
        "qd": frozenset({"q"}),
    },
    variables=frozenset({"q", "qd"}),
    reasons=REASONS,
    draw=draw,
    truth=frozenset(),
    true_definitions=(LAGRANGIAN, KINETIC, POTENTIAL, MOTION),
)
