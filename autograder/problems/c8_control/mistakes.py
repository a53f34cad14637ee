"""Mistakes about gravity compensation."""

from types import SimpleNamespace

import numpy as np

from autograder.judging.claims import Claim
from autograder.judging.diagnosis import Mistake
from autograder.judging.terms import Term
from autograder.problems.c8_control.chain import chain
from autograder.problems.material import sentences
from autograder.problems.material.planar_2r import M, changed, g_vec

# The arm of the notebook's set-up cell.
EXAMPLE = SimpleNamespace(
    l1=0.6, l2=0.5, lc1=0.28, lc2=0.22, m1=3.0, m2=2.0, I1=0.09, I2=0.05, g=9.81,
    kp=np.array([40.0, 12.0]), kd=np.array([12.0, 3.0]),
)  # fmt: skip


def _nothing(w):
    return np.zeros(2)


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
        "spring to zero",
        hold(spring=lambda w: -w.arm.kp * w.q),
        "Your spring pulls the arm to q = 0, whatever q* is. From where must it measure how far the arm "
        "is off?",
    ),
    Mistake(
        "sum for the error",
        hold(spring=lambda w: w.arm.kp * (w.q_star + w.q)),
        "Your spring is stretched by the sum of two angles. How far is the arm from the goal?",
    ),
    Mistake(
        "spring without its gain",
        hold(spring=lambda w: w.q_star - w.q),
        "Your spring has no gain: you add an angle to a torque. What turns rad into N·m?",
    ),
    Mistake(
        "damping without its gain",
        hold(damper=lambda w: -w.qd),
        "Your damper has no gain: you add a velocity to a torque. What turns rad/s into N·m?",
    ),
    Mistake(
        "damper on the angle",
        hold(damper=lambda w: -w.arm.kd * w.q),
        "Your damper acts on the angle. Which motion shall it slow down, and what is zero once the arm "
        "stands still?",
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
