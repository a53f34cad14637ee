"""Random systems in first-order form, and runs of them, whose exact motion the judge knows.

A rate that does not depend on the state shows what a simulator does with rows, times and inputs:
every consistent method is exact on it. Smooth rates show the method; they are bounded in x, so that a
wrong step does not run away. The right answers of p5 stand here too.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from autograder.judging.criterion import TOLERANCE
from autograder.protocol import Call, Function, real

# RK4's own error, as a share of the largest state: another method of order 4 may leave a few times it.
METHOD = TOLERANCE / 5
# The reference takes so many steps of RK4 for each one asked for: its error is 1300 times smaller.
FINE = 6
ORDER_STEPS = 6
LONGEST = 0.3  # s


@dataclass(frozen=True)
class FreeRun(Call):
    """A run without torque or friction, of which the judge knows the end and the energy."""

    end: np.ndarray | None = None
    energy: Callable | None = field(default=None, repr=False)


def rk4(f, x, u, dt):
    """One step of the classical method: the right answer."""
    k1 = f(x, u)
    k2 = f(x + dt / 2 * k1, u)
    k3 = f(x + dt / 2 * k2, u)
    k4 = f(x + dt * k3, u)
    return x + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def run(f, x0, u, t, step=rk4, held=lambda u, t, k, x, x0: u(t[k], x), steps=None):
    """States at the times t, (len(t), 2n): the right answer, or with something changed.

    step: of the method. held: the torque of step k. steps: their lengths, where not those of t.
    """
    states = [x0]
    for k, dt in enumerate(np.diff(t) if steps is None else steps):
        torque = held(u, t, k, states[-1], x0) if callable(u) else u
        states.append(step(f, states[-1], torque, dt))
    return np.array(states)


def finely(f, x, u, dt):
    """The state after dt under a held u, as good as exact."""
    for _ in range(FINE):
        x = rk4(f, x, u, dt / FINE)
    return x


def exact_run(f, x0, u, t):
    """States at the times t under a torque that is held over each step, as good as exact."""
    return run(f, x0, u, t, step=finely)


def fitted(f, x0, u, lengths, error) -> np.ndarray:
    """The lengths of the steps, stretched so that RK4 leaves about this error."""
    f = real(f)
    for _ in range(2):
        t = np.concatenate([[0.0], np.cumsum(lengths)])
        exact = exact_run(f, x0, u, t)
        off = np.max(np.abs(run(f, x0, u, t) - exact)) / np.max(np.abs(exact))
        lengths = lengths * np.clip((error / max(off, 1e-12)) ** 0.2, 0.5, 1.6)
    # RK4 may be right by chance, where another method of order 4 is not.
    return lengths * min(1.0, LONGEST / np.max(lengths))


def number(rng, low, high) -> str:
    """A coefficient with three digits and either sign, as it stands in a text."""
    return f"{rng.choice([-1.0, 1.0]) * rng.uniform(low, high):.3g}"


def _vector_of(entries) -> str:
    return f"[{', '.join(entries)}]".replace("+ -", "- ")


def steady(rng, size, inputs) -> Function:
    """A rate that depends on u alone: under a held u, every consistent method is exact."""
    entry = [
        f"{number(rng, 0.5, 1.5)}*u[{i % inputs}] + {number(rng, 0.3, 1)}" for i in range(size)
    ]
    return Function("x, u", _vector_of(entry))


def smooth(rng, size, inputs) -> Function:
    """A rate that depends on every entry of x and u, bounded in x, so that no method runs away."""
    turn = rng.integers(size)
    entries = [
        f"{number(rng, 0.6, 1.2)}*sin(x[{(i + turn + 1) % size}])"
        f" + {number(rng, 0.4, 0.8)}*cos(x[{i}])*u[{i % inputs}]"
        f" - {rng.uniform(0.1, 0.4):.3g}*x[{i}]"
        for i in range(size)
    ]
    return Function("x, u", _vector_of(entries))


def signed(rng, low, high, size) -> np.ndarray:
    """Numbers of either sign, none near zero."""
    return rng.choice([-1.0, 1.0], size) * rng.uniform(low, high, size)


def step_lengths(rng, steps) -> np.ndarray:
    """Time steps of clearly different lengths."""
    return rng.permutation(np.linspace(0.1, 0.25, steps))


def times(rng, lengths) -> np.ndarray:
    """Times that start anywhere but at 0."""
    return rng.uniform(0.5, 2.0) + np.concatenate([[0.0], np.cumsum(lengths)])


def torque_function(rng, n) -> Function:
    """u(t, x) that depends on the time and on the state."""
    entries = [
        f"{number(rng, 0.5, 1)}*sin({rng.uniform(0.7, 1.5):.3g}*t)"
        f" + {number(rng, 0.4, 0.8)}*cos(x[{(i + 1) % n}])"
        for i in range(n)
    ]
    return Function("t, x", _vector_of(entries))


def free_runs(rng, n) -> list[FreeRun]:
    """Pendulums of unit inertia, two of them coupled by a spring, from rest or moving."""
    a, b, c = (float(f"{number:.3g}") for number in rng.uniform(0.8, 2.0, 3))
    if n == 1:
        f = Function("x, u", f"[x[1], u[0] - {a}*sin(x[0])]")

        def energy(x):
            return x[:, 1] ** 2 / 2 + a * (1 - np.cos(x[:, 0]))
    else:
        f = Function(
            "x, u",
            f"[x[2], x[3], u[0] - {a}*sin(x[0]) + {c}*(x[1] - x[0]),"
            f" u[1] - {b}*sin(x[1]) + {c}*(x[0] - x[1])]",
        )

        def energy(x):
            potential = a * (1 - np.cos(x[:, 0])) + b * (1 - np.cos(x[:, 1]))
            return (x[:, 2] ** 2 + x[:, 3] ** 2 + c * (x[:, 0] - x[:, 1]) ** 2) / 2 + potential

    x0, u, start = signed(rng, 0.6, 1.2, 2 * n), np.zeros(n), rng.uniform(0.5, 2.0)
    # Half the step leaves a sixteenth of it.
    dt = np.mean(fitted(f, x0, u, np.full(ORDER_STEPS, 0.12), 16 * METHOD))
    grids = [start + dt / part * np.arange(part * ORDER_STEPS + 1) for part in (1, 2)]
    end = exact_run(real(f), x0, u, grids[1])[-1]
    return [FreeRun("simulate", (f, x0, u, t), end=end, energy=energy) for t in grids]
