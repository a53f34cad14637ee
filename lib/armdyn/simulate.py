"""Simulation of ẋ = f(x, u): a fixed-step RK4, and SciPy's solvers behind the same call."""

from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

Input = np.ndarray | Callable[[float, np.ndarray], np.ndarray]

SCIPY_METHODS = ("RK45", "RK23", "DOP853", "Radau", "BDF", "LSODA")


def rk4_step(f, x, u, dt: float) -> np.ndarray:
    """One step of the classical Runge-Kutta method, order 4, with u held over the step.

    f(x, u) gives ẋ. x: (..., N). dt in s. Returns the state after dt, (..., N).

    Source: W. Kutta (1901), Beitrag zur näherungsweisen Integration totaler
    Differentialgleichungen, Zeitschrift für Mathematik und Physik 46.
    """
    return _rk4(lambda _, x: f(x, u), 0.0, np.asarray(x, dtype=float), dt)


def simulate(f, x0, u, t, method: str = "rk4", rtol: float = 1e-9, atol: float = 1e-12):
    """States of ẋ = f(x, u) at the times `t`, from x(t[0]) = x0.

    f(x, u): the state form, such as `arm.state_derivative`, x = [q; q̇].
    x0: (N,), or (..., N) for many arms at once (method "rk4" only).
    u: (n,), held constant, or a function u(t, x) that gives it, N·m.
    t: (T,), increasing, s. Method "rk4" takes one step from each time to the next; one of
    SciPy's methods ("RK45", "DOP853", "LSODA", ...) chooses its own steps by rtol and atol.

    Returns (..., T, N). Raises ValueError for times that do not increase, for states or derivatives
    of the wrong shape and for an unknown method; FloatingPointError, with the time, where the
    states stop being finite.
    """
    x0, t = np.asarray(x0, dtype=float), _times(t)
    rate = _rate(f, u)
    slope = np.asarray(rate(t[0], x0), dtype=float)
    if slope.shape != x0.shape:
        raise ValueError(f"f(x0, u) has shape {slope.shape}, needs that of x0, {x0.shape}")
    if method == "rk4":
        return _fixed_steps(rate, x0, t)
    if method not in SCIPY_METHODS:
        raise ValueError(f"method = {method!r}: needs 'rk4' or one of {', '.join(SCIPY_METHODS)}")
    if x0.ndim != 1:
        raise ValueError(f"x0: got shape {x0.shape}; SciPy's methods take one state, (N,)")
    solution = solve_ivp(rate, (t[0], t[-1]), x0, method, t_eval=t, rtol=rtol, atol=atol)
    if not solution.success:
        raise FloatingPointError(
            f"{method} stopped at t = {solution.t[-1]:.6g} s: {solution.message}"
        )
    return solution.y.T


def energy_drift(model, x) -> np.ndarray:
    """E − E₀ along states x of shape (..., T, 2n): (..., T), J.

    Zero for exact motion without input and friction.
    """
    x = np.asarray(x, dtype=float)
    energy = model.energy(x[..., : model.n], x[..., model.n :])
    return energy - energy[..., :1]


def _rate(f, u):
    if callable(u):
        return lambda t, x: f(x, u(t, x))
    u = np.asarray(u, dtype=float)
    return lambda t, x: f(x, u)


def _times(t) -> np.ndarray:
    t = np.asarray(t, dtype=float)
    if t.ndim != 1 or len(t) < 2 or not np.all(np.diff(t) > 0):
        raise ValueError(f"t: needs two or more increasing times, (T,), in s; got shape {t.shape}")
    return t


def _fixed_steps(rate, x0, t) -> np.ndarray:
    states = np.empty((len(t), *x0.shape))
    states[0] = x0
    for k in range(len(t) - 1):
        states[k + 1] = _rk4(rate, t[k], states[k], t[k + 1] - t[k])
        if not np.all(np.isfinite(states[k + 1])):
            raise FloatingPointError(f"the state stopped being finite at t = {t[k + 1]:.6g} s")
    return np.moveaxis(states, 0, -2)


def _rk4(rate, t, x, dt) -> np.ndarray:
    k1 = rate(t, x)
    k2 = rate(t + dt / 2, x + dt / 2 * k1)
    k3 = rate(t + dt / 2, x + dt / 2 * k2)
    k4 = rate(t + dt, x + dt * k3)
    return x + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
