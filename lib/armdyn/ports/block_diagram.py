"""Runs the arm as a block diagram, like one in Simulink, with bdsim.

A function block computes q̈ from u, q and q̇. One integrator turns q̈ into q̇, a second one turns
q̇ into q, and both are fed back into the function block. bdsim integrates the states of all the
blocks together, by SciPy's solve_ivp.

Source of bdsim: P. Corke (2020 on), bdsim, block diagram simulation for Python.
"""

import numpy as np
from numpy.typing import ArrayLike

from armdyn.manipulator import Manipulator
from armdyn.parameters import nonnegative, positive, state_vector
from armdyn.rate import Input, Rate
from armdyn.simulate import SCIPY_METHODS, SMALLEST_RTOL


def diagram(model: Manipulator, x0: ArrayLike, u: Input, start: float = 0.0):
    """The compiled bdsim.BlockDiagram of the arm, to run, or to draw with `plotting`.

    model: any Manipulator. x0: (2n,), [q; q̇], the initial states of the integrators, rad and rad/s.
    u: the input, N·m: (n,), a constant block; or u(t, x), a function block, fed by the time from
    `start` (s) on and by both integrators. The blocks "position" and "velocity" are the integrators,
    "dynamics" is the function block, and "scope" takes q̇ and q.

    Raises ImportError, saying what to install, where bdsim is missing; ValueError for states and
    inputs that are not numbers of the right shape; and what the model raises at x0.
    """
    bdsim = _imported()
    x0 = _checked(model, x0, u, start)
    simulator = bdsim.BDSim(
        sysargs=False, toolboxes=False, graphics=False, progress=False, banner=False, quiet=True
    )
    blocks = simulator.blockdiagram("arm")
    dynamics = blocks.FUNCTION(
        lambda u, q, qd: model.dynamics(np.atleast_1d(q), np.atleast_1d(qd), u),
        nin=3,
        name="dynamics",
        inames=["u", "q", "qd"],
        onames=["qdd"],
    )
    position = blocks.INTEGRATOR(x0=x0[: model.n], name="position", onames=["q"])
    velocity = blocks.INTEGRATOR(x0=x0[model.n :], name="velocity", onames=["qd"])
    scope = blocks.SCOPE(nin=2, name="scope", inames=["qd", "q"])
    if callable(u):
        time = blocks.TIME(name="time", onames=["t"])
        torque = blocks.FUNCTION(
            lambda t, q, qd: np.asarray(u(t + start, np.hstack([q, qd])), float),
            nin=3,
            name="torque",
            inames=["t", "q", "qd"],
            onames=["u"],
        )
        blocks.connect(time, torque[0])
        blocks.connect(position, torque[1])
        blocks.connect(velocity, torque[2])
    else:
        torque = blocks.CONSTANT(np.asarray(u, float), name="torque", onames=["u"])
    blocks.connect(torque, dynamics[0])
    blocks.connect(dynamics, velocity)
    blocks.connect(velocity, position, dynamics[2], scope[0])
    blocks.connect(position, dynamics[1], scope[1])
    blocks.compile()
    return blocks


def simulate(
    model: Manipulator,
    x0: ArrayLike,
    u: Input,
    t: ArrayLike,
    method: str = "RK45",
    rtol: float = 1e-9,
    atol: float = 1e-12,
) -> np.ndarray:
    """The states [q; q̇] of the arm at the times t, as its block diagram runs, (T, 2n).

    model, x0, u: as for `diagram`. t: (T,), increasing, s. method: one of SciPy's, "RK45", "RK23",
    "DOP853" or "LSODA", which choose their steps by rtol and atol; bdsim has no fixed step, and
    here it has no largest step.

    Raises ValueError for times that do not increase and an unknown method; FloatingPointError where
    the method cannot go on or the states are not finite; what the model or u raises on the way,
    which bdsim prints too; and as `diagram`.
    """
    t = np.asarray(t, float)
    if t.ndim != 1 or len(t) < 2 or not np.isfinite(t).all() or np.any(np.diff(t) <= 0):
        raise ValueError(f"t: got shape {t.shape}, needs two or more increasing times, (T,), in s")
    if method not in SCIPY_METHODS:
        raise ValueError(f"method = {method!r}: needs one of {', '.join(SCIPY_METHODS)}")
    options = {
        "method": method,
        "rtol": max(positive("rtol", rtol, "1"), SMALLEST_RTOL),
        "atol": nonnegative("atol", atol, "unit of x"),
        "max_step": np.inf,  # without it, bdsim takes at least 100 steps
        "t_eval": t - t[0],
    }
    blocks = diagram(model, x0, u, start=t[0])
    integrators = [blocks.blocknames[name] for name in ("position", "velocity")]
    try:
        result = blocks.runtime.run(blocks, T=t[-1] - t[0], solver_args=options, watch=integrators)
    except RuntimeError as error:
        if error.__cause__ is not None:
            raise error.__cause__ from None  # bdsim itself says "Fatal failure"
        raise FloatingPointError(f"{method} stopped: {error}") from error
    if result.y.shape != (len(t), 2 * model.n) or not np.isfinite(result.y).all():
        raise FloatingPointError(f"{method} stopped: the states are not finite")
    return result.y


def _checked(model, x0, u, start) -> np.ndarray:
    """x0 as an array; the errors of the arguments, found before bdsim hides them in its own."""
    x0 = state_vector("x0", x0, 2 * model.n)
    if x0.ndim != 1:
        raise ValueError(f"x0: got shape {x0.shape}, needs one state, ({2 * model.n},)")
    if not callable(u) and state_vector("u", u, model.n).ndim != 1:
        raise ValueError(
            f"u: got shape {np.shape(u)}, needs ({model.n},), held constant, or a function u(t, x)"
        )
    Rate(model.state_derivative, u, [start])(start, x0)
    return x0


def _imported():
    try:
        import bdsim
    except ImportError:
        raise ImportError("the block diagram needs bdsim: pip install 'armdyn[ports]'") from None
    return bdsim
