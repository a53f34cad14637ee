"""Ways from one answer to another that hold for every mechanism, most of them derivatives.

A derivative is taken by central differences of order 4, so that its error is rounding. q, q̇: (n,).
"""

import numpy as np

from autograder.judging.carried.follows import Way
from autograder.protocol import Call

# At this step, of a formula in angles or metres, truncation and rounding are each less than 1e-10.
STEP = 2e-3
STEPS = STEP * np.array([-2.0, -1.0, 1.0, 2.0])
WEIGHTS = np.array([1.0, -8.0, 8.0, -1.0]) / (12 * STEP)
# Of a second derivative, with the value itself in the middle.
SECOND = np.array([-1.0, 16.0, -30.0, 16.0, -1.0]) / 12


def derivative(values) -> np.ndarray:
    """The derivative from the values at STEPS; (4, …) → (…)."""
    return np.tensordot(WEIGHTS, np.array(values, dtype=float), 1)


def _around(name: str, q, *more) -> list[Call]:
    """Calls of the function at steps along each coordinate in turn."""
    return [Call(name, (q + step * axis, *more)) for axis in np.eye(len(q)) for step in STEPS]


def _slopes(numbers: list, n: int, *shape: int) -> np.ndarray:
    """The derivatives by each coordinate, (n, *shape), of what `_around` gave."""
    values = [np.reshape(value, shape) for value in numbers]
    return np.array([derivative(values[4 * k : 4 * k + 4]) for k in range(n)])


def christoffel(slopes, qd) -> np.ndarray:
    """C in Christoffel form, (n, n), from ∂M/∂q_k, (n, n, n) with k first."""
    first = np.einsum("kij,k->ij", slopes, qd)
    second = np.einsum("jik,k->ij", slopes, qd)
    third = np.einsum("ijk,k->ij", slopes, qd)
    return (first + second - third) / 2


def _gradient(call, value, numbers):
    return _slopes(numbers, len(call.args[0]))


GRADIENT = Way(
    lambda call, value: _around("potential_energy", call.args[0], call.args[-1]), _gradient
)


def _from_inertia(call, value, numbers):
    n = len(call.args[0])
    return christoffel(_slopes(numbers, n, n, n), call.args[1])


CHRISTOFFEL = Way(lambda call, value: _around("M", call.args[0], call.args[-1]), _from_inertia)


def _along(call, value):
    q, qd, arm = call.args
    return [Call("M", (q + step * qd, arm)) for step in STEPS]


def _rate(call, value, numbers):
    n = len(call.args[0])
    return derivative([np.reshape(number, (n, n)) for number in numbers])


RATE = Way(_along, _rate)


def _unit_rates(call, value):
    """Ṁ where one joint moves at 1 rad/s is ∂M by that coordinate."""
    q, qd, arm = call.args
    return [Call("M_dot", (q, axis, arm)) for axis in np.eye(len(qd))]


def _from_rates(call, value, numbers):
    n = len(call.args[1])
    return christoffel(np.array([np.reshape(rate, (n, n)) for rate in numbers]), call.args[1])


CHRISTOFFEL_OF_RATES = Way(_unit_rates, _from_rates)


def _energies(call, value):
    """M and P at each row of x."""
    x, arm = call.args
    n = x.shape[1] // 2
    return [Call(name, (row[:n], arm)) for name in ("M", "potential_energy") for row in x]


def _drift(call, value, numbers):
    x, n = call.args[0], call.args[0].shape[1] // 2
    inertias, potentials = numbers[: len(x)], numbers[len(x) :]
    kinetic = [0.5 * row[n:] @ np.reshape(M, (n, n)) @ row[n:]
               for row, M in zip(x, inertias, strict=True)]  # fmt: skip
    energy = np.array(kinetic) + np.reshape(potentials, len(x))
    return energy - energy[0]


DRIFT = Way(_energies, _drift)


# A constant in P, which no equation of motion sees, is free in L too.
POTENTIAL_PART = Way(
    lambda call, value: [Call("potential_energy", (call.args[0], call.args[-1]))],
    lambda call, value, numbers: -np.reshape(numbers[0], ()),
)


def _moving(call, value):
    """L at rest, and with each pair of joints moving: it is a square of q̇."""
    q, arm = call.args
    axes = np.eye(len(q))
    pairs = [a + b for a in axes for b in axes]
    return [Call("lagrangian", (q, qd, arm)) for qd in (0 * q, *axes, *-axes, *pairs)]


def _inertia(call, value, numbers):
    n = len(call.args[0])
    at_rest, *moving = (float(np.reshape(L, ())) for L in numbers)
    forth, pairs = np.array(moving[:n]) - at_rest, np.reshape(moving[2 * n :], (n, n)) - at_rest
    back = np.array(moving[n : 2 * n]) - at_rest
    if not np.allclose(forth, back):
        return None  # no energy of a motion
    return pairs - forth[:, np.newaxis] - forth


INERTIA = Way(_moving, _inertia)


def _at_rest(call, value):
    q, arm = call.args
    return _around("lagrangian", q, 0 * q, arm)


GRADIENT_IN_L = Way(_at_rest, lambda call, value, numbers: -_gradient(call, value, numbers))


def accelerations(friction) -> Way:
    """ẋ from M, C and g. friction(q, qd, arm): the friction torques, (n,)."""

    def asks(call, value):
        x, _, arm = call.args
        q, qd = np.split(x, 2)
        return [Call("M", (q, arm)), Call("C", (q, qd, arm)), Call("g_vec", (q, arm))]

    def made(call, value, numbers):
        x, u, arm = call.args
        q, qd = np.split(x, 2)
        n = len(qd)
        M, C, g = (np.reshape(a, s) for a, s in zip(numbers, ((n, n), (n, n), n), strict=True))
        rest = C @ qd + g + friction(q, qd, arm)
        return np.concatenate([qd, np.linalg.solve(M, np.reshape(u, n) - rest)])

    return Way(asks, made)
