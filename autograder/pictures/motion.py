"""Plays a mechanism from one state: with the right equations, and with a student's in their place."""

from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from itertools import pairwise
from types import SimpleNamespace

import numpy as np

from armdyn.integrators import rk4
from autograder.judging.check import Check
from autograder.judging.criterion import TOLERANCE
from autograder.mechanisms import Mechanism
from autograder.mechanisms.shapes import Link, Mass, places
from autograder.mutation.generated import Generated
from autograder.pictures.equations import Equations, NoMotionError, bounded, students
from autograder.protocol import Call

SECONDS = (0.5, 1.0)  # the second where the first shows no difference
FRAMES = 30  # the player moves evenly between them
STEPS = 4  # of RK4, a frame
FASTEST = 60.0  # rad/s or m/s: the eye follows nothing faster, and the steps are too long for it
# Motions count as the same where no coordinate differs by more, as a share of its change.
ALIKE = 0.01


@dataclass(frozen=True)
class Motion:
    """t: (T,), s. x: (T, 2n), the states there. stopped: why it goes no further, "" where it does."""

    t: np.ndarray
    x: np.ndarray
    stopped: str = ""


@dataclass(frozen=True)
class Comparison:
    """Two motions of one mechanism from one state.

    name: of the student's function. equations: the right ones. is_free: there is neither torque nor
    friction, so that the right motion keeps its energy. times: how many times the right M, C q̇ or g the
    student's is all along the right motion; None where it is no multiple.
    """

    name: str
    mechanism: Mechanism
    arm: SimpleNamespace
    right: Motion
    theirs: Motion
    equations: Equations
    is_free: bool
    times: float | None

    @property
    def common(self) -> int:
        """How many frames both have."""
        return len(self.theirs.t)

    @property
    def alike(self) -> bool:
        q = self.mechanism.n
        right, theirs = self.right.x[: self.common, :q], self.theirs.x[:, :q]
        change = np.max(np.abs(right - right[0]), axis=0)
        return bool(np.all(np.abs(right - theirs) <= ALIKE * np.maximum(change, 1e-6)))

    def tips(self, motion: Motion) -> np.ndarray:
        """The way of the tip, (T, 2), m: the last body or end of a link that the picture draws."""
        return np.array([self._tip(x[: self.mechanism.n]) for x in motion.x])

    def _tip(self, q: np.ndarray) -> tuple[float, float]:
        bodies = [s for s in self.mechanism.shapes(q, self.arm) if isinstance(s, Link | Mass)]
        return places(bodies[-1])[-1] if bodies else self.mechanism.points(q, self.arm)[-1]


def generated(check: Check) -> Generated | None:
    """What the check's answer follows from; None where it follows from no mechanism."""
    return check.catalogue if isinstance(check.catalogue, Generated) else None


def compared(check: Check, function: Callable, call: Call) -> Comparison:
    """Both motions from the state of a call of an M, C, g_vec or f; from rest, where it has no q̇."""
    of = generated(check)
    assert of is not None
    m, arm, n = of.mechanism.full, call.args[-1], of.mechanism.n
    if of.answer == "f":
        x0, u = (np.ravel(value).astype(float) for value in call.args[:2])
    else:
        qd = np.ravel(call.args[1]) if of.answer == "C" else np.zeros(n)
        x0, u = np.concatenate([np.ravel(call.args[0]), qd]).astype(float), np.zeros(n)
    shape = {"M": (n, n), "C": (n, n), "g_vec": (n,), "f": (2 * n,)}[of.answer]
    right = Equations(m, arm, friction=of.answer == "f")
    theirs = Equations(m, arm, {of.answer: students(check, function, shape)})
    for seconds in SECONDS:
        with np.errstate(all="ignore"):
            exact = _run(right.rate, x0, u, seconds, nullcontext(lambda: None))
        tried = _run(theirs.rate, x0, u, seconds, bounded())
        if exact.stopped:
            raise NoMotionError(f"the right motion cannot be played from there: {exact.stopped}")
        is_free = of.answer != "f"
        times = _times(of.answer, theirs, right, exact.x) if is_free and not tried.stopped else None
        found = Comparison(check.name, m, arm, exact, tried, right, is_free, times)
        if tried.stopped or not found.alike:
            break
    return found


def _times(name: str, theirs: Equations, right: Equations, states: np.ndarray) -> float | None:
    """The factor between a term of both at some of the states, if there is one."""
    some = states[:: FRAMES // 5]
    try:
        with bounded():
            given = np.ravel([theirs.term(name, x) for x in some])
    except NoMotionError:  # at a state where their own motion never comes
        return None
    expected = np.ravel([right.term(name, x) for x in some])
    if not np.any(expected):
        return None
    times = float(expected @ given / (expected @ expected))
    apart = np.max(np.abs(given - times * expected))
    return times if apart <= TOLERANCE * np.max(np.abs(expected)) else None


def _run(
    rate: Callable,
    x0: np.ndarray,
    u: np.ndarray,
    seconds: float,
    limits: AbstractContextManager[Callable[[], None]],
) -> Motion:
    t = np.linspace(0.0, seconds, FRAMES + 1)
    states, stopped = [x0], ""
    try:
        with limits as in_time:
            for start, end in pairwise(t):
                states.append(_frame(rate, states[-1], u, end - start))
                in_time()
    except NoMotionError as error:
        stopped = str(error)
    return Motion(t[: len(states)], np.array(states), stopped)


def _frame(rate: Callable, x: np.ndarray, u: np.ndarray, dt: float) -> np.ndarray:
    for _ in range(STEPS):
        try:
            x = rk4(lambda _, at: rate(at, u), 0.0, x, dt / STEPS)
        except np.linalg.LinAlgError:
            raise NoMotionError(
                "M is singular there, and no acceleration follows from it"
            ) from None
        if not np.all(np.abs(x[len(x) // 2 :]) <= FASTEST):  # also where it is no number
            raise NoMotionError("its speed grows beyond all bounds")
    return x
