"""What a problem asks in words, answer by answer."""

import re

from autograder.mechanisms import Mechanism
from autograder.mutation.inertial_parameters import inertial_parameters

POINTS = {
    "potential_energy": 2, "M": 3, "M_dot": 3, "g_vec": 2, "C": 4, "lagrangian": 2, "f": 4,
    "energy_drift": 2, "regressor": 4,
}  # fmt: skip
WHAT = {
    "potential_energy": (
        "The potential energy",
        "Write $P(q)$. Where you put its zero is up to you. Sum the energies of all bodies and springs.",
        "Potential energy, J.",
    ),
    "M": (
        "The inertia matrix",
        "Write $M(q)$, so that the kinetic energy is "
        "$K = \\tfrac12 \\dot q^{\\mathsf T} M(q)\\, \\dot q$. "
        "Before you run the check, say which of its entries change with $q$.",
        "Inertia matrix, ({n}, {n}).",
    ),
    "M_dot": (
        "The rate of the inertia matrix",
        "Write $\\dot M(q, \\dot q)$, the derivative of $M(q(t))$ with respect to time along a motion.",
        "dM/dt along qd, ({n}, {n}).",
    ),
    "g_vec": (
        "The vector $g(q)$",
        "Write $g(q) = \\partial P / \\partial q$, on the **left** of the equation of motion. Predict "
        "its signs for one position before you run the check.",
        "∂P/∂q, ({n},): gravity and springs.",
    ),
    "lagrangian": (
        "The Lagrangian",
        "Write $L = K - P$. Where you put the zero of $P$ is up to you.",
        "Lagrangian K − P, J.",
    ),
    "f": (
        "The first-order form",
        "Write $\\dot x = f(x, u)$ for the state $x = [q;\\, \\dot q]$. Predict $\\dot x$ for a "
        "mechanism at rest before you run the check.{friction}",
        "ẋ of the state x = [q; q̇], ({twice},), under the input u, ({n},).",
    ),
    "regressor": (
        "The regressor",
        "The left side of the equation of motion without friction is linear in the parameters "
        "$\\pi$ = ({pi}). Write $Y(q, \\dot q, \\ddot q)$ with $Y \\pi = M\\ddot q + C\\dot q + g$: "
        "one column for each entry of $\\pi$, in this order. Of `arm`, $Y$ may use only "
        "what is known: {known}.",
        "Y with Y π = M q̈ + C q̇ + g, ({n}, {count}), for π = ({pi}).",
    ),
    "energy_drift": (
        "The drift of the energy",
        "A simulation gives states, one in each row of `x`. Write by how much the energy $E = K + P$ "
        "has changed since the first of them, for each row.",
        "E of each row of x less E of the first, (len(x),), J.",
    ),
    "C": (
        "The matrix $C(q, \\dot q)$",
        "Write $C(q, \\dot q)$ in the Christoffel form. The check looks at $C\\dot q$, at the energy, "
        "and at $\\dot M - 2C$.",
        "Coriolis and centrifugal matrix in Christoffel form, ({n}, {n}).",
    ),
}
FRICTION = (
    " The friction $f(\\dot q)$ has two parts in each coordinate: the viscous one is its "
    "coefficient times the velocity, and the Coulomb one is its coefficient times the sign of "
    "the velocity, 0 at rest."
)


def task_of(mechanism: Mechanism, answer: str) -> list[str]:
    """Title, task and docstring, filled in for this mechanism."""
    entries = [pi.words for pi in inertial_parameters(mechanism)]
    known = {
        "n": mechanism.n,
        "twice": 2 * mechanism.n,
        "count": len(entries),
        "pi": ", ".join(entries),
        "known": ", ".join(f"`{p.name}`" for p in mechanism.parameters if p.known) or "nothing",
        "friction": FRICTION if mechanism.friction else "",
    }
    return [
        re.sub(r"\{(n|twice|count|pi|known|friction)\}", lambda at: str(known[at[1]]), text)
        for text in WHAT[answer]
    ]
