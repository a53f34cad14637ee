"""M from the links of an arm with two joints: Jacobians, link inertias, velocities of the links."""

import numpy as np

from autograder.proofs.energy import turned
from autograder.proofs.subject import WORLDS, Reason, Subject

N, LINKS = 2, ("1", "2")
SYMMETRY, OF_LINKS, SEMIDEFINITE, MOVES, DETERMINANT, DIAGONAL, DEFINITE = (
    "symmetry of M",
    "symmetric inertias",
    "semidefinite inertias",
    "no motion without energy",
    "positive determinant",
    "positive diagonal",
    "M is positive definite",
)
MEANINGS = {
    "qd": "q̇, the two velocities, not both zero",
    "M": "the inertia matrix, 2×2",
    "K": "the kinetic energy",
    "J1": "the Jacobian of link 1, 6×2",
    "J2": "the Jacobian of link 2, 6×2",
    "I1": "the spatial inertia of link 1, 6×6",
    "I2": "the spatial inertia of link 2, 6×6",
    "v1": "the velocity of link 1, a column of 6",
    "v2": "the velocity of link 2, a column of 6",
}
FROM_LINKS = ("M", "J1' I1 J1 + J2' I2 J2")
VELOCITIES = (("v1", "J1 qd"), ("v2", "J2 qd"))
IN_JOINTS = ("K", "1/2 qd' M qd")
IN_LINKS = ("K", "1/2 v1' I1 v1 + 1/2 v2' I2 v2")
REASONS = (
    Reason(
        "M from the links", "M is the sum of what the links bring", "a definition", (FROM_LINKS,)
    ),
    Reason("velocities of the links", "what the Jacobians give from q̇", "a definition", VELOCITIES),
    Reason("kinetic energy", "what K is, in terms of M and q̇", "a definition", (IN_JOINTS,)),
    Reason(
        "energies of the links",
        "K is the sum of the energies of the links, from their velocities",
        "a definition",
        (IN_LINKS,),
    ),
    Reason(OF_LINKS, "I1 and I2 equal their transposes", "a property of the link inertias"),
    Reason(
        SEMIDEFINITE,
        "I1 and I2 are symmetric, and no velocity of a link has a negative energy",
        "a property of the link inertias",
    ),
    Reason(
        MOVES,
        "there is no motion in which the energies of both links vanish",
        "a property of the arm",
    ),
    Reason(SYMMETRY, "M equals its transpose", "a property of M"),
    Reason(DETERMINANT, "M is symmetric with a determinant above zero", "a property of M"),
    Reason(DIAGONAL, "M is symmetric with a diagonal above zero", "a property of M"),
    Reason(DEFINITE, "M is symmetric, and every motion has energy", "a property of M"),
)


def draw(rng: np.random.Generator, given: frozenset[str]) -> dict[str, np.ndarray]:
    """(WORLDS, rows, columns) for each name."""

    def random(rows: int = 1, columns: int = 1) -> np.ndarray:
        return rng.normal(size=(WORLDS, rows, columns))

    numbers = {"qd": random(N), "K": random(), "M": _M(random(N, N), given)}
    # An edge of "semidefinite": in half of the worlds a motion costs no energy, at all or in link 1.
    still = np.arange(WORLDS) % 2 == 0
    for link in LINKS:
        J, V = random(6, N), random(6)
        moves = MOVES in given and link == "2"
        free = still & ~np.full(WORLDS, moves)
        numbers |= {f"J{link}": J, f"v{link}": V}
        numbers[f"I{link}"] = _inertia(
            random(6, 6), np.concatenate([J @ numbers["qd"], V], 2), free, given
        )
    if {"kinetic energy", "energies of the links"} <= given and "M from the links" not in given:
        numbers["M"] = _of_the_same_energy(numbers, "velocities of the links" in given)
    return numbers


def _M(M: np.ndarray, given: frozenset[str]) -> np.ndarray:
    if DEFINITE in given:
        return M @ turned(M) + 0.3 * np.eye(N)
    if DETERMINANT in given:  # an edge: both eigenvalues negative in half of the worlds
        sign = np.where(np.arange(WORLDS) % 2 == 0, 1.0, -1.0)[:, None, None]
        return sign * (M @ turned(M) + 0.3 * np.eye(N))
    if DIAGONAL in given:
        M = M + turned(M)
        on = np.eye(N, dtype=bool)
        return np.where(on, abs(M) + 0.1, 3 * M)
    return M + turned(M) if SYMMETRY in given else M


def _inertia(half, velocities, free, given) -> np.ndarray:
    if SEMIDEFINITE not in given:
        return half + turned(half) if OF_LINKS in given else half
    basis, _ = np.linalg.qr(velocities)
    half = half[:, :, :3]  # as of a point mass
    without = half - basis @ (turned(basis) @ half)
    half = np.where(free[:, None, None], without, half)
    return half @ turned(half)


def _of_the_same_energy(numbers, from_joints: bool) -> np.ndarray:
    """M, changed along q̇ alone, so that both ways to K give the same."""
    qd, M = numbers["qd"], numbers["M"]
    energy = np.zeros((WORLDS, 1, 1))
    for link in LINKS:
        V = numbers[f"J{link}"] @ qd if from_joints else numbers[f"v{link}"]
        energy = energy + turned(V) @ numbers[f"I{link}"] @ V
    return M + (energy - turned(qd) @ M @ qd) / (turned(qd) @ qd) ** 2 * (qd @ turned(qd))


ARM = Subject(
    MEANINGS,
    rates={},
    constants={},
    variables=frozenset(),
    reasons=REASONS,
    draw=draw,
    truth=frozenset({OF_LINKS, SEMIDEFINITE, MOVES}),
    true_definitions=(FROM_LINKS, *VELOCITIES, IN_JOINTS),
)
