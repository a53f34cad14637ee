"""Finds the equilibria of an arm, where it rests against gravity without any torque."""

import itertools
from dataclasses import dataclass

import numpy as np

STARTS = 8  # per joint, at first
ROUNDS = 3
ITERATIONS = 60
LONGEST = 0.5  # rad, of one step
DIFFERENCE = 1e-5  # rad
SMALL = 1e-9
SAME = 1e-6  # rad


@dataclass(frozen=True)
class Equilibrium:
    """A configuration with g(q) = 0, and what P has there.

    q: (n,), rad, each in (−π, π]. stiffness: (n,), N·m/rad, the eigenvalues of ∂g/∂q in rising
    order. kind: "minimum" (all positive: the arm stays near), "maximum" (all negative) or "saddle".
    """

    q: np.ndarray
    stiffness: np.ndarray

    @property
    def kind(self) -> str:
        if self.stiffness[0] > 0:
            return "minimum"
        return "maximum" if self.stiffness[-1] < 0 else "saddle"


def equilibria(model) -> tuple[Equilibrium, ...]:
    """All q with g(q) = 0 of an arm with revolute joints, the lowest potential energy first.

    model: a Manipulator with up to 3 joints. Newton's method, from a grid of starts that grows
    until the count agrees with the Poincaré–Hopf theorem: on a torus, equilibria with an even and
    with an odd number of negative stiffnesses are equally many.
    Raises ValueError for more joints, and where equilibria are not isolated (no gravity, or a joint
    on which none acts); RuntimeError where the counts never agree.

    Source: J. Milnor (1965), Topology from the Differentiable Viewpoint, section 6.
    """
    if model.n > 3:
        raise ValueError(f"model: needs up to 3 joints, has {model.n}")
    for starts in (STARTS * 2**k for k in range(ROUNDS)):
        found = [
            Equilibrium(q, np.linalg.eigvalsh(_stiffness(model, q))) for q in _roots(model, starts)
        ]
        for point in found:
            if np.min(np.abs(point.stiffness)) <= 1e-6 * np.max(np.abs(point.stiffness)):
                raise _not_isolated(model)
        if found and sum((-1) ** int(np.sum(point.stiffness < 0)) for point in found) == 0:
            return tuple(sorted(found, key=lambda point: model.potential_energy(point.q)))
    raise RuntimeError(f"not all equilibria of {model} were found; are its joints revolute?")


def _not_isolated(model) -> ValueError:
    return ValueError(
        f"model = {model}: its equilibria are not isolated; needs gravity that acts on every joint"
    )


def _roots(model, starts) -> list[np.ndarray]:
    grid = np.linspace(-np.pi, np.pi, starts, endpoint=False) + 0.1
    q = np.array(list(itertools.product(grid, repeat=model.n)))
    largest = np.max(np.abs(model.g_vec(q)))
    if largest == 0:
        raise _not_isolated(model)
    for _ in range(ITERATIONS):
        # The pseudo-inverse, for starts where the stiffness is singular.
        step = np.matvec(np.linalg.pinv(_stiffness(model, q), hermitian=True), model.g_vec(q))
        length = np.linalg.norm(step, axis=-1, keepdims=True)
        q = q - step * np.minimum(1, LONGEST / np.maximum(length, SMALL))
    q = q[np.max(np.abs(model.g_vec(q)), axis=-1) <= SMALL * largest]
    distinct: list[np.ndarray] = []
    for one in np.pi - (np.pi - q) % (2 * np.pi):
        if all(np.max(np.abs(_turned(one - other))) > SAME for other in distinct):
            distinct.append(one)
    return distinct


def _turned(angle) -> np.ndarray:
    return (angle + np.pi) % (2 * np.pi) - np.pi


def _stiffness(model, q) -> np.ndarray:
    """∂g/∂q by central differences, symmetric, (..., n, n), N·m/rad."""
    steps = DIFFERENCE * np.eye(model.n)
    columns = [(model.g_vec(q + e) - model.g_vec(q - e)) / (2 * DIFFERENCE) for e in steps]
    H = np.stack(columns, axis=-1)
    return (H + np.swapaxes(H, -1, -2)) / 2
