"""The law of Slotine and Li, and mistakes about it."""

import numpy as np

from autograder.judging.diagnosis import Mistake
from autograder.judging.terms import Term
from autograder.problems.c8_control.chain import chain
from autograder.problems.c8_control.mistakes import EXAMPLE
from autograder.problems.c8_control.regressor_mistakes import REGRESSOR, regressor_r


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
        "wanted velocity left out",
        law(qd_r=lambda w: -w.gains.Lam @ w.e),
        "Your q̇r does not hold the wanted velocity. What is q̇r where the arm is where it should be?",
    ),
    Mistake(
        "wanted acceleration left out",
        law(qdd_r=lambda w: -w.gains.Lam @ w.ed),
        "Your q̈r does not hold the wanted acceleration. What is q̈r where the arm moves as it should?",
    ),
    Mistake(
        "q̇r and q̈r exchanged",
        law(Y=lambda w: regressor_r(w.q, w.qd, w.qdd_r, w.qd_r, w.arm)),
        "Your Y_r has q̇r and q̈r in each other's places. In which order does regressor_r take them?",
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
        "velocity error for s",
        law(s=lambda w: w.ed),
        "Your s is the error of the velocities alone. What is left of it where the arm moves beside the "
        "wanted path, at the wanted velocity?",
    ),
    Mistake(
        "K_D on the velocity error",
        law(damping=lambda w: -w.gains.KD @ w.ed),
        "Your K_D term acts on the error of the velocities. Which vector must it act on for V to fall?",
    ),
    Mistake(
        "damping without K_D",
        law(damping=lambda w: -w.s),
        "You add s to a torque as it is. What turns rad/s into N·m?",
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
