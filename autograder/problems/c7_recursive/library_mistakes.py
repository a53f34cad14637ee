"""Mistakes in the terms that are asked of a library that has only rnea."""

from collections.abc import Callable
from types import SimpleNamespace

import numpy as np

from autograder.judging.claims import Claim
from autograder.judging.diagnosis import Mistake


def parts(library, q, qd) -> SimpleNamespace:
    """M (n, n), and c = C q̇, g and f (n,), as the library's torques give them."""
    rest = np.zeros(len(q))
    g = library(q, rest, rest)
    forth, back = library(q, qd, rest) - g, library(q, -qd, rest) - g
    M = np.column_stack([library(q, rest, e) - g for e in np.eye(len(q))])
    return SimpleNamespace(M=M, c=(forth + back) / 2, g=g, f=(forth - back) / 2)


def _but(**of: Callable):
    """The right terms, of which some are others."""

    def wrong(library, q, qd):
        right = parts(library, q, qd)
        found = SimpleNamespace(**vars(right) | {name: own(right) for name, own in of.items()})
        return found.M, found.c, found.g, found.f

    return wrong


terms = _but()  # the right answer


def _gravity_at_zero(library, q, qd):
    M, c, _, f = terms(library, q, qd)
    return M, c, parts(library, 0 * q, qd).g, f


def _column(v):
    return v[:, np.newaxis]


def _velocity_as_acceleration(library, q, qd):
    """C q̇ and f of calls in which q̇ comes where q̈ belongs."""
    of = parts(library, q, qd)
    return of.M, 0 * of.c, of.g, of.M @ qd


def _joint_by_joint(library, q, qd):
    """C q̇ as a sum over joints of which one moves at a time."""
    M, _, g, f = terms(library, q, qd)
    return M, sum(parts(library, q, alone).c for alone in np.diag(qd)), g, f


def _of_velocities(library, q):
    """M of calls in which the unit vectors come where q̇ belongs."""
    rest = np.zeros(len(q))
    return np.column_stack([library(q, e, rest) - library(q, rest, rest) for e in np.eye(len(q))])


def _velocity_in_M(library, q, qd):
    return _of_velocities(library, q), *terms(library, q, qd)[1:]


def _both_exchanged(library, q, qd):
    return _of_velocities(library, q), *_velocity_as_acceleration(library, q, qd)[1:]


GRAVITY_IN_M = (
    "Each column of your M holds a torque that is there without any acceleration. What does the "
    "library return for an arm that is held still?"
)
FRICTION_IN_C = (
    "Your C q̇ holds the friction. Turn all velocities round: which of the two torques changes its "
    "sign, and which does not?"
)
GRAVITY_ONCE = (
    "Half of the gravity torque is left in your C q̇ and in your f. Both come from two calls, and "
    "gravity is in each of these: from which of them have you taken it away?"
)
ORDER = (
    "Your C q̇, g and f are right, but they come in another order. In which order does the docstring "
    "ask for them?"
)


TERMS = (
    Mistake(
        "gravity in M",
        _but(M=lambda of: of.M + _column(of.g)),
        GRAVITY_IN_M,
    ),
    Mistake("gravity added to M", _but(M=lambda of: of.M + 2 * _column(of.g)), GRAVITY_IN_M),
    Mistake(
        "M asked in motion",
        _but(M=lambda of: of.M + _column(of.c + of.f)),
        "Each column of your M holds torques that come from q̇. With which velocity do you ask for it?",
    ),
    Mistake(
        "M asked in motion, with gravity",
        _but(M=lambda of: of.M + _column(of.c + of.f + of.g)),
        "Each column of your M holds all that the library adds to M q̈: ask at rest, and take away "
        "what is left without any acceleration.",
    ),
    Mistake(
        "gravity twice from M",
        _but(M=lambda of: of.M - _column(of.g)),
        "Gravity is taken away twice from each column of your M. What do the two calls that you "
        "subtract have in common already?",
    ),
    Mistake(
        "unit velocities in M",
        _velocity_in_M,
        "Your M comes from unit velocities. In which order does the library take the velocity and the "
        "acceleration?",
    ),
    Mistake(
        "M from one acceleration of all joints",
        _but(M=lambda of: np.diag(of.M.sum(axis=1))),
        "Your M comes from a single acceleration of all joints, spread along the diagonal. One call "
        "gives n numbers: how many calls does a matrix of n columns need?",
    ),
    Mistake(
        "diagonal of M",
        _but(M=lambda of: np.diag(np.diag(of.M))),
        "Your M is right on its diagonal and zero beside it. A call returns the torques of all joints, "
        "also of those that do not accelerate.",
    ),
    Mistake(
        "gravity in C q̇",
        _but(c=lambda of: of.c + of.g),
        "Your C q̇ holds a torque that is there without any velocity. What does the library return "
        "for an arm that is held still?",
    ),
    Mistake(
        "friction in C q̇",
        _but(c=lambda of: of.c + of.f),
        FRICTION_IN_C,
    ),
    Mistake("friction in C q̇, of the way back", _but(c=lambda of: of.c - of.f), FRICTION_IN_C),
    Mistake(
        "gravity and friction in C q̇",
        _but(c=lambda of: of.c + of.f + of.g),
        "Your C q̇ is all that the library returns without acceleration. Which two other torques are "
        "in it?",
    ),
    Mistake(
        "C q̇ in the friction",
        _but(f=lambda of: of.f + of.c),
        "Your friction holds C q̇. Turn all velocities round: which of the two torques changes its "
        "sign, and which does not?",
    ),
    Mistake(
        "gravity in the friction",
        _but(f=lambda of: of.f + of.g),
        "Your friction holds a torque that is there without any velocity. What does the library return "
        "for an arm that is held still?",
    ),
    Mistake(
        "gravity and C q̇ in the friction",
        _but(f=lambda of: of.f + of.c + of.g),
        "Your friction is all that the library returns without acceleration. Which two other torques "
        "are in it?",
    ),
    Mistake(
        "gravity left in one of two calls",
        _but(c=lambda of: of.c + of.g / 2, f=lambda of: of.f - of.g / 2),
        GRAVITY_ONCE,
        claim=Claim.WHOLE,
    ),
    Mistake(
        "gravity left in the other of two calls",
        _but(c=lambda of: of.c + of.g / 2, f=lambda of: of.f + of.g / 2),
        GRAVITY_ONCE,
        claim=Claim.WHOLE,
    ),
    Mistake(
        "velocity in the place of the acceleration",
        _velocity_as_acceleration,
        "Your C q̇ is 0, and your f is M times q̇. In which order does the library take the velocity "
        "and the acceleration?",
        claim=Claim.WHOLE,
    ),
    Mistake(
        "velocity and acceleration exchanged in all calls",
        _both_exchanged,
        "Your M comes from unit velocities, and your f is M times q̇. In which order does the library "
        "take the velocity and the acceleration?",
        claim=Claim.WHOLE,
    ),
    Mistake(
        "gravity in motion, taken away everywhere",
        _but(
            M=lambda of: of.M - _column(of.c + of.f),
            c=lambda of: -of.f,
            g=lambda of: of.g + of.c + of.f,
        ),
        "Your gravity torque holds torques that come from q̇, and you take it away in the other terms. "
        "With which velocity do you ask for it?",
        claim=Claim.WHOLE,
    ),
    Mistake(
        "C q̇ joint by joint",
        _joint_by_joint,
        "Your C q̇ is a sum over joints of which one moves at a time. Which products of two velocities "
        "does no such call show?",
    ),
    *(
        Mistake(f"in the order {name}", _but(**of), ORDER, claim=Claim.WHOLE)
        for name, of in {
            "g, C q̇, f": {"c": lambda of: of.g, "g": lambda of: of.c},
            "C q̇, f, g": {"g": lambda of: of.f, "f": lambda of: of.g},
            "g, f, C q̇": {"c": lambda of: of.g, "g": lambda of: of.f, "f": lambda of: of.c},
            "f, C q̇, g": {"c": lambda of: of.f, "g": lambda of: of.c, "f": lambda of: of.g},
        }.items()
    ),
    Mistake(
        "C q̇ and friction exchanged",
        _but(c=lambda of: of.f, f=lambda of: of.c),
        "You return the friction where C q̇ belongs, and C q̇ where the friction belongs. Which of them "
        "do the velocities enter as products of two?",
    ),
    Mistake(
        "gravity of the level arm",
        _gravity_at_zero,
        "Your gravity torque is that of q = 0. In which position is the arm?",
    ),
    Mistake(
        "gravity in motion",
        _but(g=lambda of: of.g + of.c + of.f),
        "Your gravity torque holds torques that come from q̇. With which velocity do you ask for it?",
    ),
)
