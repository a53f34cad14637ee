"""Takes one step of a fixed-step method for ẋ = rate(t, x); `simulate` takes many.

Symplectic means: for a Hamiltonian system the step, as a map of the canonical variables (q, p),
keeps the form Σ dq ∧ dp, so that over long runs the energy error stays bounded instead of growing.
The state of an arm here is (q, q̇), which is canonical, up to constants, only where M is constant
(a pendulum); elsewhere p = M(q) q̇ depends on q, and a method that is symplectic in (q, p) is not
in (q, q̇). E. Hairer, C. Lubich, G. Wanner (2006), Geometric Numerical Integration, chapter VI.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from armdyn.discrete_gradient import energy_momentum
from armdyn.iteration import to_rounding

Rate = Callable[[float, np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Integrator:
    """A fixed-step method: step(rate, t, x, dt) gives the state after dt, of the shape of x.

    order: the error after a given time shrinks as dt to this power, for a smooth rate.
    split: the state is [positions; velocities], of even size.
    of_model: the step asks M, C, g, f and P of the model: `rate.model` is a Manipulator, and
    `rate.input(t, x)` its input.
    """

    step: Callable[..., np.ndarray]
    order: int
    split: bool = False
    of_model: bool = False


def euler(rate: Rate, t: float, x: np.ndarray, dt: float) -> np.ndarray:
    """Order 1, explicit, not symplectic; the energy of a free arm grows.

    Source: L. Euler (1768), Institutionum calculi integralis, volume 1.
    """
    return x + dt * rate(t, x)


def semi_implicit_euler(rate: Rate, t: float, x: np.ndarray, dt: float) -> np.ndarray:
    """Order 1, explicit; symplectic for a rate [q̇(p); ṗ(q)], not for every arm.

    The velocities step first, then the positions with the new velocities: of x = [q; v], first
    v' = v + dt v̇(q, v), then q' = q + dt q̇(q, v'). Where q̇ depends on the second half of the state
    alone and its rate on the first alone (a pendulum without friction), this is symplectic. With
    an M(q) that varies, q̈ depends on q̇ too, and the step is symplectic in no such variables; its
    energy error often stays bounded nevertheless.

    Source: R. de Vogelaere (1956), Methods of integration which preserve the contact
    transformation property of the Hamilton equations, University of Notre Dame, report 4.
    """
    n = x.shape[-1] // 2
    half = x.copy()
    half[..., n:] += dt * rate(t, x)[..., n:]
    half[..., :n] += dt * rate(t, half)[..., :n]
    return half


def rk4(rate: Rate, t: float, x: np.ndarray, dt: float) -> np.ndarray:
    """Order 4, explicit, not symplectic; the energy of a free arm drifts slowly, as dt⁵ per time.

    Source: W. Kutta (1901), Beitrag zur näherungsweisen Integration totaler
    Differentialgleichungen, Zeitschrift für Mathematik und Physik 46.
    """
    k1 = rate(t, x)
    k2 = rate(t + dt / 2, x + dt / 2 * k1)
    k3 = rate(t + dt / 2, x + dt / 2 * k2)
    k4 = rate(t + dt, x + dt * k3)
    return x + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def implicit_midpoint(rate: Rate, t: float, x: np.ndarray, dt: float) -> np.ndarray:
    """Order 2, implicit, symplectic in canonical variables (q, p); also its own inverse in time.

    x' = x + dt k with k = rate(t + dt/2, x + dt/2 k), by fixed-point iteration to rounding. On the
    (q, q̇) of an arm whose M varies it is not symplectic, but it stays symmetric: x' stepped by −dt
    is x, and the energy error of a free arm stays bounded in most runs.

    Raises FloatingPointError, with the time, where the iteration does not converge: dt/2 times the
    rate's Lipschitz constant must be below 1, and a jump (Coulomb friction near rest) has none.

    Source: E. Hairer, C. Lubich, G. Wanner (2006), Geometric Numerical Integration, chapters II,
    V (symmetry) and VIII (iterating to rounding).
    """
    return x + to_rounding(
        lambda change: dt * rate(t + dt / 2, x + change / 2),
        dt * rate(t, x),
        x,
        "implicit_midpoint",
        t,
        dt,
    )


INTEGRATORS = {
    "euler": Integrator(euler, order=1),
    "semi_implicit_euler": Integrator(semi_implicit_euler, order=1, split=True),
    "rk4": Integrator(rk4, order=4),
    "implicit_midpoint": Integrator(implicit_midpoint, order=2),
    "energy_momentum": Integrator(energy_momentum, order=2, split=True, of_model=True),
}
