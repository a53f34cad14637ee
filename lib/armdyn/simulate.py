"""Simulates ẋ = f(x, u) with fixed-step methods, or with SciPy's solvers behind the same call."""

import reprlib
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike
from scipy import integrate

from armdyn.events import Event, Trajectory, Watch, listed
from armdyn.integrators import INTEGRATORS, rk4
from armdyn.manipulator import Manipulator, model_given
from armdyn.pace import ADVICE, Pace
from armdyn.parameters import all_finite, finite, nonnegative, positive, real_array, state_vector
from armdyn.progress import progress_bar
from armdyn.rate import Input, Rate, slope_of

__all__ = [
    "SCIPY_METHODS",
    "Convergence",
    "Event",
    "Trajectory",
    "energy_drift",
    "observed_order",
    "rk4_step",
    "simulate",
]

# Radau and BDF are left out: their Jacobian, by differences, takes the jump of Coulomb friction at
# rest for great stiffness, and they return wrong states without notice.
SCIPY_METHODS = ("RK45", "RK23", "DOP853", "LSODA")

# SciPy takes no smaller rtol, and warns of one.
SMALLEST_RTOL = 100 * np.finfo(float).eps


def rk4_step(f, x: ArrayLike, u: ArrayLike, dt: float) -> np.ndarray:
    """One step of the classical Runge-Kutta method, order 4, with u held over the step.

    f(x, u) gives ẋ. x: (..., N). dt in s. Returns the state after dt, (..., N). Raises ValueError
    for an x or dt that is not finite, and for an ẋ that has not the shape of x.

    Source: W. Kutta (1901), Beitrag zur näherungsweisen Integration totaler
    Differentialgleichungen, Zeitschrift für Mathematik und Physik 46.
    """
    x = all_finite("x", real_array("x", x))
    return rk4(lambda _, x: slope_of(f, x, u, "f(x, u)"), 0.0, x, finite("dt", dt, "s"))


def simulate(
    f,
    x0: ArrayLike,
    u: Input,
    t: ArrayLike,
    method: str = "rk4",
    rtol: float = 1e-9,
    atol: float = 1e-12,
    *,
    events=None,
    progress: bool = True,
) -> np.ndarray | Trajectory:
    """States of ẋ = f(x, u) at the times `t`, from x(t[0]) = x0.

    f(x, u): the state form, such as `arm.state_derivative`, x = [q; q̇]; or the arm itself, a
    Manipulator, which means the same. "energy_momentum" needs the arm.
    x0: (N,), or (..., N) for many arms at once.
    u: the input, N·m: (n,), held constant; (T, n), sampled, where row k is held from t[k] to
    t[k + 1] (the last row is not used); or a function u(t, x) that gives it. With many arms, samples
    of their own have shape (..., T, n), and constants of their own (..., 1, n).
    t: (T,), increasing, s. The fixed-step methods ("euler", "semi_implicit_euler", "rk4",
    "implicit_midpoint", "energy_momentum": see `armdyn.integrators`) take one step from each time to
    the next; one of SciPy's ("RK45", "RK23", "DOP853", "LSODA") chooses its own steps by rtol and
    atol, the same for all arms, so that each keeps the tolerances; it starts anew where a sampled
    input jumps. Where Coulomb friction holds a joint at rest, such a method makes no more progress,
    and says so; "rk4" goes on.
    events: functions g(t, x), or `Event`s, one or a list, whose zeros are located, for one arm. A
    fixed-step method locates them by a shorter step of its own.
    progress: whether a run longer than a second shows a bar, if stderr is a terminal or a notebook
    that somebody works in.

    Returns (..., T, N), or, with events, a `Trajectory`. Raises ValueError for times that do not
    increase, for states, inputs, events or derivatives that are not numbers of the right shape and
    for an unknown method; FloatingPointError, with the time, where the states stop being finite or
    a method cannot go on; and whatever f raises, such as numpy.linalg.LinAlgError at a singular M.
    NumPy does not warn of overflow in f: FloatingPointError says so instead.
    """
    x0, t = all_finite("x0", real_array("x0", x0)), _times(t)
    if x0.ndim == 0 or x0.size == 0:
        raise ValueError(f"x0: got shape {x0.shape}, needs (..., N), such as [q; q̇]")
    if method not in INTEGRATORS and method not in SCIPY_METHODS:
        known = ", ".join([*INTEGRATORS, *SCIPY_METHODS])
        raise ValueError(f"method = {method!r}: needs one of {known}")
    if method in INTEGRATORS and INTEGRATORS[method].split and x0.shape[-1] % 2:
        raise ValueError(f"x0: got shape {x0.shape}; {method} needs (..., 2n), [q; q̇]")
    if method in INTEGRATORS and INTEGRATORS[method].of_model and not isinstance(f, Manipulator):
        raise ValueError(f"f: {method} needs the arm, a Manipulator, and not its state_derivative")
    rtol, atol = positive("rtol", rtol, "1"), nonnegative("atol", atol, "unit of x")
    if not callable(f) and not isinstance(f, Manipulator):
        raise ValueError(f"f = {reprlib.repr(f)}: needs a function f(x, u), or the arm")
    rate = Rate(f, u, t)
    try:
        all_finite("ẋ", rate(t[0], x0))
    except np.linalg.LinAlgError:
        raise  # a ValueError by descent, but of the model and not of the arguments
    except ValueError as error:
        raise ValueError(f"f(x0, u) at t = {t[0]:.6g} s, x0 = {x0}: {error}") from error
    watch = None
    if events is not None:
        if x0.ndim != 1:
            raise ValueError(f"events: for one arm, x0 of shape (N,); got x0 of shape {x0.shape}")
        watch = Watch(listed(events), t[0], x0)
    # Adaptive methods try steps that overflow and take them back; it is the outcome that counts.
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        if method in INTEGRATORS:
            steps = _fixed_steps(rate, x0, t, INTEGRATORS[method].step)
        else:
            steps = _adaptive_steps(rate, x0, t, method, rtol, atol)
        reached, states = _follow(steps, x0, t, watch, progress)
    return states if watch is None else watch.trajectory(reached, states)


def energy_drift(model: Manipulator, x: ArrayLike) -> np.ndarray:
    """E − E₀ along states x of shape (..., T, 2n): (..., T), J.

    Zero for exact motion without input and friction. Raises ValueError for another shape.
    """
    x = state_vector("x", x, 2 * model_given("model", model).n)
    if x.ndim < 2 or x.shape[-2] == 0:
        raise ValueError(f"x: got shape {x.shape}, needs states over time, (..., T, {2 * model.n})")
    energy = model.energy(x[..., : model.n], x[..., model.n :])
    return energy - energy[..., :1]


@dataclass(frozen=True)
class Convergence:
    """How the final state of a fixed-step method settles as the step is halved.

    steps: (k + 1,), the numbers of steps tried, each twice the one before. errors: (k,), the largest
    change of an entry of the final state from steps[i] to steps[i + 1], in that entry's unit; for
    order p it is 1 − 2⁻ᵖ of the error with steps[i]. orders: (k − 1,), log₂ of the ratio of
    successive errors; NaN where an error is no more than rounding.
    """

    steps: np.ndarray
    errors: np.ndarray
    orders: np.ndarray


def observed_order(
    f,
    x0: ArrayLike,
    u: Input,
    t_end: float,
    method: str = "rk4",
    steps: int = 64,
    halvings: int = 4,
) -> Convergence:
    """The order a fixed-step method shows on ẋ = f(x, u) from 0 to t_end (s), by halving the step.

    x0: (..., N). u: (n,), held constant, or u(t, x). steps: the number of steps of the first run;
    halvings: how often it is doubled, at least 2. Orders near the method's own (see
    `armdyn.integrators`) need a smooth f and steps short enough; a jump, as of Coulomb friction,
    spoils them. Raises ValueError for one of SciPy's methods, for a sampled u, and as `simulate`.
    """
    if method not in INTEGRATORS:
        raise ValueError(f"method = {method!r}: needs one of {', '.join(INTEGRATORS)}")
    if not callable(u) and real_array("u", u).ndim > 1:
        raise ValueError("u: needs (n,) or a function u(t, x); the times change from run to run")
    for name, count, least in (("steps", steps, 1), ("halvings", halvings, 2)):
        if not isinstance(count, int) or count < least:
            raise ValueError(f"{name} = {count!r}: needs a whole number, at least {least}")
    counts = steps * 2 ** np.arange(halvings + 1)
    t_end = positive("t_end", t_end, "s")

    def end(n: int) -> np.ndarray:
        states = simulate(f, x0, u, np.linspace(0, t_end, n + 1), method)
        assert isinstance(states, np.ndarray)  # without events, no Trajectory
        return states[..., -1, :]

    ends = np.stack([end(int(n)) for n in counts])
    errors = np.abs(np.diff(ends, axis=0)).reshape(halvings, -1).max(axis=1)
    # Each step rounds; their sum grows about as the square root of their number.
    floor = 8 * np.finfo(float).eps * np.sqrt(counts[1:]) * np.abs(ends).max()
    logs = np.log2(np.where(errors > floor, errors, 1))
    orders = np.where((errors[1:] > floor[1:]) & (errors[:-1] > floor[:-1]), -np.diff(logs), np.nan)
    return Convergence(counts, errors, orders)


@dataclass(frozen=True)
class _Step:
    """From the last step's end to t, where the state is x; at(t) gives the states in between."""

    t: float
    x: np.ndarray
    at: Callable[[float], np.ndarray]


def _follow(steps: Iterator[_Step], x0, t, watch, progress) -> tuple[np.ndarray, np.ndarray]:
    """The times reached and the states there, (..., T, N)."""
    states = np.empty((len(t), *x0.shape))
    states[0] = x0
    k, now = 1, t[0]
    with progress_bar(t[-1] - t[0], progress) as bar:
        for step in steps:
            end = step.t if watch is None else watch.step(step.t, step.x, step.at)
            while k < len(t) and t[k] <= end:
                states[k] = step.at(t[k])
                k += 1
            if watch is not None and watch.stopped_by is not None:
                if t[k - 1] < end:
                    t = np.append(t[:k], end)
                    states[k], k = watch.found[-1][2], k + 1
                break
            if bar is not None:
                bar.update(step.t - now)
            now = step.t
    return t[:k], np.moveaxis(states[:k], 0, -2)


def _fixed_steps(rate, x, t, advance) -> Iterator[_Step]:
    for k in range(len(t) - 1):
        rate.hold(k)
        new = advance(rate, t[k], x, t[k + 1] - t[k])
        if not np.isfinite(new).all():
            raise FloatingPointError(f"the state stopped being finite at t = {t[k + 1]:.6g} s")

        def at(time, start=t[k], x=x, end=t[k + 1], new=new):
            return new if time == end else advance(rate, start, x, time - start)

        yield _Step(t[k + 1], new, at)
        x = new


def _adaptive_steps(rate, x0, t, method, rtol, atol) -> Iterator[_Step]:
    """One system of all the arms, in stretches over which the input does not jump."""
    shape = x0.shape
    # SciPy bounds the root mean square error of all entries; divided so, each arm's own is bounded.
    share = np.sqrt(x0.size / shape[-1])
    rtol, atol = max(rtol / share, SMALLEST_RTOL), atol / share

    def flat(time, y):
        return rate(time, y.reshape(shape)).ravel()

    y, pace = x0.ravel(), Pace(method, rate, t[0], t[-1])
    bounds = [0, *rate.jumps(), len(t) - 1]
    for first, last in pairwise(bounds):
        rate.hold(first)
        solver = getattr(integrate, method)(flat, t[first], y, t[last], rtol=rtol, atol=atol)
        while solver.status == "running":
            with warnings.catch_warnings():
                # LSODA warns of what its status says again.
                warnings.filterwarnings("ignore", message="lsoda", category=UserWarning)
                message = solver.step()
            stopped = f"{method} stopped near t = {rate.latest:.6g} s"
            if solver.status == "failed":
                raise FloatingPointError(f"{stopped}: {str(message).rstrip('.')}; {ADVICE}")
            if not np.isfinite(solver.y).all():
                raise FloatingPointError(f"{stopped}: the state is not finite")
            pace.step(solver.t)
            yield _Step(solver.t, solver.y.reshape(shape), _Between(solver, shape))
        y = solver.y


class _Between:
    """The states within a solver's last step; its interpolant, which costs, is made when needed."""

    def __init__(self, solver, shape):
        self.solver, self.shape, self.interpolant = solver, shape, None

    def __call__(self, t) -> np.ndarray:
        if self.interpolant is None:
            self.interpolant = self.solver.dense_output()
        return self.interpolant(t).reshape(self.shape)


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
