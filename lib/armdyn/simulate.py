"""Simulation of ẋ = f(x, u): a fixed-step RK4, and SciPy's solvers behind the same call."""

import warnings
from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

from armdyn.parameters import all_finite, finite, positive, real_array, state_vector

Input = np.ndarray | Callable[[float, np.ndarray], np.ndarray]

# Radau and BDF are left out: their Jacobian, by differences, takes the jump of Coulomb friction at
# rest for great stiffness, and they return wrong states without notice.
SCIPY_METHODS = ("RK45", "RK23", "DOP853", "LSODA")


def rk4_step(f, x, u, dt: float) -> np.ndarray:
    """One step of the classical Runge-Kutta method, order 4, with u held over the step.

    f(x, u) gives ẋ. x: (..., N). dt in s. Returns the state after dt, (..., N). Raises ValueError
    for an x or dt that is not finite, and for an ẋ that has not the shape of x.

    Source: W. Kutta (1901), Beitrag zur näherungsweisen Integration totaler
    Differentialgleichungen, Zeitschrift für Mathematik und Physik 46.
    """
    x = all_finite("x", real_array("x", x))
    return _rk4(lambda _, x: _slope(f, x, u, "f(x, u)"), 0.0, x, finite("dt", dt, "s"))


def simulate(
    f, x0, u: Input, t, method: str = "rk4", rtol: float = 1e-9, atol: float = 1e-12
) -> np.ndarray:
    """States of ẋ = f(x, u) at the times `t`, from x(t[0]) = x0.

    f(x, u): the state form, such as `arm.state_derivative`, x = [q; q̇].
    x0: (N,), or (..., N) for many arms at once (method "rk4" only).
    u: (n,), held constant, or a function u(t, x) that gives it, N·m.
    t: (T,), increasing, s. Method "rk4" takes one step from each time to the next; one of
    SciPy's methods ("RK45", "RK23", "DOP853", "LSODA") chooses its own steps by rtol and atol;
    where Coulomb friction holds a joint at rest those steps become very short, and "rk4" is better.

    Returns (..., T, N). Raises ValueError for times that do not increase, for states, inputs or
    derivatives that are not numbers of the right shape and for an unknown method;
    FloatingPointError, with the time, where the states stop being finite or SciPy's method cannot
    go on; and whatever f raises, such as numpy.linalg.LinAlgError at a singular M. NumPy's warnings
    of overflow in f are silent: FloatingPointError stands for them.
    """
    x0, t = all_finite("x0", real_array("x0", x0)), _times(t)
    if x0.ndim == 0 or x0.size == 0:
        raise ValueError(f"x0: got shape {x0.shape}, needs (..., N), such as [q; q̇]")
    if method != "rk4" and method not in SCIPY_METHODS:
        raise ValueError(f"method = {method!r}: needs 'rk4' or one of {', '.join(SCIPY_METHODS)}")
    if method != "rk4" and x0.ndim != 1:
        raise ValueError(f"x0: got shape {x0.shape}; SciPy's methods take one state, (N,)")
    rate = _Rate(f, u)
    try:
        all_finite("ẋ", rate(t[0], x0))
    except np.linalg.LinAlgError:
        raise  # a ValueError by descent, but of the model and not of the arguments
    except ValueError as error:
        raise ValueError(f"f(x0, u) at t = {t[0]:.6g} s, x0 = {x0}: {error}") from error
    # Adaptive methods try steps that overflow and take them back; it is the outcome that counts.
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        if method == "rk4":
            return _fixed_steps(rate, x0, t)
        return _adaptive(rate, x0, t, method, positive("rtol", rtol, "1"), atol)


def energy_drift(model, x) -> np.ndarray:
    """E − E₀ along states x of shape (..., T, 2n): (..., T), J.

    Zero for exact motion without input and friction. Raises ValueError for another shape.
    """
    x = state_vector("x", x, 2 * model.n)
    if x.ndim < 2 or x.shape[-2] == 0:
        raise ValueError(f"x: got shape {x.shape}, needs states over time, (..., T, {2 * model.n})")
    energy = model.energy(x[..., : model.n], x[..., model.n :])
    return energy - energy[..., :1]


class _Rate:
    """ẋ as a function of (t, x), NaN where it cannot be had for want of finite numbers.

    With NaN, an adaptive method takes its step back and tries a shorter one.
    latest: the last time at which ẋ was finite.
    """

    def __init__(self, f, u):
        self.f = f
        self.u = u if callable(u) else all_finite("u", real_array("u", u))
        self.latest = -np.inf

    def __call__(self, t, x) -> np.ndarray:
        if not np.isfinite(x).all():
            return np.full(x.shape, np.nan)
        u = real_array("u(t, x)", self.u(t, x)) if callable(self.u) else self.u
        if not np.isfinite(u).all():
            return np.full(x.shape, np.nan)
        try:
            slope = _slope(self.f, x, u, f"f(x, u) at t = {t:.6g} s")
        except (OverflowError, FloatingPointError):
            return np.full(x.shape, np.nan)
        if np.isfinite(slope).all():
            self.latest = max(self.latest, t)
        return slope


def _slope(f, x, u, name) -> np.ndarray:
    slope = real_array(name, f(x, u))
    if slope.shape != x.shape:
        raise ValueError(f"{name}: got shape {slope.shape}, needs that of x, {x.shape}")
    return slope


def _times(t) -> np.ndarray:
    t = all_finite("t", real_array("t", t))
    if t.ndim != 1 or len(t) < 2:
        raise ValueError(f"t: got shape {t.shape}, needs two or more increasing times, (T,), in s")
    back = np.flatnonzero(np.diff(t) <= 0)
    if len(back):
        k = int(back[0])
        raise ValueError(
            f"t: needs increasing times; t[{k + 1}] = {t[k + 1]} s follows t[{k}] = {t[k]} s"
        )
    return t


def _fixed_steps(rate, x0, t) -> np.ndarray:
    states = np.empty((len(t), *x0.shape))
    states[0] = x0
    for k in range(len(t) - 1):
        states[k + 1] = _rk4(rate, t[k], states[k], t[k + 1] - t[k])
        if not np.isfinite(states[k + 1]).all():
            raise FloatingPointError(f"the state stopped being finite at t = {t[k + 1]:.6g} s")
    return np.moveaxis(states, 0, -2)


def _adaptive(rate, x0, t, method, rtol, atol) -> np.ndarray:
    with warnings.catch_warnings():
        # LSODA warns of what its result says again.
        warnings.filterwarnings("ignore", message="lsoda", category=UserWarning)
        solution = solve_ivp(rate, (t[0], t[-1]), x0, method, t_eval=t, rtol=rtol, atol=atol)
    stopped = f"{method} stopped near t = {rate.latest:.6g} s"
    if not solution.success:
        raise FloatingPointError(f"{stopped}: {solution.message}")
    if not np.isfinite(solution.y).all():
        raise FloatingPointError(f"{stopped}: the state is not finite")
    return solution.y.T


def _rk4(rate, t, x, dt) -> np.ndarray:
    k1 = rate(t, x)
    k2 = rate(t + dt / 2, x + dt / 2 * k1)
    k3 = rate(t + dt / 2, x + dt / 2 * k2)
    k4 = rate(t + dt, x + dt * k3)
    return x + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
