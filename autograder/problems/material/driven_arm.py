"""The 2R arm under a controller that a computer runs: what the judge simulates of a student's answer.

The computer reads the state every STEP, asks the controller, and holds the torque until it reads again.
Between two readings the arm moves by one step of RK4. Plain floats instead of arrays of two: a run then
takes milliseconds.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, sin
from types import SimpleNamespace

import numpy as np

from autograder.problems.material.planar_2r import M, parameters

STEP = 0.02  # s
# A joint that turns faster, rad/s, is out of control; the run ends there.
FASTEST = 60.0
# Numbers of a controller or of the arm that are larger, in SI units, end it too.
MOST = 1e9


class Arm:
    """A 2R arm without friction, of which q and q̇ are known and a torque is held."""

    def __init__(self, arm, q, qd):
        _, first_1, J1, m2, first_2, self.J2 = map(float, parameters(arm))
        self.about_shoulder = J1 + m2 * arm.l1**2 + self.J2
        self.coupling = first_2 * arm.l1
        self.carried, self.beyond = arm.g * (first_1 + m2 * arm.l1), arm.g * first_2
        self.state = (float(q[0]), float(q[1]), float(qd[0]), float(qd[1]))
        self.lost = False

    @property
    def q(self) -> np.ndarray:
        return np.array(self.state[:2])

    @property
    def qd(self) -> np.ndarray:
        return np.array(self.state[2:])

    def rate(self, state, u):
        """ẋ, four floats."""
        q1, q2, w1, w2 = state
        c, h = self.coupling * cos(q2), -self.coupling * sin(q2)
        M11, M12, M22 = self.about_shoulder + 2 * c, self.J2 + c, self.J2
        g2 = self.beyond * cos(q1 + q2)
        t1 = u[0] - h * (2 * w1 * w2 + w2 * w2) - self.carried * cos(q1) - g2
        t2 = u[1] + h * w1 * w1 - g2
        det = M11 * M22 - M12 * M12
        return w1, w2, (M22 * t1 - M12 * t2) / det, (M11 * t2 - M12 * t1) / det

    def move(self, u) -> None:
        """One STEP under the torque u, two numbers, N·m; lost where the arm races."""
        x, u = self.state, (float(u[0]), float(u[1]))
        k1 = self.rate(x, u)
        k2 = self.rate(_along(x, k1, STEP / 2), u)
        k3 = self.rate(_along(x, k2, STEP / 2), u)
        k4 = self.rate(_along(x, k3, STEP), u)
        mean = [a + 2 * b + 2 * c + d for a, b, c, d in zip(k1, k2, k3, k4, strict=True)]
        after = _along(x, mean, STEP / 6)
        if max(map(abs, after)) < MOST:
            self.state = after
        self.lost = not max(map(abs, after[2:])) < FASTEST


def _usable(value, count: int) -> bool:
    """Whether so many numbers came back, and none that is not finite or beyond all bounds."""
    return bool(np.size(value) == count and np.all(np.abs(value) < MOST))


def _along(x, slope, dt):
    return tuple(a + dt * b for a, b in zip(x, slope, strict=True))


class GoalRun:
    """A run of a controller u(q, qd, q_star, arm) from rest to a goal."""

    def __init__(self, arm, q, q_star, steps: int):
        self.known, self.q_star, self.left = arm, q_star, steps
        self.body = Arm(arm, q, np.zeros(2))

    def args(self):
        if not self.left or self.body.lost:
            return None
        return self.body.q, self.body.qd, self.q_star, self.known

    def tell(self, value):
        self.left -= 1
        self.body.lost = not _usable(value, 2)
        if not self.body.lost:
            self.body.move(np.ravel(value))

    def figures(self):
        """How far from the goal it ends, rad, how fast, rad/s, and 1 for a run that is lost there."""
        off, speed = np.max(np.abs(self.body.q - self.q_star)), np.max(np.abs(self.body.qd))
        return np.array([off, speed, float(self.body.lost)])


@dataclass(frozen=True)
class ToGoal:
    """An arm at rest at q that is to come to rest at q_star."""

    arm: SimpleNamespace
    q: np.ndarray
    q_star: np.ndarray
    steps: int

    def begin(self) -> GoalRun:
        return GoalRun(self.arm, self.q, self.q_star, self.steps)


@dataclass(frozen=True)
class Sway:
    """A wanted motion: each joint swings about its centre like a sine."""

    centre: np.ndarray
    size: np.ndarray
    rate: np.ndarray  # rad/s
    phase: np.ndarray

    def __call__(self, t: float) -> SimpleNamespace:
        """q, qd, qdd at the time t: (2,) each, rad, rad/s, rad/s²."""
        angle = self.rate * t + self.phase
        return SimpleNamespace(
            q=self.centre + self.size * np.sin(angle),
            qd=self.size * self.rate * np.cos(angle),
            qdd=-self.size * self.rate**2 * np.sin(angle),
        )


class TrackingRun:
    """A run of an adaptive controller, which gives u and the rate of its estimates, (8,)."""

    def __init__(self, plant: "Tracking"):
        self.plant, self.k = plant, 0
        start = plant.wanted(0.0)
        self.body = Arm(plant.arm, start.q + plant.off, start.qd)
        self.pi, self.true = np.array(plant.pi), parameters(plant.arm)
        self.weight = np.linalg.inv(plant.gains.Gamma)
        self.errors: list[float] = []
        self.energies: list[float] = []

    def args(self):
        if self.k == self.plant.steps or self.body.lost:
            return None
        wanted = self.plant.wanted(self.k * STEP)
        return self.body.q, self.body.qd, wanted, self.pi, self.plant.gains, self.plant.known

    def tell(self, value):
        self._note()
        self.k += 1
        self.body.lost = not _usable(value, 8)
        if not self.body.lost:
            value = np.ravel(value)
            self.body.move(value[:2])
            self.pi = self.pi + STEP * value[2:]

    def _note(self):
        wanted, gains = self.plant.wanted(self.k * STEP), self.plant.gains
        e = self.body.q - wanted.q
        s = self.body.qd - wanted.qd + gains.Lam @ e
        wrong = self.pi - self.true
        self.errors.append(float(np.max(np.abs(e))))
        M_now = M(self.body.q, self.plant.arm)
        self.energies.append(float(s @ M_now @ s + wrong @ self.weight @ wrong) / 2)

    def figures(self):
        """The largest error of the last second, rad, by how much V rises at most, as a share of its
        start, and 1 for a run that is lost."""
        self._note()
        rise = np.max(self.energies - np.minimum.accumulate(self.energies)) / self.energies[0]
        return np.array([max(self.errors[-round(1 / STEP) :]), rise, float(self.body.lost)])


@dataclass(frozen=True)
class Tracking:
    """An arm, the motion that is wanted of it, and what its controller knows and believes.

    known: what the controller is told of the arm. pi: its estimates at the start, (6,). off: how far
    from the wanted motion the arm begins, (2,), rad.
    """

    arm: SimpleNamespace
    wanted: Callable[[float], SimpleNamespace]
    off: np.ndarray
    pi: np.ndarray
    gains: SimpleNamespace
    known: SimpleNamespace
    steps: int

    def begin(self) -> TrackingRun:
        return TrackingRun(self)
