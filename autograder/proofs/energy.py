"""The energy of any mechanism: E = K + P, M, C, g, and what ties them.

The numbers are drawn at random. Any symmetric positive definite M with any symmetric ∂M/∂qk is that of
some mechanism in some state, so this draws mechanisms.
"""

import numpy as np

from autograder.proofs.subject import WORLDS, Reason, Subject

N = 3
SYMMETRY, CHAIN, SKEW, BALANCE = (
    "symmetry of M",
    "chain rule",
    "skew-symmetry",
    "energy balance",
)
C_IS_SKEW = "C is skew"

MEANINGS = {
    "qd": "q̇, the velocities",
    "qdd": "q̈, the accelerations",
    "z": "any vector, whatever q̇ is",
    "u": "the motors' torques",
    "M": "the inertia matrix",
    "Mdot": "Ṁ, its rate",
    "C": "the Coriolis matrix",
    "g": "the gravity vector",
    "dPdq": "the column of the slopes of P along the coordinates",
    "N": "short for Mdot - 2 C",
    "W": "the matrix whose column j is the slope of M q̇ along qj, with q̇ held",
    "K": "the kinetic energy",
    "P": "the potential energy",
    "E": "the energy",
    "Kdot": "the rate of K",
    "Pdot": "the rate of P",
    "Edot": "the rate of E",
}
RATES = {"qd": "qdd", "M": "Mdot", "K": "Kdot", "P": "Pdot", "E": "Edot"}
CHRISTOFFEL = ("C", "1/2 (Mdot + W - W')")


def _reasons(motion: str) -> tuple[Reason, ...]:
    return (
        Reason("definition of E", "E is the sum of K and P", "a definition", (("E", "K + P"),)),
        Reason(
            "kinetic energy",
            "what K is, in terms of M and q̇",
            "a definition",
            (("K", "1/2 qd' M qd"),),
        ),
        Reason("product rule", "the derivative of a product", "a rule of calculus", rules=("t",)),
        Reason(
            CHAIN,
            "P and M change with time because q does",
            "a rule of calculus",
            (("Pdot", "dPdq' qd"),),
        ),
        Reason(SYMMETRY, "M, and with it Ṁ, equals its transpose", "a property of M"),
        Reason("gradient of P", "what g has to do with P", "a definition", (("g", "dPdq"),)),
        Reason("equation of motion", "what u does", "the law of motion", (("u", motion),)),
        Reason(
            "Christoffel symbols",
            "C is made of the slopes of M in Christoffel's way",
            "a property of C",
            (CHRISTOFFEL,),
        ),
        Reason(SKEW, "Ṁ − 2C equals minus its transpose", "a property of C"),
        Reason(
            BALANCE,
            "energy is conserved but for the work of the motors, so that q̇ᵀ(Ṁ − 2C)q̇ is zero",
            "the balance of energy",
        ),
    )


def draw(rng: np.random.Generator, given: frozenset[str]) -> dict[str, np.ndarray]:
    """(WORLDS, rows, columns) for each name."""

    def random(rows: int = 1, columns: int = 1) -> np.ndarray:
        return rng.normal(size=(WORLDS, rows, columns))

    names = ("qd", "qdd", "z", "u", "f", "g", "dPdq")
    numbers = {name: random(N) for name in names} | {name: random() for name in "KPE"}
    qd = numbers["qd"]
    numbers["Pdot"] = random()
    half = random(N, N)
    M = half @ turned(half) / N + np.eye(N)
    slopes = rng.normal(size=(WORLDS, N, N, N))  # ∂M_ij/∂q_k: worlds, k, i, j
    if SYMMETRY in given:
        slopes = slopes + np.swapaxes(slopes, 2, 3)
    else:
        M = M + 0.5 * skew(random(N, N))
    if CHAIN in given:
        Mdot = np.einsum("bkij,bk->bij", slopes, qd[:, :, 0])
        W = np.einsum("bjik,bk->bij", slopes, qd[:, :, 0])
    else:
        Mdot, W = slopes[:, 0], random(N, N)
    rest = random(N, N)  # what is left of Ṁ − 2C
    if SKEW in given:
        rest = skew(rest)
    elif BALANCE in given:
        squared = turned(qd) @ qd
        rest = rest - (turned(qd) @ rest @ qd) / squared**2 * (qd @ turned(qd))
    C = (Mdot - rest) / 2
    if C_IS_SKEW in given:
        C = skew(random(N, N))
    return numbers | {"M": M, "Mdot": Mdot, "W": W, "C": C}


def turned(x: np.ndarray) -> np.ndarray:
    return np.swapaxes(x, 1, 2)


def skew(x: np.ndarray) -> np.ndarray:
    return (x - turned(x)) / 2


def subject(friction: bool) -> Subject:
    """Of a mechanism with friction f, or without."""
    motion = "M qdd + C qd + g" + (" + f" if friction else "")
    meanings = {**MEANINGS, "f": "the friction torques"} if friction else MEANINGS
    reasons = _reasons(motion)
    # Pdot is a consequence of the other definitions, but `draw` has no potential to take it of.
    return Subject(
        meanings,
        RATES,
        constants={},
        variables=frozenset(),
        reasons=reasons,
        draw=draw,
        truth=frozenset({SYMMETRY, CHAIN}),
        true_definitions=tuple(pair for reason in reasons for pair in reason.defines),
        short={"N": "Mdot - 2 C"},
    )


FREE, WITH_FRICTION = subject(friction=False), subject(friction=True)
