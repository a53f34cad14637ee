"""Mistakes about the regressor with a reference velocity."""

import numpy as np

from autograder.judging.diagnosis import Mistake
from autograder.judging.terms import Term
from autograder.problems.c8_control.mistakes import EXAMPLE
from autograder.problems.material import sentences
from autograder.problems.material.planar_2r import changed, regressor


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


def _weighed_at(angles):
    """The right Y_r with its gravity at other angles, angles(q1, q2)."""

    def wrong(q, qd, qd_r, qdd_r, arm):
        still, at = np.zeros(2), np.array(angles(*q))
        of_weight = regressor(at, still, still, arm) - regressor(q, still, still, arm)
        return regressor_r(q, qd, qd_r, qdd_r, arm) + of_weight

    return wrong


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
        "sine for cosine in gravity",
        _weighed_at(lambda q1, q2: (q1 - np.pi / 2, q2)),
        "In your Y_r, gravity varies with the sine, as if the angles were measured from the vertical. "
        "From which axis is q1 measured?",
    ),
    Mistake(
        "wrong angle of link 2 in gravity",
        _weighed_at(lambda q1, q2: (q1, q2 - q1)),
        sentences.Q2_ALONE,
    ),
    Mistake(
        "sine for cosine in the coupling",
        _plus(
            lambda q, qd, qd_r, qdd_r, arm: {
                (0, 4): arm.l1 * (np.sin(q[1]) - np.cos(q[1])) * (2 * qdd_r[0] + qdd_r[1]),
                (1, 4): arm.l1 * (np.sin(q[1]) - np.cos(q[1])) * qdd_r[0],
            }
        ),
        sentences.COUPLING_WITH_SINE,
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
