"""Mistakes about the law of Slotine and Li, and about the rate of V in its proof."""

from functools import partial

import numpy as np

from autograder.judging.claims import Claim
from autograder.judging.diagnosis import Mistake
from autograder.judging.terms import Term
from autograder.problems.c8_control.chain import chain
from autograder.problems.c8_control.mistakes import EXAMPLE, REGRESSOR, regressor_r
from autograder.problems.material.planar_2r import C, M, M_dot, h


def _no_torque(w):
    return np.zeros(2)


def _no_rate(w):
    return np.zeros(6)


# e, ed: the errors q − q* and q̇ − q̇*.
law = chain(
    {
        "e": lambda w: w.q - w.ref.q,
        "ed": lambda w: w.qd - w.ref.qd,
        "qd_r": lambda w: w.ref.qd - w.gains.Lam @ w.e,
        "qdd_r": lambda w: w.ref.qdd - w.gains.Lam @ w.ed,
        "s": lambda w: w.qd - w.qd_r,
        "Y": lambda w: regressor_r(w.q, w.qd, w.qd_r, w.qdd_r, w.arm),
        "forward": lambda w: w.Y @ w.pi_hat,
        "damping": lambda w: -w.gains.KD @ w.s,
        "rate": lambda w: -w.gains.Gamma @ w.Y.T @ w.s,
    },
    "q qd ref pi_hat gains arm",
    lambda w: np.concatenate([w.forward + w.damping, w.rate]),
)
adaptive = law()  # the right answer, (8,)

LAW_TERMS = (
    Term("Y_r π̂", law(damping=_no_torque, rate=_no_rate)),
    Term("K_D s", law(forward=_no_torque, rate=_no_rate)),
    Term("the rate of the estimates", law(forward=_no_torque, damping=_no_torque)),
)
LAW: tuple[Mistake, ...] = (
    Mistake(
        "sign of Λ in q̇r",
        law(
            qd_r=lambda w: w.ref.qd + w.gains.Lam @ w.e,
            qdd_r=lambda w: w.ref.qdd + w.gains.Lam @ w.ed,
        ),
        "Your reference velocity leads away from the wanted motion. Take q a little ahead of q*: should "
        "q̇r be larger than q̇*, or smaller?",
    ),
    Mistake(
        "sign of Λ in q̇r alone",
        law(qd_r=lambda w: w.ref.qd + w.gains.Lam @ w.e),
        "Your q̇r has the wrong sign before Λ, and your q̈r the right one. Is your q̈r the derivative of "
        "your q̇r?",
    ),
    Mistake(
        "Λ left out",
        law(qd_r=lambda w: w.ref.qd, qdd_r=lambda w: w.ref.qdd),
        "Your q̇r is q̇*, so your law never sees how far the arm is off. Which of the arguments have you "
        "not used?",
    ),
    Mistake(
        "Λ taken to be 1",
        law(qd_r=lambda w: w.ref.qd - w.e, qdd_r=lambda w: w.ref.qdd - w.ed),
        "You take the errors themselves in q̇r and q̈r. What turns an angle in rad into a velocity in "
        "rad/s?",
    ),
    Mistake(
        "wanted acceleration for q̈r",
        law(qdd_r=lambda w: w.ref.qdd),
        "Your q̈r is the wanted acceleration. q̈r is the rate of change of q̇r: which other part of q̇r "
        "changes with time?",
    ),
    Mistake(
        "sign of Λ in q̈r",
        law(qdd_r=lambda w: w.ref.qdd + w.gains.Lam @ w.ed),
        "Your q̈r has the wrong sign before Λ. Take the derivative of your q̇r once more.",
    ),
    Mistake(
        "q̇ for q̇r in Y_r",
        law(Y=lambda w: regressor_r(w.q, w.qd, w.qd, w.qdd_r, w.arm)),
        "Your Y_r has q̇ behind C. In the equation of s, what is left of C q̇ minus the term of your "
        "controller?",
    ),
    Mistake(
        "q̇r for q̇ in Y_r",
        law(Y=lambda w: regressor_r(w.q, w.qd_r, w.qd_r, w.qdd_r, w.arm)),
        "Your Y_r takes C at q̇r. Which velocity does the arm have?",
    ),
    Mistake(
        "q̇r and q̇ exchanged in s",
        law(s=lambda w: w.qd_r - w.qd),
        "Your s has the wrong sign, so your damping drives the error on. In which order do q̇ and q̇r "
        "stand in s?",
    ),
    Mistake(
        "Y_r of the wanted motion",
        law(Y=lambda w: regressor_r(w.ref.q, w.ref.qd, w.ref.qd, w.ref.qdd, w.arm)),
        "Your Y_r belongs to the wanted motion alone: it does not see where the arm is. Which angles, "
        "velocities and accelerations does the law put into it?",
    ),
    Mistake(
        "Y_r at the wanted angles",
        law(Y=lambda w: regressor_r(w.ref.q, w.qd, w.qd_r, w.qdd_r, w.arm)),
        "You take Y_r at q*. M, C and g of which arm does your torque have to cancel: the one that "
        "moves, or the one that is wanted?",
    ),
    Mistake(
        "error for s",
        law(s=lambda w: w.e),
        "Your s is the error of the angles. Which velocities does s compare?",
    ),
    Mistake(
        "sign of K_D",
        law(damping=lambda w: w.gains.KD @ w.s),
        "Your K_D term drives s on. Which sign makes V fall?",
    ),
    Mistake(
        "K_D left out",
        law(damping=_no_torque),
        "Your torque has no K_D term. What then makes V fall, even with all parameters right?",
    ),
    Mistake(
        "Y_r π̂ left out",
        law(forward=_no_torque),
        "Your torque is the K_D term alone: it never uses the estimates. What are they estimated for?",
    ),
    Mistake(
        "sign of the adaptation",
        law(rate=lambda w: w.gains.Gamma @ w.Y.T @ w.s),
        "Your estimates run the wrong way. Write V̇ with π̃ in it: which sign of the rate cancels the "
        "other term?",
    ),
    Mistake(
        "no adaptation",
        law(rate=_no_rate),
        "Your estimates never change. The payload stays unknown: which term of V̇ does then not "
        "cancel?",
    ),
    Mistake(
        "Γ left out",
        law(rate=lambda w: -w.Y.T @ w.s),
        "Your rate has no Γ. Look at the units: what turns Y_rᵀ s into kg/s, kg·m/s and kg·m²/s?",
    ),
    Mistake(
        "Γ inverted",
        law(rate=lambda w: -np.linalg.solve(w.gains.Gamma, w.Y.T @ w.s)),
        "You divide by Γ where you should multiply. Γ⁻¹ weighs π̃ in V: what does the rate of the "
        "estimates need to cancel it?",
    ),
    Mistake(
        "Γ entry by entry",
        law(rate=lambda w: -np.diag(w.gains.Gamma) * (w.Y.T @ w.s)),
        "You use only the diagonal of Γ. It is a matrix: which product with a vector does it need?",
    ),
    Mistake(
        "estimates for their rate",
        law(rate=lambda w: w.pi_hat),
        "You return the estimates in place of their rate. The computer integrates for you: what must "
        "it add up?",
    ),
    Mistake(
        "estimates moved on by their rate",
        law(rate=lambda w: w.pi_hat - w.gains.Gamma @ w.Y.T @ w.s),
        "You add the rate to the estimates yourself. The computer integrates for you: what must you "
        "return?",
    ),
    Mistake(
        "rate from the error",
        law(rate=lambda w: -w.gains.Gamma @ w.Y.T @ w.e),
        "Your estimates follow the error of the angles. By which vector does V̇ multiply Y_r π̃?",
    ),
    Mistake(
        "angles in degrees",
        law(e=lambda w: np.degrees(w.q - w.ref.q)),
        "You take the error of the angles in degrees, and the velocities in rad/s. Can you add the two?",
    ),
    Mistake(
        "example arm",
        law(Y=lambda w: regressor_r(w.q, w.qd, w.qd_r, w.qdd_r, EXAMPLE)),
        "Your law takes ℓ1 and g of the arm in the set-up cell, whatever arm is given. Where does it "
        "read its own argument?",
    ),
)


# A law that is right, on a wrong Y_r of part B; those of `LAW` may come of either.
STANDS_ON = (
    "Your law is right, but its Y_r is not. First make the card of part B green, or look at what you "
    "pass to regressor_r here."
)
OF_THE_LAW = ("qd for qd_r", "qd_r twice", "example arm")


def _on(wrong):
    return law(Y=lambda w: wrong(w.q, w.qd, w.qd_r, w.qdd_r, w.arm))


LAW += tuple(
    Mistake(f"law: {mistake.name}", _on(mistake.wrong), STANDS_ON, combines=False)
    for mistake in REGRESSOR
    if mistake.name not in OF_THE_LAW
)


def rate_of_V(q, qd, s, C_used, gains, arm, damping=-1.0, of_M=0.5, of_C=-1.0) -> float:
    """V̇, W: the right answer, or with other factors before its three terms."""
    return float(
        damping * s @ gains.KD @ s + of_M * s @ M_dot(q, qd, arm) @ s + of_C * s @ C_used @ s
    )


def _factors(**factors):
    return partial(rate_of_V, **factors)


# With the Christoffel C the terms with Ṁ and C cancel: no number tells one from the other.
V_TERMS = (
    Term("the damping", _factors(of_M=0.0, of_C=0.0)),
    Term("the part with Ṁ and C", _factors(damping=0.0)),
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
