"""Mistakes about the rate of V in the proof of the law of Slotine and Li."""

from functools import partial

import numpy as np

from autograder.judging.claims import Claim
from autograder.judging.diagnosis import Mistake
from autograder.judging.terms import Term
from autograder.problems.c8_control.mistakes import EXAMPLE
from autograder.problems.material.planar_2r import C, M, M_dot, h


def rate_of_V(q, qd, s, C_used, gains, arm, damping=-1.0, of_M=0.5, of_C=-1.0) -> float:
    """V̇, W: the right answer, or with other factors before its three terms."""
    return float(
        damping * s @ gains.KD @ s + of_M * s @ M_dot(q, qd, arm) @ s + of_C * s @ C_used @ s
    )


def _factors(**factors):
    return partial(rate_of_V, **factors)


def _unless_christoffel(**factors):
    """A part of V̇, and 0 with the Christoffel C: there those with Ṁ and C cancel, and no number tells
    one from the other.
    """

    def part(q, qd, s, C_used, gains, arm):
        if np.allclose(C_used, C(q, qd, arm)):
            return 0.0
        return rate_of_V(q, qd, s, C_used, gains, arm, **factors)

    return part


V_TERMS = (
    Term("the damping", _factors(of_M=0.0, of_C=0.0)),
    Term("the part with Ṁ", _unless_christoffel(damping=0.0, of_C=0.0)),
    Term("the part with C", _unless_christoffel(damping=0.0, of_M=0.0)),
)


def _remainder(q, qd, v, C_used, arm):
    return v @ (M_dot(q, qd, arm) / 2 - C_used) @ v


RATE = (
    Mistake(
        "skew-symmetry taken for granted",
        _factors(of_M=0.0, of_C=0.0),
        "Your V̇ is that of the Christoffel C, whatever C is used. What is left of the terms with Ṁ and "
        "C where Ṁ − 2C is not skew-symmetric?",
    ),
    Mistake(
        "damping left out",
        _factors(damping=0.0),
        "Your V̇ has no K_D. What does the damping of the controller do to V?",
    ),
    Mistake(
        "sign of the damping",
        _factors(damping=1.0),
        "In your V̇ the damping makes V grow. With which sign does K_D s stand in the torque?",
    ),
    Mistake(
        "half of the damping",
        _factors(damping=-0.5),
        "Your damping is half of what it should be. Where does the ½ of V go when you take the "
        "derivative?",
    ),
    Mistake(
        "½ of V lost",
        _factors(of_M=1.0, of_C=-2.0),
        "The terms with Ṁ and C are twice what they should be in your V̇. Which factor stands in front "
        "of V?",
    ),
    Mistake(
        "½ of Ṁ lost",
        _factors(of_M=1.0),
        "The term with Ṁ is twice what it should be in your V̇. Which factor stands in front of V?",
    ),
    Mistake(
        "C once",
        _factors(of_C=-0.5),
        "The term with C is half of what it should be in your V̇. Which of the two terms has the ½ of "
        "V: that of M ṡ or that of Ṁ?",
    ),
    Mistake(
        "sign of Ṁ and C",
        _factors(of_M=-0.5, of_C=1.0),
        "The terms with Ṁ and C have the wrong sign in your V̇. On which side of the equation of s does "
        "C s stand?",
    ),
    Mistake(
        "sign of C",
        _factors(of_C=1.0),
        "The term with C has the wrong sign in your V̇. On which side of the equation of s does C s "
        "stand?",
    ),
    Mistake(
        "Ṁ left out",
        _factors(of_M=0.0),
        "Your V̇ has no Ṁ. In V = ½ sᵀ M s, does M stay the same while the arm moves?",
    ),
    Mistake(
        "C left out",
        _factors(of_C=0.0),
        "Your V̇ has no C. What does M ṡ equal in the closed loop?",
    ),
    Mistake(
        "q̇ for s",
        lambda q, qd, s, C_used, gains, arm: (
            -qd @ gains.KD @ qd + _remainder(q, qd, qd, C_used, arm)
        ),
        "You have q̇ on both sides where s belongs. V is made of s: which vector does its derivative "
        "have?",
        claim=Claim.WHOLE,
    ),
    Mistake(
        "q̇ for s in the damping",
        lambda q, qd, s, C_used, gains, arm: (
            -qd @ gains.KD @ qd + _remainder(q, qd, s, C_used, arm)
        ),
        "Your damping acts on q̇. Which vector does K_D multiply in the torque?",
    ),
    Mistake(
        "damping without K_D",
        lambda q, qd, s, C_used, gains, arm: -s @ s + _remainder(q, qd, s, C_used, arm),
        "Your damping has no K_D in it. In which unit does each of your terms come out?",
    ),
    Mistake(
        "C times q̇",
        lambda q, qd, s, C_used, gains, arm: (
            -s @ gains.KD @ s + s @ M_dot(q, qd, arm) @ s / 2 - s @ C_used @ qd
        ),
        "Your C stands before q̇. Which vector stands behind it in the equation of s?",
    ),
    Mistake(
        "Ṁ along s",
        lambda q, qd, s, C_used, gains, arm: (
            -s @ gains.KD @ s + s @ (M_dot(q, s, arm) / 2 - C_used) @ s
        ),
        "Your Ṁ is that of an arm whose joints move with s. With which velocity does the arm move?",
    ),
    Mistake(
        "M for Ṁ",
        lambda q, qd, s, C_used, gains, arm: -s @ gains.KD @ s + s @ (M(q, arm) / 2 - C_used) @ s,
        "You have M where Ṁ belongs. In which unit does each of your terms come out?",
    ),
    Mistake(
        "Ṁ from q̇1",
        lambda q, qd, s, C_used, gains, arm: (
            -s @ gains.KD @ s + _remainder(q, qd[::-1], s, C_used, arm)
        ),
        "Your Ṁ grows with q̇1. Which angle does M depend on?",
    ),
    Mistake(
        "example arm",
        lambda q, qd, s, C_used, gains, arm: rate_of_V(q, qd, s, C_used, gains, EXAMPLE),
        "Your Ṁ is that of the arm in the set-up cell, whatever arm is given. In which argument does "
        "the arm come?",
    ),
)


def valid_C(q, qd, arm, a: float, b: float) -> np.ndarray:
    """Another C with the same C q̇, (2, 2), kg·m²/s; a, b: numbers of either sign, 0 for Christoffel."""
    added = np.array([[-a * qd[1], a * qd[0]], [-b * qd[1], b * qd[0]]])
    return C(q, qd, arm) + h(q, arm) * added
