"""Mistakes in finding out which way gravity points in a library."""

import numpy as np

from autograder.judging.claims import Claim
from autograder.judging.diagnosis import Mistake


def _torque(library, acceleration=0.0, joint=1, held=1.0):
    """Of one joint, with the arm level; held: how often what holds the arm counts."""
    rest = np.zeros(2)
    return (
        library(rest, rest, acceleration * np.ones(2))[joint]
        - (1 - held) * library(rest, rest, rest)[joint]
    )


def _inertia(library) -> float:
    return np.sign(_torque(library, 1.0, held=0.0))


def gravity_sign(library) -> float:
    """1 where gravity pulls down, −1 where it pulls up, 0 where there is none: the right answer."""
    return np.sign(_torque(library)) * _inertia(library)


ONE_SIGN = (
    "Your function returns the same number for every library. Ask the library for a torque: which "
    "joint of a level arm has a weight to hold?"
)


def _of_all(*rows) -> tuple[Mistake, ...]:
    """Of three possible numbers those of one criterion may be a mistake's by chance."""
    return tuple(Mistake(name, wrong, said, Claim.WHOLE) for name, wrong, said in rows)


GRAVITY_SIGN = _of_all(
    ("always 1", lambda library: 1, ONE_SIGN),
    ("always −1", lambda library: -1, ONE_SIGN),
    (
        "joint 1",
        lambda library: np.sign(_torque(library, joint=0)),
        "Your number is 0 for every library. The axis of joint 1 is vertical: can it feel a weight?",
    ),
    (
        "whose torque not asked",
        lambda library: np.sign(_torque(library)),
        "You take for granted that the library returns the torque of the motors. Some return the one "
        "that the arm puts on them: which other call tells you?",
    ),
    (
        "reversed",
        lambda library: -gravity_sign(library),
        "Your signs are all turned round. A level arm must be pushed up where gravity pulls down, and "
        "up is where q2 grows.",
    ),
    (
        "reversed, and whose torque not asked",
        lambda library: -np.sign(_torque(library)),
        "A level arm must be pushed up where gravity pulls down, and up is where q2 grows. And does "
        "each library return the torque of the motors?",
    ),
    (
        "nothing between",
        lambda library: 1 if gravity_sign(library) > 0 else -1,
        "Some libraries have no gravity at all, until it is set. What does your function return "
        "for such a one?",
    ),
    (
        "nothing between, and whose torque not asked",
        lambda library: 1 if _torque(library) > 0 else -1,
        "Some libraries have no gravity at all, and some return the torque that the arm puts on its "
        "motors. What does your function return for each of these?",
    ),
    (
        "asked with an acceleration",
        lambda library: np.sign(_torque(library, acceleration=1.0)),
        "You ask with an acceleration, and look at one torque: it mixes weight and inertia. Which call "
        "has the weight alone?",
    ),
    (
        "sign of the inertia",
        _inertia,
        "You return the sign of the inertia's torque. It says whose torque the library gives; what "
        "does gravity add to it?",
    ),
)
