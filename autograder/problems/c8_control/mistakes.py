"""Mistakes about gravity compensation, and about the regressor with a reference velocity."""

from types import SimpleNamespace

import numpy as np

from autograder.judging.claims import Claim
from autograder.judging.diagnosis import Mistake
from autograder.judging.terms import Term
from autograder.problems.c8_control.chain import chain
from autograder.problems.material import sentences
from autograder.problems.material.planar_2r import M, changed, g_vec, regressor

# The arm of the notebook's set-up cell.
EXAMPLE = SimpleNamespace(
    l1=0.6, l2=0.5, lc1=0.28, lc2=0.22, m1=3.0, m2=2.0, I1=0.09, I2=0.05, g=9.81,
    kp=np.array([40.0, 12.0]), kd=np.array([12.0, 3.0]),
)  # fmt: skip


def _nothing(w):
    return np.zeros(2)


# A. PD with gravity compensation.
hold = chain(
    {
        "gravity": lambda w: g_vec(w.q, w.arm),
        "spring": lambda w: w.arm.kp * (w.q_star - w.q),
        "damper": lambda w: -w.arm.kd * w.qd,
    },
    "q qd q_star arm",
    lambda w: w.gravity + w.spring + w.damper,
)
to_goal = hold()  # the right answer, (2,), N·m

HOLD_TERMS = (
    Term("the gravity torque", hold(spring=_nothing, damper=_nothing)),
    Term("the spring", hold(gravity=_nothing, damper=_nothing)),
    Term("the damping", hold(gravity=_nothing, spring=_nothing)),
)


def _multiplied_by_M(q, qd, q_star, arm):
    return M(q, arm) @ (arm.kp * (q_star - q) - arm.kd * qd) + g_vec(q, arm)


HOLD = (
    Mistake(
        "gravity at the goal",
        hold(gravity=lambda w: g_vec(w.q_star, w.arm)),
        "You send the gravity torque of q*, which carries the arm only once it is there. With a stiff "
        "spring the arm gets there all the same; with a soft one it falls away from an upright q*. "
        "Where is the arm while it is on its way?",
    ),
    Mistake(
        "no gravity",
        hold(gravity=_nothing),
        "Your controller has no gravity torque, so the spring must be stretched to carry the arm. "
        "Which torque does the arm need at q*, at rest?",
    ),
    Mistake(
        "sign of gravity",
        hold(gravity=lambda w: -g_vec(w.q, w.arm)),
        "Your gravity torque pushes the arm down. Hold the arm out to the right: which way must the "
        "motor of the shoulder push?",
    ),
    Mistake(
        "sign of the error",
        hold(spring=lambda w: -w.arm.kp * (w.q_star - w.q)),
        "Your spring pushes the arm away from q*. Take q a little less than q*: which way should the "
        "torque act?",
    ),
    Mistake(
        "no spring",
        hold(spring=_nothing),
        "Your controller carries the arm and damps it, but nothing brings it to q*. Which of the two "
        "gains have you not used?",
    ),
    Mistake(
        "no damping",
        hold(damper=_nothing),
        "There is no damping in your controller. A weight on a spring without friction: when does it "
        "come to rest?",
    ),
    Mistake(
        "sign of the damping",
        hold(damper=lambda w: w.arm.kd * w.qd),
        "Your damping pushes a joint on in the direction in which it moves. Does it take energy out of "
        "the arm, or put some in?",
    ),
    Mistake(
        "gains exchanged",
        hold(spring=lambda w: w.arm.kd * (w.q_star - w.q), damper=lambda w: -w.arm.kp * w.qd),
        "You swapped the two gains. Which of them is in N·m/rad, and what must it be multiplied by?",
    ),
    Mistake(
        "spring and gravity multiplied by M",
        _multiplied_by_M,
        "You multiply spring and damping by M, as if the gains gave accelerations. In which unit does "
        "the table give kp?",
    ),
    Mistake(
        "error in degrees",
        hold(spring=lambda w: w.arm.kp * np.degrees(w.q_star - w.q)),
        "Your spring is 57 times too stiff: you take the error in degrees. In which unit of angle does "
        "the table give kp?",
    ),
    Mistake(
        "gravity in degrees",
        hold(gravity=lambda w: g_vec(np.degrees(w.q), w.arm)),
        sentences.IN_DEGREES,
    ),
    Mistake(
        "wrong angle of link 2",
        hold(gravity=lambda w: g_vec(w.q - [0.0, w.q[0]], w.arm)),
        "In your gravity torque link 2 has the direction q2. From where is q2 measured?",
    ),
    Mistake(
        "9.81",
        hold(gravity=lambda w: g_vec(w.q, changed(w.arm, g=9.81))),
        "Your torque is right only on Earth, because you typed 9.81 into it. Which parameter of arm "
        "gives g?",
    ),
    Mistake(
        "example arm",
        lambda q, qd, q_star, arm: to_goal(q, qd, q_star, EXAMPLE),
        "Your controller drives the arm of the set-up cell, whatever arm is given. Where does it read "
        "the numbers of its own argument?",
        claim=Claim.WHOLE,
    ),
)


# B. The regressor with a reference velocity.
def regressor_r(q, qd, qd_r, qdd_r, arm) -> np.ndarray:
    """Y_r with M q̈r + C q̇r + g = Y_r π, (2, 6): the right answer."""
    return regressor(q, qd, qdd_r, arm, qd_r)


def _parts(gravity=1.0, velocity=1.0, acceleration=1.0):
    """The right Y_r with its three parts times these numbers."""

    def part(q, qd, qd_r, qdd_r, arm):
        return regressor(
            q, velocity * qd, acceleration * qdd_r, changed(arm, g=gravity * arm.g), qd_r
        )

    return part


def _splitting(products):
    """The right Y_r with other products of q̇ and q̇r in row 1, where C q̇ has 2 q̇1 q̇2 + q̇2²."""

    def wrong(q, qd, qd_r, qdd_r, arm):
        Y = regressor_r(q, qd, qd_r, qdd_r, arm)
        right = qd[1] * qd_r[0] + (qd[0] + qd[1]) * qd_r[1]
        Y[0, 4] -= arm.l1 * np.sin(q[1]) * (products(qd, qd_r) - right)
        return Y

    return wrong


def _plus(entries):
    """The right Y_r with something added: entries gives it by (row, column)."""

    def wrong(q, qd, qd_r, qdd_r, arm):
        Y = regressor_r(q, qd, qd_r, qdd_r, arm)
        for at, value in entries(q, qd, qd_r, qdd_r, arm).items():
            Y[at] += value
        return Y

    return wrong


REGRESSOR_TERMS = (
    Term("its gravity part", _parts(velocity=0.0, acceleration=0.0)),
    Term(
        "its velocity part",
        lambda q, qd, qd_r, qdd_r, arm: _parts(0.0, 1.0, 0.0)(q, qd, qd_r, qdd_r, arm),
    ),
    Term("its acceleration part", _parts(gravity=0.0, velocity=0.0)),
)
NOT_SKEW = (
    "Your row 1 shares the products of two velocities out in another way than the Christoffel C. With "
    "q̇ in the place of q̇r it would be right; here the share matters. Which entry of C belongs to "
    "which entry of q̇r?"
)
TWO_VELOCITIES = (
    "Your Y_r has a product of two velocities in which both are the same. C depends on q̇, and q̇r "
    "stands behind it: how many of each does every product have?"
)
REGRESSOR = (
    Mistake(
        "qd for qd_r",
        lambda q, qd, qd_r, qdd_r, arm: regressor(q, qd, qdd_r, arm),
        "Your Y_r has C q̇ where C q̇r belongs: it does not depend on q̇r. Which of the two velocities "
        "is C multiplied by?",
    ),
    Mistake(
        "qd_r twice",
        lambda q, qd, qd_r, qdd_r, arm: regressor(q, qd_r, qdd_r, arm),
        "Your Y_r does not depend on q̇. C is a matrix of the arm as it moves: which velocity does it "
        "depend on?",
    ),
    Mistake(
        "all of h on the second entry",
        _splitting(lambda qd, qd_r: (2 * qd[0] + qd[1]) * qd_r[1]),
        NOT_SKEW,
    ),
    Mistake(
        "2 q̇2 on the first entry",
        _splitting(lambda qd, qd_r: 2 * qd[1] * qd_r[0] + qd[1] * qd_r[1]),
        NOT_SKEW,
    ),
    Mistake(
        "2 q̇1 q̇r2 and q̇r2²",
        _splitting(lambda qd, qd_r: 2 * qd[0] * qd_r[1] + qd_r[1] ** 2),
        TWO_VELOCITIES,
    ),
    Mistake(
        "q̇2² left",
        _splitting(lambda qd, qd_r: qd[1] * qd_r[0] + qd[0] * qd_r[1] + qd[1] ** 2),
        TWO_VELOCITIES,
    ),
    Mistake(
        "square of qd at joint 2",
        _plus(
            lambda q, qd, qd_r, qdd_r, arm: {
                (1, 4): arm.l1 * np.sin(q[1]) * qd[0] * (qd[0] - qd_r[0])
            }
        ),
        "At joint 2 your Y_r has the square of q̇1. Which velocity stands behind C?",
    ),
    Mistake(
        "product once",
        _splitting(lambda qd, qd_r: qd[0] * qd_r[1] + qd[1] * qd_r[1]),
        "In row 1 of your Y_r the product of q̇2 with q̇r1 is missing. How many entries does the first "
        "row of C have?",
    ),
    Mistake(
        "sign of the velocity products",
        _parts(velocity=-1.0),
        "The products of velocities have the wrong sign in your Y_r. What sign does h have?",
    ),
    Mistake(
        "velocity products left out",
        _parts(velocity=0.0),
        "Your Y_r has no product of velocities. Where does C(q, q̇) q̇r enter, and with which product "
        "of parameters?",
    ),
    Mistake(
        "no acceleration",
        _parts(acceleration=0.0),
        "Your Y_r does not depend on q̈r. Which matrix of the arm does it multiply?",
    ),
    Mistake(
        "no gravity",
        _parts(gravity=0.0),
        "Gravity is missing from your Y_r. Which columns does the weight of a link enter?",
    ),
    Mistake(
        "sign of gravity",
        _parts(gravity=-1.0),
        "Gravity has the wrong sign in your Y_r. On which side of the equation of motion does g(q) "
        "stand?",
    ),
    Mistake(
        "coupling without the factor 2",
        _plus(lambda q, qd, qd_r, qdd_r, arm: {(0, 4): -arm.l1 * np.cos(q[1]) * qdd_r[0]}),
        "In your column of m2 ℓc2, the first entry of q̈r counts too little at joint 1. Compare the "
        "coupling in M11 with that in M12.",
    ),
    Mistake(
        "absolute acceleration of link 2",
        _plus(lambda q, qd, qd_r, qdd_r, arm: {(0, 5): -qdd_r[0], (1, 5): -qdd_r[0]}),
        "In your column of J2, link 2 turns with the second entry of q̈r alone. What does joint 1 do to "
        "link 2?",
    ),
    Mistake(
        "9.81",
        lambda q, qd, qd_r, qdd_r, arm: regressor_r(q, qd, qd_r, qdd_r, changed(arm, g=9.81)),
        "Your Y_r is right only on Earth, because you typed 9.81 into it. Which parameter of arm gives "
        "g?",
    ),
    Mistake(
        "example arm",
        lambda q, qd, qd_r, qdd_r, arm: regressor_r(q, qd, qd_r, qdd_r, EXAMPLE),
        "Your Y_r is that of the arm in the set-up cell, whatever arm is given. Where does it read ℓ1 "
        "and g of its own argument?",
    ),
)
